//! Products of a vector with the columns of a block.

use super::{group, groups_ascending, load, Column, PerColumn, Rows, BLOCK};
use crate::vector::Vector;
use crate::Real;

/// u_c · f for each of `width` columns from j on, the unit diagonal included.
#[inline(always)]
pub fn dots<T: Real, V: Vector<T>, const GROUP: usize>(
    columns: &[T],
    j: usize,
    width: usize,
    f: &[T],
) -> PerColumn<T> {
    let mut sums = [T::ZERO; BLOCK];
    groups_ascending!(width, GROUP, c, group in Rows::of(columns, j + c, j) => {
        let group = dot_group::<T, V, C>(group, &f[..j], &f[j..j + width]);
        sums[c..c + C].copy_from_slice(&group);
    });
    sums
}

#[inline(always)]
fn dot_group<T: Real, V: Vector<T>, const C: usize>(
    mut columns: [Column<'_, T>; C],
    f: &[T],
    f_triangle: &[T],
) -> [T; C] {
    let (f, f_half) = T::chunks(f);
    for column in &mut columns {
        column.0 = &column.0[..f.len()];
    }
    let mut sums = [V::splat(T::ZERO); C];
    for i in 0..f.len() {
        let x = V::load(&f[i]);
        for c in 0..C {
            sums[c] = V::load(&columns[c].0[i]).mul_add(x, sums[c]);
        }
    }
    if let Some(f) = f_half.first_chunk() {
        let x = V::load_half(f);
        for c in 0..C {
            if let Some(u) = columns[c].1.first_chunk() {
                sums[c] = V::load_half(u).mul_add(x, sums[c]);
            }
        }
    }
    let x: V = load(f_triangle);
    for c in 0..C {
        sums[c] = V::load_half(columns[c].2).mul_add(x, sums[c]);
    }
    V::sums(sums)
}
