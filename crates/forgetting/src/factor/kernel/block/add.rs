//! Sums of the columns of a block.

use super::{group, groups_descending, part, splat, Column, PerColumn, Rows};
use crate::vector::Vector;
use crate::Real;

/// `x` += c u for each column of a block and its factor c, from the right, above the triangle.
#[inline(always)]
pub fn add_columns<T: Real, V: Vector<T>, const GROUP: usize>(
    columns: &[T],
    j: usize,
    width: usize,
    x: &mut [T],
    factors: &PerColumn<T>,
) {
    if j > 0 {
        groups_descending!(width, GROUP, c, group in Rows::of(columns, j + c, j) => {
            add_group::<T, V, C>(group, &mut x[..j], part(factors, c));
        });
    }
}

#[inline(always)]
fn add_group<T: Real, V: Vector<T>, const C: usize>(
    mut columns: [Column<'_, T>; C],
    x: &mut [T],
    factors: [T; C],
) {
    let (x, x_half) = T::chunks_mut(x);
    for column in &mut columns {
        column.0 = &column.0[..x.len()];
    }
    let factors = splat::<T, V, C>(factors);
    for i in 0..x.len() {
        let mut sum = V::load(&x[i]);
        for c in (0..C).rev() {
            sum = factors[c].mul_add(V::load(&columns[c].0[i]), sum);
        }
        sum.store(&mut x[i]);
    }
    if let Some(x) = x_half.first_chunk_mut() {
        let mut sum = V::load_half(x);
        for c in (0..C).rev() {
            if let Some(u) = columns[c].1.first_chunk() {
                sum = factors[c].mul_add(V::load_half(u), sum);
            }
        }
        sum.store_half(x);
    }
}
