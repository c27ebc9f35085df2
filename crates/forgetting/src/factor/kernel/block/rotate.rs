//! Bierman's update of the columns of a block.

use super::{group, groups_ascending, load, part, splat, store, ColumnMut, PerColumn, Rows};
use crate::vector::Vector;
use crate::Real;

/// For each column of a block, from the left: `k` += v u and u += slope `k`, each with the other
/// of before. The rows of the triangle start with `k` = 0.
#[inline(always)]
pub fn rotate<T: Real, V: Vector<T>, const GROUP: usize>(
    columns: &mut [T],
    j: usize,
    width: usize,
    k: &mut [T],
    (slope, v): (&PerColumn<T>, &PerColumn<T>),
) {
    let (k, k_triangle) = k[..j + width].split_at_mut(j);
    groups_ascending!(width, GROUP, c, group in Rows::of_mut(columns, j + c, j) => {
        let factors = (part(slope, c), part(v, c));
        rotate_group::<T, V, C>(group, (&mut *k, &mut *k_triangle), factors, c);
    });
}

#[inline(always)]
fn rotate_group<T: Real, V: Vector<T>, const C: usize>(
    mut columns: [ColumnMut<'_, T>; C],
    (k, k_triangle): (&mut [T], &mut [T]),
    (slope, v): ([T; C], [T; C]),
    first: usize,
) {
    let (k, k_half) = T::chunks_mut(k);
    for column in &mut columns {
        column.0 = &mut core::mem::take(&mut column.0)[..k.len()];
    }
    let (slope, v) = (splat::<T, V, C>(slope), splat::<T, V, C>(v));
    for i in 0..k.len() {
        let mut gain = V::load(&k[i]);
        for c in 0..C {
            let before = V::load(&columns[c].0[i]);
            slope[c].mul_add(gain, before).store(&mut columns[c].0[i]);
            gain = v[c].mul_add(before, gain);
        }
        gain.store(&mut k[i]);
    }
    if let Some(k) = k_half.first_chunk_mut() {
        let mut gain = V::load_half(k);
        for c in 0..C {
            if let Some(u) = columns[c].1.first_chunk_mut() {
                let before = V::load_half(u);
                slope[c].mul_add(gain, before).store_half(u);
                gain = v[c].mul_add(before, gain);
            }
        }
        gain.store_half(k);
    }
    let mut gain = if first == 0 { V::splat(T::ZERO) } else { load(k_triangle) };
    for c in 0..C {
        let before = V::load_half(columns[c].2);
        slope[c].mul_add(gain, before).store_half(columns[c].2);
        gain = v[c].mul_add(before, gain);
    }
    store(gain, k_triangle);
}
