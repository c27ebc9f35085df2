//! Sweeps over a block of eight neighbouring columns of U, tile by tile.
//!
//! How many columns a pass over the tiles takes depends on the registers of the machine. The order
//! in which the terms of a sum are added, and in which the columns change a row, does not.

mod add;
mod chunks;
mod dots;
mod eliminate;
mod rank_one;

pub use add::add_columns;
pub use chunks::{Long, LongMut};
pub use dots::{dots, dots_beside};
pub use eliminate::eliminate;
pub use rank_one::{change_columns, change_row, RankOne};

use super::layout::{tiles_of, BLOCK};
use crate::number::block_vector::BlockVector;
use crate::number::vector::Vector;
use crate::number::{copy_first, copy_some, Real};

/// BlockVector columns of as many rows as a vector has numbers.
pub type Tile<T> = [<T as Real>::Chunk; BLOCK];
/// A number for each column of a block.
pub type PerColumn<T> = [T; BLOCK];

/// The tiles of block `b`.
#[inline(always)]
pub fn block<T: Real>(columns: &[T], b: usize) -> &[Tile<T>] {
    &T::chunks(columns).0.as_chunks().0[tiles_of::<T>(b)]
}

/// The tiles of block `b`, to be written.
#[inline(always)]
pub fn block_mut<T: Real>(columns: &mut [T], b: usize) -> &mut [Tile<T>] {
    &mut T::chunks_mut(columns).0.as_chunks_mut().0[tiles_of::<T>(b)]
}

/// The triangle of block `b`, by columns, without the diagonal.
#[inline(always)]
pub fn triangle<T: Real>(block: &[Tile<T>], b: usize) -> [PerColumn<T>; BLOCK] {
    let mut triangle = [[T::ZERO; BLOCK]; BLOCK];
    if let Some(tile) = block.last() {
        let first = b * BLOCK % T::ROWS;
        for c in 0..BLOCK {
            let column = &tile[c].as_ref()[first..first + BLOCK];
            for i in 0..c {
                triangle[c][i] = column[i];
            }
        }
    }
    triangle
}

/// Those of `numbers` that belong to block `b`; `padding` past the last of them.
// read in each arm: an array that a `match` returns is copied number by number
#[inline(always)]
pub fn load_per_column<T: Real, E: BlockVector<T>>(numbers: &[T], b: usize, padding: T) -> E {
    let numbers = &numbers[b * BLOCK..];
    match numbers.first_chunk() {
        Some(eight) => E::read(eight),
        None => {
            let mut eight = [padding; BLOCK];
            copy_some(&mut eight, numbers);
            E::read(&eight)
        }
    }
}

/// A stand-in for D past the last parameter: a little above the floor, so that rounding never lifts
/// it.
#[inline(always)]
pub fn padding_d<T: Real>() -> T {
    T::FLOOR * T::from_f64(4.0)
}

/// Puts them back.
#[inline(always)]
pub fn store_per_column<T: Real, E: BlockVector<T>>(numbers: &mut [T], b: usize, eight: E) {
    let numbers = &mut numbers[b * BLOCK..];
    match numbers.first_chunk_mut() {
        Some(numbers) => eight.write(numbers),
        None => copy_first(numbers, &eight.numbers()),
    }
}

/// A number in every lane, for each of C columns from `FIRST` on.
#[inline(always)]
fn splat<T: Real, V: Vector<T>, const C: usize, const FIRST: usize>(
    numbers: &PerColumn<T>,
) -> [V; C] {
    let mut vectors = [V::splat(T::ZERO); C];
    for c in 0..C {
        vectors[c] = V::splat(numbers[FIRST + c]);
    }
    vectors
}
