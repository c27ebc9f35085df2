//! Sweeps over a block of up to eight neighbouring columns of U.
//!
//! A block is a matrix (see [`super::layout`]) that is swept in vectors of 8 or 16 rows, several
//! columns a pass. The last eight rows are apart: they hold the triangle, and there may be less
//! than eight of them in the vectors beside U. How many columns a pass takes depends on the
//! registers of the machine. The order in which the terms of a sum are added, and in which the
//! columns change a row, does not.

#![allow(clippy::needless_range_loop, clippy::manual_memcpy, reason = "constant bounds unroll")]

use super::layout::{start, BLOCK};
use crate::vector::{Vector, HALF};
use crate::Real;

/// A number for each column of a block.
pub type PerColumn<T> = [T; BLOCK];

/// Runs `$body` for groups of at most `GROUP` of `$width` columns, from the left: `$c` is the
/// first column of a group, `C` their number, and `$group` what `$rows` yields for each.
macro_rules! groups_ascending {
    ($width:expr, $c:ident, $group:ident in $rows:expr => $body:expr) => {{
        let mut $c = 0;
        if GROUP >= 8 && $width == 8 {
            group!(8, $group in $rows => $body);
            $c = 8;
        }
        while GROUP >= 4 && $width - $c >= 4 {
            group!(4, $group in $rows => $body);
            $c += 4;
        }
        while $width - $c >= 2 {
            group!(2, $group in $rows => $body);
            $c += 2;
        }
        if $c < $width {
            group!(1, $group in $rows => $body);
        }
    }};
}

/// The same from the right.
macro_rules! groups_descending {
    ($width:expr, $c:ident, $group:ident in $rows:expr => $body:expr) => {{
        let mut $c = $width;
        if GROUP >= 8 && $width == 8 {
            $c = 0;
            group!(8, $group in $rows => $body);
        }
        while GROUP >= 4 && $c >= 4 {
            $c -= 4;
            group!(4, $group in $rows => $body);
        }
        while $c >= 2 {
            $c -= 2;
            group!(2, $group in $rows => $body);
        }
        if $c > 0 {
            $c = 0;
            group!(1, $group in $rows => $body);
        }
    }};
}

/// One group. Arrays are written out: closures might not be compiled into the loop they serve.
macro_rules! group {
    (8, $group:ident in $rows:expr => $body:expr) => {
        group!(8, rows, $rows, $group,
            [rows.next(), rows.next(), rows.next(), rows.next(),
             rows.next(), rows.next(), rows.next(), rows.next()] => $body)
    };
    (4, $group:ident in $rows:expr => $body:expr) => {
        group!(4, rows, $rows, $group,
            [rows.next(), rows.next(), rows.next(), rows.next()] => $body)
    };
    (2, $group:ident in $rows:expr => $body:expr) => {
        group!(2, rows, $rows, $group, [rows.next(), rows.next()] => $body)
    };
    (1, $group:ident in $rows:expr => $body:expr) => {
        group!(1, rows, $rows, $group, [rows.next()] => $body)
    };
    ($C:literal, $name:ident, $rows:expr, $group:ident, $array:expr => $body:expr) => {{
        #[allow(dead_code, reason = "not every sweep needs it")]
        const C: usize = $C;
        let mut $name = $rows;
        let $group = $array;
        $body
    }};
}

/// Calls `$function::<.., C>` with the number of columns C, 1 to 8, as a constant.
macro_rules! with_width {
    ($width:expr, $function:ident::<$($T:ident),+>$arguments:tt) => {
        match $width {
            1 => $function::<$($T,)+ 1>$arguments,
            2 => $function::<$($T,)+ 2>$arguments,
            3 => $function::<$($T,)+ 3>$arguments,
            4 => $function::<$($T,)+ 4>$arguments,
            5 => $function::<$($T,)+ 5>$arguments,
            6 => $function::<$($T,)+ 6>$arguments,
            7 => $function::<$($T,)+ 7>$arguments,
            _ => $function::<$($T,)+ 8>$arguments,
        }
    };
}

pub(super) use with_width;

/// Those of `numbers` that belong to a group of `C` columns from `at` on.
#[inline(always)]
fn part<T: Real, const C: usize>(numbers: &PerColumn<T>, at: usize) -> [T; C] {
    let mut part = [T::ZERO; C];
    part.copy_from_slice(&numbers[at..at + C]);
    part
}

