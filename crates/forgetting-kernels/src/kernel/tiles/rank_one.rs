//! Rank-one changes of P as they change the columns of a block, several of them one after the
//! other with one load and one store of each column.

use super::{LongMut, PerColumn, Tile, BLOCK};
use crate::number::block_vector::BlockVector;
use crate::number::vector::Vector;
use crate::number::Real;
use core::ops::Range;

/// A rank-one change of P on a block, column by column from the left: u' = u + slope·x, x' = x + factor·u,
/// both from the old values.
///
/// x is 0 above the first column of U; Bierman's is the gain.
#[derive(Clone, Copy)]
pub struct RankOne<'a, T> {
    pub slope: &'a PerColumn<T>,
    pub factor: &'a PerColumn<T>,
}

impl<T: Real> RankOne<'_, T> {
    /// [`change_row`] with numbers that are in memory.
    #[inline(always)]
    pub fn change_row<E: BlockVector<T>>(&self, w: E, x: &mut E) -> E {
        change_row(w, (E::read(self.slope), E::read(self.factor)), x)
    }
}

/// The same change of `w`, one row across the block; `x` is carried along, the same in every lane.
#[inline(always)]
pub fn change_row<T: Real, E: BlockVector<T>>(w: E, (slope, factor): (E, E), x: &mut E) -> E {
    let sums = *x + (factor * w).running_sums();
    let changed = slope.mul_add(sums.before(*x), w);
    *x = sums.last();
    changed
}

/// The x of `R` changes, which are carried from block to block.
pub trait Carried<T: Real, const R: usize> {
    /// Beside the tiles of row `t`.
    fn load<V: Vector<T>>(&self, t: usize) -> [V; R];
    /// Puts them back.
    fn store<V: Vector<T>>(&mut self, t: usize, xs: [V; R]);
}

impl<T: Real> Carried<T, 1> for LongMut<'_, T> {
    #[inline(always)]
    fn load<V: Vector<T>>(&self, t: usize) -> [V; 1] {
        [V::load(self.chunk(t))]
    }
    #[inline(always)]
    fn store<V: Vector<T>>(&mut self, t: usize, [x]: [V; 1]) {
        x.store(self.chunk_mut(t));
    }
}

impl<T: Real, const R: usize> Carried<T, R> for [[T::Chunk; R]] {
    #[inline(always)]
    fn load<V: Vector<T>>(&self, t: usize) -> [V; R] {
        let mut xs = [V::splat(T::ZERO); R];
        for r in 0..R {
            xs[r] = V::load(&self[t][r]);
        }
        xs
    }
    #[inline(always)]
    fn store<V: Vector<T>>(&mut self, t: usize, xs: [V; R]) {
        for r in 0..R {
            xs[r].store(&mut self[t][r]);
        }
    }
}

/// Each of `changes` in turn, with its own x of `xs`, for the columns of block `b`.
#[inline(always)]
pub fn change_columns<T, V, X, const GROUP: usize, const R: usize>(
    (block, b): (&mut [Tile<T>], usize),
    xs: &mut X,
    changes: &[RankOne<'_, T>; R],
) where
    T: Real,
    V: Vector<T>,
    X: Carried<T, R> + ?Sized,
{
    let all = block.len();
    if GROUP >= 8 && R > 1 {
        // a number in a register serves two tiles
        let single = all % 2;
        columns::<T, V, X, R, 8, 0, 1>((block, b), 0..single, xs, changes);
        columns::<T, V, X, R, 8, 0, 2>((block, b), single..all, xs, changes);
    } else if GROUP >= 8 || R > 2 {
        columns::<T, V, X, R, 8, 0, 1>((block, b), 0..all, xs, changes);
    } else {
        columns::<T, V, X, R, 4, 0, 1>((block, b), 0..all, xs, changes);
        columns::<T, V, X, R, 4, 4, 1>((block, b), 0..all, xs, changes);
    }
}

/// `C` columns from `FIRST` on, in these tiles of block `b`, `W` at a time.
#[inline(always)]
fn columns<T, V, X, const R: usize, const C: usize, const FIRST: usize, const W: usize>(
    (block, b): (&mut [Tile<T>], usize),
    tiles: Range<usize>,
    xs: &mut X,
    changes: &[RankOne<'_, T>; R],
) where
    T: Real,
    V: Vector<T>,
    X: Carried<T, R> + ?Sized,
{
    // the rows of the diagonal: before their first column x is 0, whatever the buffer holds
    let (last, fresh) = (block.len() - 1, FIRST == 0 && (b * BLOCK).is_multiple_of(T::ROWS));
    let mut t = tiles.start;
    for tiles in block[tiles].as_chunks_mut::<W>().0 {
        let mut x = [[V::splat(T::ZERO); R]; W];
        for w in 0..W {
            if !(fresh && t + w == last) {
                x[w] = xs.load(t + w);
            }
        }
        for c in FIRST..FIRST + C {
            change_column(tiles, &mut x, changes, c);
        }
        for w in 0..W {
            xs.store(t + w, x[w]);
        }
        t += W;
    }
}

/// Column c in `W` tiles.
#[inline(always)]
fn change_column<T: Real, V: Vector<T>, const R: usize, const W: usize>(
    tiles: &mut [Tile<T>; W],
    x: &mut [[V; R]; W],
    changes: &[RankOne<'_, T>; R],
    c: usize,
) {
    let mut u = [V::splat(T::ZERO); W];
    for w in 0..W {
        u[w] = V::load(&tiles[w][c]);
    }
    for r in 0..R {
        let (slope, factor) = (V::splat(changes[r].slope[c]), V::splat(changes[r].factor[c]));
        for w in 0..W {
            let before = u[w];
            u[w] = slope.mul_add(x[w][r], before);
            x[w][r] = factor.mul_add(before, x[w][r]);
        }
    }
    for w in 0..W {
        u[w].store(&mut tiles[w][c]);
    }
}
