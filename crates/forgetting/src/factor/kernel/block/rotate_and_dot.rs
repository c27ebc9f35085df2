//! Bierman's update of the columns of a block for one sample, and their products with the next.

use super::{group, groups_ascending, load, part, splat, store, ColumnMut, PerColumn, Rows, BLOCK};
use crate::vector::Vector;
use crate::Real;

/// As [`super::rotate`], and u · f of the new columns, as [`super::dots`] would find it: each
/// column passes through the registers once.
#[inline(always)]
pub fn rotate_and_dot<T: Real, V: Vector<T>, const GROUP: usize>(
    columns: &mut [T],
    j: usize,
    width: usize,
    (k, f): (&mut [T], &[T]),
    (slope, v): (&PerColumn<T>, &PerColumn<T>),
) -> PerColumn<T> {
    let (k, k_triangle) = k[..j + width].split_at_mut(j);
    let (f, f_triangle) = f[..j + width].split_at(j);
    let mut sums = [T::ZERO; BLOCK];
    // a sum for each column goes along: half as many fill the registers
    groups_ascending!(width, GROUP, c, group in Rows::of_mut(columns, j + c, j) => {
        let factors = (part(slope, c), part(v, c));
        let vectors = ((&mut *k, &mut *k_triangle), (f, f_triangle));
        let group = rotate_group::<T, V, C>(group, vectors, factors, c);
        sums[c..c + C].copy_from_slice(&group);
    });
    sums
}

#[inline(always)]
fn rotate_group<T: Real, V: Vector<T>, const C: usize>(
    mut columns: [ColumnMut<'_, T>; C],
    ((k, k_triangle), (f, f_triangle)): ((&mut [T], &mut [T]), (&[T], &[T])),
    (slope, v): ([T; C], [T; C]),
    first: usize,
) -> [T; C] {
    let (k, k_half) = T::chunks_mut(k);
    let (f, f_half) = T::chunks(f);
    let f = &f[..k.len()];
    for column in &mut columns {
        column.0 = &mut core::mem::take(&mut column.0)[..k.len()];
    }
    let (slope, v) = (splat::<T, V, C>(slope), splat::<T, V, C>(v));
    let mut sums = [V::splat(T::ZERO); C];
    for i in 0..k.len() {
        let (mut gain, x) = (V::load(&k[i]), V::load(&f[i]));
        for c in 0..C {
            let before = V::load(&columns[c].0[i]);
            let after = slope[c].mul_add(gain, before);
            after.store(&mut columns[c].0[i]);
            sums[c] = after.mul_add(x, sums[c]);
            gain = v[c].mul_add(before, gain);
        }
        gain.store(&mut k[i]);
    }
    if let (Some(k), Some(f)) = (k_half.first_chunk_mut(), f_half.first_chunk()) {
        let (mut gain, x) = (V::load_half(k), V::load_half(f));
        for c in 0..C {
            if let Some(u) = columns[c].1.first_chunk_mut() {
                let before = V::load_half(u);
                let after = slope[c].mul_add(gain, before);
                after.store_half(u);
                sums[c] = after.mul_add(x, sums[c]);
                gain = v[c].mul_add(before, gain);
            }
        }
        gain.store_half(k);
    }
    let mut gain = if first == 0 { V::splat(T::ZERO) } else { load(k_triangle) };
    let x: V = load(f_triangle);
    for c in 0..C {
        let before = V::load_half(columns[c].2);
        let after = slope[c].mul_add(gain, before);
        after.store_half(columns[c].2);
        sums[c] = after.mul_add(x, sums[c]);
        gain = v[c].mul_add(before, gain);
    }
    store(gain, k_triangle);
    V::sums(sums)
}
