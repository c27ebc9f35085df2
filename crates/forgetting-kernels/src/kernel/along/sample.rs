//! What a sample does, column by column: no sweep over U, O(n).

use super::super::bierman::{above_floor, largest_of, Chain, Pass};
use super::{z_of, z_of_mut, Room};
use super::{D, LATER, Q, SLOPE, V, V_OVER_A, W, WIDENED, WIDENING, Z_OVER_T};
use crate::kernel::measured::Measured;
use crate::kernel::tiles::RankOne;
use crate::number::block_vector::BlockVector;
use crate::number::Real;

/// Sums of the first sample's changes along the row of a second one, in all lanes.
type Shared<E> = [E; 2];

impl<T: Real, const B: usize, const R: usize> Room<'_, T, B, R> {
    /// fᵀPf of sample l, with the P of before.
    #[inline(always)]
    pub fn leverage<E: BlockVector<T>>(&self, l: usize) -> T {
        let mut sum = E::splat(T::ZERO);
        for b in 0..self.of_all.len().min(self.of_one.len()) {
            let w = E::read(&self.of_one[b][l][W]);
            sum = (E::read(&self.of_all[b][D]) * w).mul_add(w, sum);
        }
        sum.running_sums().last().numbers()[0]
    }

    /// fᵀP⁻¹f of sample L, after what the first sample does.
    #[inline(always)]
    pub fn information<E: BlockVector<T>, const L: usize>(&mut self) -> T {
        let zero = E::splat(T::ZERO);
        let (mut sum, mut sums_of_first) = (zero, [zero; 2]);
        for (b, all) in self.of_all.iter_mut().enumerate().rev() {
            let at = z_of_mut(self.z, L, b);
            let mut z = E::read(at);
            if L > 0 {
                let [widened, measured] = &mut sums_of_first;
                z = change_back(z, (-E::read(&all[Z_OVER_T]), E::read(&all[Q])), widened);
                z = change_back(z, (E::read(&all[V_OVER_A]), E::read(&all[WIDENED])), measured);
                z.write(at);
            }
            let q = z / E::read(&all[D]);
            let sums = sum + (z * q).remaining_sums();
            q.write(&mut all[Q]);
            sums.after(sum).write(&mut all[LATER]);
            sum = sums.first();
        }
        sum.numbers()[0]
    }

    /// P ← P + c·fᵀf with t = 1/c, f of this information in P⁻¹, then P⁻¹ ← P⁻¹ + fᵀf, for sample L; f·k of the first sample, too,
    /// and whether no D falls below its floor.
    #[inline(always)]
    pub fn add_and_measure<E: BlockVector<T>, const L: usize>(
        &mut self,
        t: T,
        information: T,
    ) -> (Measured<T>, T, bool) {
        // 1/t_j of the column before the first
        let mut before = E::splat(T::ONE / (t + information));
        let (t, zero, one) = (E::splat(t), E::splat(T::ZERO), E::splat(T::ONE));
        let (mut chain, mut p) = (Chain::start(), zero);
        let (mut most, mut less_least) = (zero, -E::splat(T::CEILING));
        let mut shared: Shared<E> = [zero; 2];
        for b in 0..self.of_all.len().min(self.of_one.len()) {
            let (all, own) = (&mut self.of_all[b], &mut self.of_one[b]);
            let mut w = E::read(&own[L][W]);
            if L > 0 {
                let change = RankOne { slope: &own[0][WIDENING], factor: z_of(self.z, 0, b) };
                w = change.change_row(w, &mut shared[0]);
                let change = RankOne { slope: &own[0][SLOPE], factor: &own[0][V] };
                w = change.change_row(w, &mut shared[1]);
            }
            let (at, q) = (z_of(self.z, L, b), E::read(&all[Q]));
            let (z, inverse_t) = (E::read(at), one / (t + E::read(&all[LATER])));
            // t_j + z_j q_j is that of the column before
            (q * inverse_t.before(before)).write(&mut own[L][WIDENING]);
            before = inverse_t.last();
            let z_over_t = z * inverse_t;
            let d = z_over_t.mul_add(z, E::read(&all[D]));
            let change = RankOne { slope: &own[L][WIDENING], factor: at };
            w = change.change_row(w, &mut p);
            let Pass { d, slope, v, inverse } = chain.pass(d, w);
            (most, less_least) = (most.max(d), less_least.max(-d));
            d.write(&mut all[D]);
            slope.write(&mut own[L][SLOPE]);
            v.write(&mut own[L][V]);
            if L + 1 < B {
                z_over_t.write(&mut all[Z_OVER_T]);
                w.write(&mut all[WIDENED]);
                (v * inverse).write(&mut all[V_OVER_A]);
            }
        }
        let measured = chain.measured(largest_of(&most.numbers()), true);
        (measured, shared[1].numbers()[0], above_floor(less_least))
    }
}

/// z_j + factor_j Σ_{i>j} slope_i z_i; `sum` is that of the columns after these, in all lanes.
#[inline(always)]
fn change_back<T: Real, E: BlockVector<T>>(z: E, (factor, slope): (E, E), sum: &mut E) -> E {
    let sums = *sum + (slope * z).remaining_sums();
    let changed = factor.mul_add(sums.after(*sum), z);
    *sum = sums.first();
    changed
}
