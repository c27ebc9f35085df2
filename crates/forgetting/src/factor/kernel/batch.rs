//! Several samples in one sweep over U, for many parameters: a block of columns stays in the first
//! cache while all of them use it.
//!
//! Sample l of a batch needs of block j what sample l − 1 left there, and its own sums over the
//! blocks before: so the samples follow each other from block to block, each as if it were alone,
//! and give the bits that they would give one by one. Errors are not needed on the way; they are
//! found at the end, one after the other, each with the θ that the one before left.
//!
//! ```text
//! order:  … (0, j)  (2, j−1)  (1, j)  (3, j−1)  (0, j+1) …          (sample, block)
//! ```
//!
//! Neighbours in this order do not wait for each other: while the columns of one are swept, the
//! divisions of the next are under way.

use super::bierman::{grow, largest, Chain};
use super::block::{dots, rotate, rotate_and_dot, PerColumn};
use super::layout::{column, BLOCK};
use super::long::products;
use super::measure::Place;
use crate::factor::Measured;
use crate::vector::Vector;
use crate::Real;

/// The samples of a batch.
pub const BATCH: usize = 4;
/// Fewer parameters gain nothing.
pub const BATCH_FROM: usize = 40;

/// A batch on its way.
struct Sweep<'a, T> {
    columns: &'a mut [T],
    diagonal: &'a mut [T],
    /// BATCH times n
    gains: &'a mut [T],
    f: &'a [T],
    growth: T,
    n: usize,
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
    let mut sweep = Sweep {
        columns: &mut *place.columns,
        diagonal: &mut *place.diagonal,
        gains: &mut place.scratch[..BATCH * n],
        f,
        growth,
        n,
        w: [[T::ZERO; BLOCK]; BATCH],
        chains: [Chain::START; BATCH],
        largest: [T::ZERO; BATCH],
    };
    let end = n.next_multiple_of(BLOCK);
    let mut last = None;
    for start in (0..=end).step_by(BLOCK) {
        for sample in 0..BATCH / 2 {
            for (sample, block) in
                [(sample, start), (sample + BATCH / 2, start.wrapping_sub(BLOCK))]
            {
                if block < end {
                    let turn = sweep.turn::<V, GROUP>(sample, block);
                    if let Some(before) = last.replace(turn) {
                        sweep.sweep::<V, GROUP>(&before);
                    }
                }
            }
        }
    }
    if let Some(turn) = last {
        sweep.sweep::<V, GROUP>(&turn);
    }
    let Sweep { chains, largest, .. } = sweep;
    let mut measured = [Measured::default(); BATCH];
    for (l, measured) in measured.iter_mut().enumerate() {
        *measured = chains[l].with_largest(largest[l], growth > T::ONE);
    }
    measured
}

impl<T: Real> Sweep<'_, T> {
    /// The scalars of a sample in a block.
    #[inline(always)]
    fn turn<V: Vector<T>, const GROUP: usize>(&mut self, sample: usize, block: usize) -> Turn<T> {
        let width = BLOCK.min(self.n - block);
        if sample == 0 {
            self.w[0] = dots::<T, V, GROUP>(self.columns, block, width, &self.f[..self.n]);
        }
        let d = &mut self.diagonal[block..block + width];
        grow(d, self.growth);
        let (slope, v) = self.chains[sample].pass(d, &self.w[sample]);
        self.largest[sample] = self.largest[sample].max(largest(d));
        Turn { sample, block, slope, v }
    }

    /// The columns of a block after it.
    #[inline(always)]
    fn sweep<V: Vector<T>, const GROUP: usize>(&mut self, turn: &Turn<T>) {
        let Turn { sample, block, ref slope, ref v } = *turn;
        let (n, width) = (self.n, BLOCK.min(self.n - block));
        let k = &mut self.gains[sample * n..(sample + 1) * n];
        if sample + 1 < BATCH {
            let f = &self.f[(sample + 1) * n..(sample + 2) * n];
            self.w[sample + 1] =
                rotate_and_dot::<T, V, GROUP>(self.columns, block, width, (k, f), (slope, v));
        } else {
            rotate::<T, V, GROUP>(self.columns, block, width, k, (slope, v));
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
        let u = column(place.columns, j);
        sum += d * (T::ONE + products::<T, V>(u, u).1);
    }
    sum
}
