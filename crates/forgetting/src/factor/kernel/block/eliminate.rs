//! Agee and Turner's update of the columns of a block.

use super::{group, groups_descending, load, part, splat, store, ColumnMut, PerColumn, Rows};
use crate::vector::Vector;
use crate::Real;

/// For each column of a block, from the right: `x` += (−s) u, then u += slope `x`.
#[inline(always)]
pub fn eliminate<T: Real, V: Vector<T>, const GROUP: usize>(
    columns: &mut [T],
    j: usize,
    width: usize,
    x: &mut [T],
    (slope, less_s): (&PerColumn<T>, &PerColumn<T>),
) {
    let (x, x_triangle) = x[..j + width].split_at_mut(j);
    groups_descending!(width, GROUP, c, group in Rows::of_mut(columns, j + c, j) => {
        let factors = (part(slope, c), part(less_s, c));
        eliminate_group::<T, V, C>(group, (&mut *x, &mut *x_triangle), factors);
    });
}

#[inline(always)]
fn eliminate_group<T: Real, V: Vector<T>, const C: usize>(
    mut columns: [ColumnMut<'_, T>; C],
    (x, x_triangle): (&mut [T], &mut [T]),
    (slope, less_s): ([T; C], [T; C]),
) {
    let (x, x_half) = T::chunks_mut(x);
    for column in &mut columns {
        column.0 = &mut core::mem::take(&mut column.0)[..x.len()];
    }
    let (slope, less_s) = (splat::<T, V, C>(slope), splat::<T, V, C>(less_s));
    for i in 0..x.len() {
        let mut rest = V::load(&x[i]);
        for c in (0..C).rev() {
            let before = V::load(&columns[c].0[i]);
            rest = less_s[c].mul_add(before, rest);
            slope[c].mul_add(rest, before).store(&mut columns[c].0[i]);
        }
        rest.store(&mut x[i]);
    }
    if let Some(x) = x_half.first_chunk_mut() {
        let mut rest = V::load_half(x);
        for c in (0..C).rev() {
            if let Some(u) = columns[c].1.first_chunk_mut() {
                let before = V::load_half(u);
                rest = less_s[c].mul_add(before, rest);
                slope[c].mul_add(rest, before).store_half(u);
            }
        }
        rest.store_half(x);
    }
    let mut rest: V = load(x_triangle);
    for c in (0..C).rev() {
        let before = V::load_half(columns[c].2);
        rest = less_s[c].mul_add(before, rest);
        slope[c].mul_add(rest, before).store_half(columns[c].2);
    }
    store(rest, x_triangle);
}
