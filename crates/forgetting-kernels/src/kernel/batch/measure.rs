//! What the samples of a batch do, column by column: no sweep over U, O(n).

use super::{change, PerSample, Room, BATCH, V, W_THEN_SLOPE};
use crate::kernel::bierman::{above_floor, largest_of, Chain};
use crate::kernel::measured::Measured;
use crate::kernel::tiles::change_row;
use crate::number::block_vector::BlockVector;
use crate::number::Real;

impl<T: Real> Room<'_, T> {
    /// P ← `growth`·P, then P⁻¹ ← P⁻¹ + fᵀf, for one sample after the other; `shared` becomes f·k of
    /// each with those before it. None if D falls below its floor.
    #[inline(always)]
    pub fn measure<E: BlockVector<T>, const GROUP: usize>(
        &mut self,
        growth: T,
        shared: &mut PerSample<PerSample<T>>,
    ) -> Option<PerSample<Measured<T>>> {
        if GROUP >= 8 && self.d.len() == 2 {
            return self.measure_in_registers::<E, 2>(growth, shared);
        }
        Some([
            self.measure_next::<E, 0>(growth, &mut shared[0])?,
            self.measure_next::<E, 1>(growth, &mut shared[1])?,
            self.measure_next::<E, 2>(growth, &mut shared[2])?,
            self.measure_next::<E, 3>(growth, &mut shared[3])?,
        ])
    }

    /// Sample `L`, after those before it.
    #[inline(always)]
    fn measure_next<E: BlockVector<T>, const L: usize>(
        &mut self,
        growth: T,
        shared: &mut PerSample<T>,
    ) -> Option<Measured<T>> {
        let (factor, zero) = (E::splat(growth), E::splat(T::ZERO));
        let (mut chain, mut most, mut less_least) = (Chain::start(), zero, -E::splat(T::CEILING));
        let mut sums = [zero; L];
        for b in 0..self.d.len().min(self.changes.len()) {
            let (d, changes) = (&mut self.d[b], &mut self.changes[b]);
            let mut w = E::read(&changes[L][W_THEN_SLOPE]);
            for m in 0..L {
                w = change(&changes[m]).change_row(w, &mut sums[m]);
            }
            let pass = chain.pass(E::read(d) * factor, w);
            pass.slope.write(&mut changes[L][W_THEN_SLOPE]);
            pass.v.write(&mut changes[L][V]);
            pass.d.write(d);
            (most, less_least) = (most.max(pass.d), less_least.max(-pass.d));
        }
        for m in 0..L {
            shared[m] = sums[m].numbers()[0];
        }
        let measured = chain.measured(largest_of(&most.numbers()), growth > T::ONE);
        above_floor(less_least).then_some(measured)
    }

    /// All samples, for `B` blocks that fit the registers: what a sample does to those after it is done
    /// at once, and nothing waits for memory.
    #[inline(always)]
    fn measure_in_registers<E: BlockVector<T>, const B: usize>(
        &mut self,
        growth: T,
        shared: &mut PerSample<PerSample<T>>,
    ) -> Option<PerSample<Measured<T>>> {
        let (factor, zero) = (E::splat(growth), E::splat(T::ZERO));
        let (mut d, mut w) = ([zero; B], [[zero; B]; BATCH]);
        for b in 0..B {
            d[b] = E::read(&self.d[b]);
            for l in 0..BATCH {
                w[l][b] = E::read(&self.changes[b][l][W_THEN_SLOPE]);
            }
        }
        let (mut measured, mut less_least) = ([Measured::default(); BATCH], -E::splat(T::CEILING));
        for l in 0..BATCH {
            let (mut chain, mut most, mut changes) = (Chain::start(), zero, [(zero, zero); B]);
            for b in 0..B {
                let pass = chain.pass(d[b] * factor, w[l][b]);
                pass.slope.write(&mut self.changes[b][l][W_THEN_SLOPE]);
                pass.v.write(&mut self.changes[b][l][V]);
                (changes[b], d[b]) = ((pass.slope, pass.v), pass.d);
                (most, less_least) = (most.max(pass.d), less_least.max(-pass.d));
            }
            for later in l + 1..BATCH {
                let mut x = zero;
                for b in 0..B {
                    w[later][b] = change_row(w[later][b], changes[b], &mut x);
                }
                shared[later][l] = x.numbers()[0];
            }
            measured[l] = chain.measured(largest_of(&most.numbers()), growth > T::ONE);
        }
        for b in 0..B {
            d[b].write(&mut self.d[b]);
        }
        above_floor(less_least).then_some(measured)
    }
}
