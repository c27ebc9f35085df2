//! Rank-one changes of P as they change the columns of a block, several of them one after the
//! other with one load and one store of each column.

use super::{LongMut, PerColumn, Tile, BLOCK};
use crate::number::eight::Eight;
use crate::number::vector::Vector;
use crate::number::Real;

/// What a rank-one change of P does to the columns of a block, from the left:
/// u ← u + slope x and x ← x + factor u, each with the other of before.
///
/// x starts with 0 above the first column; Bierman's is the gain.
#[derive(Clone, Copy)]
pub struct Turn<'a, T> {
    pub slope: &'a PerColumn<T>,
    pub factor: &'a PerColumn<T>,
}

impl<T: Real> Turn<'_, T> {
    /// The same of a row `w` below the columns, with its x, in all lanes, up to here.
    #[inline(always)]
    pub fn turn_row<E: Eight<T>>(&self, w: E, x: &mut E) -> E {
        let sums = *x + (E::read(self.factor) * w).running_sums();
        let turned = E::read(self.slope).mul_add(sums.before(*x), w);
        *x = sums.last();
        turned
    }
}

/// The x of `R` changes.
pub trait Xs<T: Real, const R: usize> {
    /// Beside the tiles of row `t`.
    fn load<V: Vector<T>>(&self, t: usize) -> [V; R];
    /// Puts them back.
    fn store<V: Vector<T>>(&mut self, t: usize, xs: [V; R]);
}

impl<T: Real> Xs<T, 1> for LongMut<'_, T> {
    #[inline(always)]
    fn load<V: Vector<T>>(&self, t: usize) -> [V; 1] {
        [V::load(self.chunk(t))]
    }
    #[inline(always)]
    fn store<V: Vector<T>>(&mut self, t: usize, [x]: [V; 1]) {
        x.store(self.chunk_mut(t));
    }
}

impl<T: Real, const R: usize> Xs<T, R> for [[T::Chunk; R]] {
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

/// Each of `turns` in turn, with its own x of `xs`, for the columns of block `b`.
#[inline(always)]
pub fn turn_columns<T, V, X, const GROUP: usize, const R: usize>(
    (block, b): (&mut [Tile<T>], usize),
    xs: &mut X,
    turns: &[Turn<'_, T>; R],
) where
    T: Real,
    V: Vector<T>,
    X: Xs<T, R> + ?Sized,
{
    if GROUP >= 8 || R > 2 {
        columns::<T, V, X, R, 8, 0>((block, b), xs, turns);
    } else {
        columns::<T, V, X, R, 4, 0>((block, b), xs, turns);
        columns::<T, V, X, R, 4, 4>((block, b), xs, turns);
    }
}

#[inline(always)]
fn columns<T, V, X, const R: usize, const C: usize, const FIRST: usize>(
    (block, b): (&mut [Tile<T>], usize),
    xs: &mut X,
    turns: &[Turn<'_, T>; R],
) where
    T: Real,
    V: Vector<T>,
    X: Xs<T, R> + ?Sized,
{
    let Some((last, above)) = block.split_last_mut() else { return };
    for (t, tile) in above.iter_mut().enumerate() {
        let x = turn_tile::<T, V, R, C, FIRST>(tile, xs.load(t), turns);
        xs.store(t, x);
    }
    let mut x = xs.load::<V>(above.len());
    if FIRST == 0 && (b * BLOCK).is_multiple_of(T::ROWS) {
        // the rows of the diagonal: before their first column x is 0, whatever the buffer holds
        x = [V::splat(T::ZERO); R];
    }
    let x = turn_tile::<T, V, R, C, FIRST>(last, x, turns);
    xs.store(above.len(), x);
}

#[inline(always)]
fn turn_tile<T: Real, V: Vector<T>, const R: usize, const C: usize, const FIRST: usize>(
    tile: &mut Tile<T>,
    mut x: [V; R],
    turns: &[Turn<'_, T>; R],
) -> [V; R] {
    // in pairs: between two of them nothing changes its register
    for c in (FIRST..FIRST + C).step_by(2) {
        turn_column(&mut tile[c], &mut x, turns, c);
        turn_column(&mut tile[c + 1], &mut x, turns, c + 1);
    }
    x
}

#[inline(always)]
fn turn_column<T: Real, V: Vector<T>, const R: usize>(
    column: &mut T::Chunk,
    x: &mut [V; R],
    turns: &[Turn<'_, T>; R],
    c: usize,
) {
    let mut u = V::load(column);
    for r in 0..R {
        let before = u;
        u = V::splat(turns[r].slope[c]).mul_add(x[r], u);
        x[r] = V::splat(turns[r].factor[c]).mul_add(before, x[r]);
    }
    u.store(column);
}
