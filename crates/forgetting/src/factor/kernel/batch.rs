//! Several samples in one sweep over U, for many parameters: a block of columns stays in the first
//! cache while all of them use it.
//!
//! Sample l of a batch needs of block j what sample l − 1 left there, and its own sums over the
//! blocks before: so the samples follow each other from block to block, each as if it were alone,
//! and give the bits that they would give one by one. Errors are not needed on the way; they are
//! found at the end, one after the other, each with the θ that the one before left.
//!
//! ```text
//! order:  … (0, j) and (2, j−1)   (1, j) and (3, j−1)   (0, j+1) and (2, j) …      (sample, block)
//! ```
//!
//! Two that are taken together do not wait for each other: their divisions are under way at the
//! same time.

use super::bierman::{grown, largest, Chain};
use super::layout::{column, BLOCK};
use super::long::products;
use super::measure::Place;
use super::tile::{block, block_mut, dots, put_eight, rotate, Long, LongMut, PerColumn};
use crate::factor::Measured;
use crate::vector::Vector;
use crate::Real;

/// The samples of a batch.
pub const BATCH: usize = 4;
/// Fewer parameters gain nothing.
pub const BATCH_FROM: usize = 40;

/// A batch on its way.
struct Sweep<'a, T: Real> {
    columns: &'a mut [T],
    diagonal: &'a mut [T],
    growth: T,
    f: [Long<'a, T>; BATCH],
    gains: [LongMut<'a, T>; BATCH],
    /// Uᵀf in the block that each sample comes to next
    w: [PerColumn<T>; BATCH],
    chains: [Chain<T>; BATCH],
    largest: [T; BATCH],
}

/// What a sample does to the columns of a block.
#[derive(Clone, Copy)]
struct Turn<T> {
    sample: usize,
    block: usize,
    slope: PerColumn<T>,
    v: PerColumn<T>,
}

/// P ← `growth`·P and P⁻¹ ← P⁻¹ + fᵀf for each of [`BATCH`] regressors `f` in turn; leaves each
/// P·fᵀ in the scratch, one after the other.
#[inline(always)]
pub fn measure_batch<T: Real, V: Vector<T>, const GROUP: usize>(
    place: &mut Place<'_, T>,
    growth: T,
    f: &[T],
) -> [Measured<T>; BATCH] {
    let n = place.diagonal.len();
    let mut gains = place.scratch[..BATCH * n].chunks_exact_mut(n);
    let mut sweep = Sweep {
        columns: &mut *place.columns,
        diagonal: &mut *place.diagonal,
        growth,
        f: core::array::from_fn(|l| Long::new(&f[l * n..(l + 1) * n])),
        gains: core::array::from_fn(|_| LongMut::zeros(gains.next().unwrap_or_default())),
        w: [[T::ZERO; BLOCK]; BATCH],
        chains: [Chain::START; BATCH],
        largest: [T::ZERO; BATCH],
    };
    let blocks = n.div_ceil(BLOCK);
    for b in 0..=blocks {
        for early in 0..BATCH / 2 {
            let pair = [(early, b), (early + BATCH / 2, b.wrapping_sub(1))];
            let mut turns = [None; 2];
            for (turn, (sample, b)) in turns.iter_mut().zip(pair) {
                if b < blocks {
                    *turn = Some(sweep.turn::<V, GROUP>(sample, b));
                }
            }
            for turn in turns.iter().flatten() {
                sweep.sweep::<V, GROUP>(turn);
            }
        }
    }
    let Sweep { chains, largest, gains, .. } = sweep;
    gains.into_iter().for_each(LongMut::finish);
    let measured = |l: usize| chains[l].with_largest(largest[l], growth > T::ONE);
    core::array::from_fn(measured)
}

impl<T: Real> Sweep<'_, T> {
    /// The scalars of a sample in a block.
    #[inline(always)]
    fn turn<V: Vector<T>, const GROUP: usize>(&mut self, sample: usize, b: usize) -> Turn<T> {
        if sample == 0 {
            self.w[0] = dots::<T, V, GROUP>(block(self.columns, b), &self.f[0]);
        }
        let mut d = grown(self.diagonal, b, self.growth);
        let (slope, v) = self.chains[sample].pass(&mut d, &self.w[sample]);
        put_eight(self.diagonal, b, &d);
        self.largest[sample] = self.largest[sample].max(largest(&d));
        Turn { sample, block: b, slope, v }
    }

    /// The columns of a block after it.
    #[inline(always)]
    fn sweep<V: Vector<T>, const GROUP: usize>(&mut self, turn: &Turn<T>) {
        let Turn { sample, block: b, ref slope, ref v } = *turn;
        let (block, k) = (block_mut(self.columns, b), &mut self.gains[sample]);
        if sample + 1 < BATCH {
            rotate::<T, V, GROUP>(block, k, (slope, v));
            self.w[sample + 1] = dots::<T, V, GROUP>(block, &self.f[sample + 1]);
        } else {
            rotate::<T, V, GROUP>(block, k, (slope, v));
        }
    }
}

/// Whether none of [`BATCH`] samples can be refused; if so, the bound of P's trace follows.
///
/// The errors are not known yet. Bounds of θ and of the gains, ‖K‖ ≤ ½ √tr P, bound them.
#[inline(always)]
pub fn admits<T: Real, V: Vector<T>>(
    place: &mut Place<'_, T>,
    growth: T,
    f: &[T],
    y: &[T],
    theta: &[T],
) -> bool {
    let mut bound = *place.bound;
    for _ in 0..BATCH {
        bound *= growth;
    }
    let length = products::<T, V>(theta, theta).1.sqrt();
    let mut squares = [T::ZERO; BATCH];
    for (square, f) in squares.iter_mut().zip(f.chunks_exact(theta.len())) {
        *square = products::<T, V>(f, theta).1;
    }
    let admits = bound < T::CEILING
        && (are_small(bound, &squares, y, length)
            || are_small(trace::<T, V>(place) * (bound / *place.bound), &squares, y, length));
    if admits {
        *place.bound = bound;
    }
    admits
}

/// Whether all errors are, for a P of at most this trace and a θ of this length.
#[inline(always)]
fn are_small<T: Real>(trace: T, squares: &[T; BATCH], y: &[T], mut length: T) -> bool {
    // a margin for the rounding of what is compared
    let (limit, gain) = (T::CEILING * T::from_f64(0.25), trace.sqrt());
    let mut small = true;
    for (&squares, y) in squares.iter().zip(y) {
        let error = y.abs() + squares.sqrt() * length;
        length += gain * error;
        // false for NaN
        small &= (squares <= T::CEILING) & (error <= limit);
    }
    small
}

/// The trace of P.
#[inline(never)]
fn trace<T: Real, V: Vector<T>>(place: &Place<'_, T>) -> T {
    let mut sum = T::ZERO;
    for (j, &d) in place.diagonal.iter().enumerate() {
        let squares =
            column(place.columns, j).fold(T::ONE, |sum, u| sum + products::<T, V>(u, u).1);
        sum += d * squares;
    }
    sum
}
