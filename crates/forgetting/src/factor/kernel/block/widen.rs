//! The two sweeps of forgetting along a regressor: see [`super::super::along`].

use super::{
    group, groups_ascending, groups_descending, load, part, splat, store, Column, ColumnMut,
    PerColumn, Rows, BLOCK,
};
use crate::vector::Vector;
use crate::Real;

/// `x` += c u for each column of a block and its factor c, above the triangle, and u · f with the
/// unit diagonal included.
#[inline(always)]
pub fn solve_and_dot<T: Real, V: Vector<T>, const GROUP: usize>(
    columns: &[T],
    j: usize,
    width: usize,
    (x, factors): (&mut [T], &PerColumn<T>),
    f: &[T],
) -> PerColumn<T> {
    let mut sums = [T::ZERO; BLOCK];
    groups_descending!(width, GROUP, c, group in Rows::of(columns, j + c, j) => {
        let (f, f_triangle) = (&f[..j], &f[j..j + width]);
        let group = group_of::<T, V, C>(group, (&mut x[..j], part(factors, c)), f, f_triangle);
        sums[c..c + C].copy_from_slice(&group);
    });
    sums
}

#[inline(always)]
fn group_of<T: Real, V: Vector<T>, const C: usize>(
    mut columns: [Column<'_, T>; C],
    (x, factors): (&mut [T], [T; C]),
    f: &[T],
    f_triangle: &[T],
) -> [T; C] {
    let (x, x_half) = T::chunks_mut(x);
    let (f, f_half) = T::chunks(f);
    let f = &f[..x.len()];
    for column in &mut columns {
        column.0 = &column.0[..x.len()];
    }
    let factors = splat::<T, V, C>(factors);
    let mut sums = [V::splat(T::ZERO); C];
    for i in 0..x.len() {
        let (mut rest, f) = (V::load(&x[i]), V::load(&f[i]));
        for c in (0..C).rev() {
            let u = V::load(&columns[c].0[i]);
            rest = factors[c].mul_add(u, rest);
            sums[c] = u.mul_add(f, sums[c]);
        }
        rest.store(&mut x[i]);
    }
    if let (Some(x), Some(f)) = (x_half.first_chunk_mut(), f_half.first_chunk()) {
        let (mut rest, f) = (V::load_half(x), V::load_half(f));
        for c in (0..C).rev() {
            if let Some(u) = columns[c].1.first_chunk() {
                let u = V::load_half(u);
                rest = factors[c].mul_add(u, rest);
                sums[c] = u.mul_add(f, sums[c]);
            }
        }
        rest.store_half(x);
    }
    let f: V = load(f_triangle);
    for c in 0..C {
        sums[c] = V::load_half(columns[c].2).mul_add(f, sums[c]);
    }
    V::sums(sums)
}

/// What a sweep adds to each column of a block: `widening` times `x`, then `slope` times `k`.
pub struct Slopes<T> {
    pub widening: PerColumn<T>,
    pub z: PerColumn<T>,
    pub slope: PerColumn<T>,
    pub v: PerColumn<T>,
}

/// For each column of a block, from the left: u' = u + widening `x` and `x` += z u, then
/// u ← u' + slope `k` and `k` += v u'. The rows of the triangle start with `x` = `k` = 0.
#[inline(always)]
pub fn widen_and_rotate<T: Real, V: Vector<T>, const GROUP: usize>(
    columns: &mut [T],
    j: usize,
    width: usize,
    (x, k): (&mut [T], &mut [T]),
    slopes: &Slopes<T>,
) {
    let (x, x_triangle) = x[..j + width].split_at_mut(j);
    let (k, k_triangle) = k[..j + width].split_at_mut(j);
    // two vectors go along: half as many columns fill the registers
    groups_ascending!(width, GROUP / 2, c, group in Rows::of_mut(columns, j + c, j) => {
        let above = (&mut *x, &mut *k);
        let triangle = (&mut *x_triangle, &mut *k_triangle);
        rotate_group::<T, V, C>(group, above, triangle, slopes, c);
    });
}

#[inline(always)]
fn rotate_group<T: Real, V: Vector<T>, const C: usize>(
    mut columns: [ColumnMut<'_, T>; C],
    (x, k): (&mut [T], &mut [T]),
    (x_triangle, k_triangle): (&mut [T], &mut [T]),
    slopes: &Slopes<T>,
    first: usize,
) {
    let (x, x_half) = T::chunks_mut(x);
    let (k, k_half) = T::chunks_mut(k);
    let k = &mut k[..x.len()];
    for column in &mut columns {
        column.0 = &mut core::mem::take(&mut column.0)[..x.len()];
    }
    let widening = splat::<T, V, C>(part(&slopes.widening, first));
    let z = splat::<T, V, C>(part(&slopes.z, first));
    let slope = splat::<T, V, C>(part(&slopes.slope, first));
    let v = splat::<T, V, C>(part(&slopes.v, first));
    for i in 0..x.len() {
        let (mut rest, mut gain) = (V::load(&x[i]), V::load(&k[i]));
        for c in 0..C {
            let before = V::load(&columns[c].0[i]);
            let widened = widening[c].mul_add(rest, before);
            rest = z[c].mul_add(before, rest);
            slope[c].mul_add(gain, widened).store(&mut columns[c].0[i]);
            gain = v[c].mul_add(widened, gain);
        }
        rest.store(&mut x[i]);
        gain.store(&mut k[i]);
    }
    if let (Some(x), Some(k)) = (x_half.first_chunk_mut(), k_half.first_chunk_mut()) {
        let (mut rest, mut gain) = (V::load_half(x), V::load_half(k));
        for c in 0..C {
            if let Some(u) = columns[c].1.first_chunk_mut() {
                let before = V::load_half(u);
                let widened = widening[c].mul_add(rest, before);
                rest = z[c].mul_add(before, rest);
                slope[c].mul_add(gain, widened).store_half(u);
                gain = v[c].mul_add(widened, gain);
            }
        }
        rest.store_half(x);
        gain.store_half(k);
    }
    let zero = V::splat(T::ZERO);
    let (mut rest, mut gain) =
        if first == 0 { (zero, zero) } else { (load(x_triangle), load(k_triangle)) };
    for c in 0..C {
        let before = V::load_half(columns[c].2);
        let widened = widening[c].mul_add(rest, before);
        rest = z[c].mul_add(before, rest);
        slope[c].mul_add(gain, widened).store_half(columns[c].2);
        gain = v[c].mul_add(widened, gain);
    }
    store(rest, x_triangle);
    store(gain, k_triangle);
}
