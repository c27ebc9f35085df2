//! Sweeps over a block of up to eight neighbouring columns of U.
//!
//! A block is a matrix (see [`super::layout`]) that is swept in vectors of 8 or 16 rows, several
//! columns a pass. The last eight rows are apart: they hold the triangle, and there may be less
//! than eight of them in the vectors beside U. How many columns a pass takes depends on the
//! registers of the machine. The order in which the terms of a sum are added, and in which the
//! columns change a row, does not.

#![allow(clippy::needless_range_loop, clippy::manual_memcpy, reason = "constant bounds unroll")]

mod add;
mod dots;
mod eliminate;
mod rotate;
mod rotate_and_dot;
mod widen;

pub use add::add_columns;
pub use dots::dots;
pub use eliminate::eliminate;
pub use rotate::rotate;
pub use rotate_and_dot::rotate_and_dot;
pub use widen::{solve_and_dot, widen_and_rotate, Slopes};

use super::layout::{start, BLOCK};
use crate::vector::{Vector, HALF};
use crate::Real;

/// A number for each column of a block.
pub type PerColumn<T> = [T; BLOCK];

/// Runs `$body` for groups of at most `$most` of `$width` columns, from the left: `$c` is the
/// first column of a group, `C` their number, and `$group` what `$rows` yields for each.
macro_rules! groups_ascending {
    ($width:expr, $most:expr, $c:ident, $group:ident in $rows:expr => $body:expr) => {{
        let mut $c = 0;
        if $most >= 8 && $width == 8 {
            group!(8, $group in $rows => $body);
            $c = 8;
        }
        while $most >= 4 && $width - $c >= 4 {
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
    ($width:expr, $most:expr, $c:ident, $group:ident in $rows:expr => $body:expr) => {{
        let mut $c = $width;
        if $most >= 8 && $width == 8 {
            $c = 0;
            group!(8, $group in $rows => $body);
        }
        while $most >= 4 && $c >= 4 {
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
use {group, groups_ascending, groups_descending};

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