/// A number in every lane, for each column of a group.
#[inline(always)]
fn splat<T: Real, V: Vector<T>, const C: usize>(numbers: [T; C]) -> [V; C] {
    let mut vectors = [V::splat(T::ZERO); C];
    for c in 0..C {
        vectors[c] = V::splat(numbers[c]);
    }
    vectors
}

/// A column of a block: the chunks above its triangle, the half chunk that may follow them, and
/// the rows of the triangle.
type Column<'a, T> = (&'a [<T as Real>::Chunk], &'a [T], &'a [T; HALF]);
/// The same, to be written.
type ColumnMut<'a, T> = (&'a mut [<T as Real>::Chunk], &'a mut [T], &'a mut [T; HALF]);

/// Columns of the block that starts at column j, one after the other.
struct Rows<C> {
    rest: C,
    j: usize,
}

impl<'a, T: Real> Rows<&'a [T]> {
    /// From column `first` on.
    #[inline(always)]
    fn of(columns: &'a [T], first: usize, j: usize) -> Self {
        Self { rest: &columns[start(first)..], j }
    }

    #[inline(always)]
    fn next(&mut self) -> Column<'a, T> {
        let (rectangle, rest) = self.rest.split_at(self.j);
        let (chunks, half) = T::chunks(rectangle);
        let (triangle, rest) = split_first(rest);
        self.rest = rest;
        (chunks, half, triangle)
    }
}

impl<'a, T: Real> Rows<&'a mut [T]> {
    /// From column `first` on.
    #[inline(always)]
    fn of_mut(columns: &'a mut [T], first: usize, j: usize) -> Self {
        Self { rest: &mut columns[start(first)..], j }
    }

    #[inline(always)]
    fn next(&mut self) -> ColumnMut<'a, T> {
        let (rectangle, rest) = core::mem::take(&mut self.rest).split_at_mut(self.j);
        let (chunks, half) = T::chunks_mut(rectangle);
        let (triangle, rest) = split_first_mut(rest);
        self.rest = rest;
        (chunks, half, triangle)
    }
}

#[inline(always)]
fn split_first<T>(rows: &[T]) -> (&[T; HALF], &[T]) {
    match rows.split_first_chunk() {
        Some(split) => split,
        None => unreachable!("a column ends with eight rows"),
    }
}

#[inline(always)]
fn split_first_mut<T>(rows: &mut [T]) -> (&mut [T; HALF], &mut [T]) {
    match rows.split_first_chunk_mut() {
        Some(split) => split,
        None => unreachable!("a column ends with eight rows"),
    }
}

/// Those of a vector beside U that belong to the rows of the triangle: eight, or the last few.
#[inline(always)]
fn load<T: Real, V: Vector<T>>(numbers: &[T]) -> V {
    match numbers.first_chunk() {
        Some(eight) => V::load_half(eight),
        None => V::load_first(numbers),
    }
}

/// Writes them.
#[inline(always)]
fn store<T: Real, V: Vector<T>>(vector: V, numbers: &mut [T]) {
    match numbers.first_chunk_mut() {
        Some(eight) => vector.store_half(eight),
        None => vector.store_first(numbers),
    }
}

/// The triangle of a block of C columns.
#[inline(always)]
pub fn load_triangle<T: Real, const C: usize>(columns: &[T], j: usize) -> [[T; C]; C] {
    let mut triangle = [[T::ZERO; C]; C];
    for c in 0..C {
        let from = start(j + c) + j;
        let column = &columns[from..from + BLOCK];
        for i in 0..c {
            triangle[c][i] = column[i];
        }
    }
    triangle
}

/// Puts the triangle back.
#[inline(always)]
pub fn store_triangle<T: Real, const C: usize>(
    columns: &mut [T],
    j: usize,
    triangle: &[[T; C]; C],
) {
    for c in 0..C {
        let to = start(j + c) + j;
        let column = &mut columns[to..to + BLOCK];
        for i in 0..c {
            column[i] = triangle[c][i];
        }
    }
}

/// u_c · f for each of `width` columns from j on, the unit diagonal included.
#[inline(always)]
pub fn dots<T: Real, V: Vector<T>, const GROUP: usize>(
    columns: &[T],
    j: usize,
    width: usize,
    f: &[T],
) -> PerColumn<T> {
    let mut sums = [T::ZERO; BLOCK];
    groups_ascending!(width, c, group in Rows::of(columns, j + c, j) => {
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
    groups_ascending!(width, c, group in Rows::of_mut(columns, j + c, j) => {
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
    groups_descending!(width, c, group in Rows::of_mut(columns, j + c, j) => {
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
        groups_descending!(width, c, group in Rows::of(columns, j + c, j) => {
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
