//! The units in which an estimator measures regressors that it was told nothing about.
//!
//! ```text
//! x_i = φ_i / s_i            what the recursion is given in the place of φ_i
//! s_i = |φ_i|/√Γ             when φ_i is first other than 0, then
//! s_i = (mean √(|φ_i|/√Γ))²  over all φ_i ≠ 0 so far, renewed after 2n, 4n, 8n, … samples
//! ```
//!
//! Whatever the recursion does then depends on x alone: no prediction depends on the units in which
//! a user writes φ, and every setting of a rule is a pure number. When the units are renewed by
//! r = s/s₊, P becomes S P S with S = diag(s₊/s) and θ becomes S θ: what they say of the parameters
//! is the same. Regressors count as they are when whitened by Γ, where it is given: P₀ then is as large
//! beside Γ as beside 1.
//!
//! Roots are averaged, not squares, so that values that are not typical count for little: a first value
//! a thousand times the others makes s 23 times too large after 8 samples and 1.06 times after 1000,
//! where a root mean square would be 350 and 32 times too large. Only x is summed, never φ, so that no
//! unit can overflow.

use crate::memory::state::{State, Visitor, MOST_SAMPLES};
use crate::memory::Memory;
use forgetting_kernels::kernel::units::{ScaleRows, SumRoots};
use forgetting_kernels::{Kernels, Real};

/// s, and what it is made from.
#[derive(Clone, Debug)]
pub(crate) struct Units<M: Memory> {
    memory: M,
    /// 1/s_i; 1 until φ_i has been other than 0
    reciprocals: M::Vector,
    /// Σ √|x_i| over the x_i ≠ 0
    roots: M::Vector,
    /// how many of them there were; 0 for a parameter whose regressor has always been 0
    counts: M::Vector,
    /// samples measured
    samples: u64,
    /// not state: s₊/s of a renewal
    ratios: M::Vector,
}

impl<M: Memory> Units<M> {
    /// Before the first sample: all units are 1.
    pub fn new(memory: M) -> Self {
        let mut reciprocals = memory.vector();
        reciprocals.as_mut().fill(M::Real::ONE);
        let (roots, counts, ratios) = (memory.vector(), memory.vector(), memory.vector());
        Self { memory, reciprocals, roots, counts, samples: 0, ratios }
    }

    /// 1/s_i
    pub fn reciprocals(&self) -> &[M::Real] {
        self.reciprocals.as_ref()
    }

    /// Whether regressor i has been other than 0.
    #[inline]
    fn has_unit(&self, i: usize) -> bool {
        self.counts.as_ref()[i] > M::Real::ZERO
    }

    /// How many of `most` samples can be measured before the units change: those before the first
    /// in which a regressor without a unit is other than 0, and before the next renewal.
    pub fn room(&self, phi: &[M::Real], most: usize) -> usize {
        let n = self.memory.parameters();
        let next = next_renewal(n as u64, self.samples);
        let left = (next - self.samples).min(most as u64) as usize;
        if (0..n).all(|i| self.has_unit(i)) {
            return left;
        }
        let is_new = |phi: &[M::Real]| (0..n).any(|i| phi[i] != M::Real::ZERO && !self.has_unit(i));
        let samples = phi.chunks_exact(n * self.memory.rows()).take(left);
        samples.take_while(|sample| !sample.chunks_exact(n).any(is_new)).count()
    }

    /// Chooses units for the regressors that have none and are other than 0 in the sample `phi`, of
    /// which √Γ is the `deviation`; `each` is told which, and 1/s_i.
    pub fn choose(
        &mut self,
        phi: &[M::Real],
        deviation: M::Real,
        mut each: impl FnMut(usize, M::Real),
    ) {
        let n = self.memory.parameters();
        for i in 0..n {
            if self.has_unit(i) {
                continue;
            }
            let column = phi.iter().skip(i).step_by(n);
            let largest = column.fold(M::Real::ZERO, |most, x| most.max(x.abs()));
            if largest > M::Real::ZERO && largest.is_finite() {
                let reciprocal = (deviation / largest).min(M::Real::CEILING).max(M::Real::FLOOR);
                self.reciprocals.as_mut()[i] = reciprocal;
                each(i, reciprocal);
            }
        }
    }

    /// Takes back what [`Units::choose`] chose, since the sample was refused; `each` is told for which
    /// parameters, and n.
    pub fn unchoose(&mut self, mut each: impl FnMut(usize, usize)) {
        let n = self.memory.parameters();
        for i in 0..n {
            if !self.has_unit(i) {
                self.reciprocals.as_mut()[i] = M::Real::ONE;
                each(i, n);
            }
        }
    }

    /// x for any number of rows φ.
    #[inline]
    pub fn measure(&self, phi: &[M::Real], measured: &mut [M::Real]) {
        measured.copy_from_slice(phi);
        self.express(measured);
    }

    /// Multiplies numbers, n after n, by 1/s: φ to x, or θ as the recursion has it to θ.
    #[inline]
    pub fn express(&self, rows: &mut [M::Real]) {
        M::Real::scale_rows(ScaleRows { rows, factors: self.reciprocals.as_ref() });
    }

    /// Takes note of the rows of `samples` samples as they were measured.
    #[inline]
    pub fn learn(&mut self, measured: &[M::Real], samples: u64) {
        let (roots, counts) = (self.roots.as_mut(), self.counts.as_mut());
        M::Real::sum_roots(SumRoots { rows: measured, roots, counts });
        self.samples += samples;
    }

    /// Takes note of one sample as it was measured, which is divided by its √Γ, `deviation`.
    #[inline]
    pub fn learn_one(&mut self, measured: &mut [M::Real], deviation: M::Real) {
        if deviation != M::Real::ONE {
            let reciprocal = M::Real::ONE / deviation;
            measured.iter_mut().for_each(|x| *x *= reciprocal);
        }
        self.learn(measured, 1);
    }

    /// The s₊/s of a renewal, if one is due after the last sample.
    pub fn due(&mut self) -> Option<&[M::Real]> {
        if !is_renewal(self.memory.parameters() as u64, self.samples) {
            return None;
        }
        let (roots, counts) = (self.roots.as_ref(), self.counts.as_ref());
        let reciprocals = self.reciprocals.as_ref();
        for (i, ratio) in self.ratios.as_mut().iter_mut().enumerate() {
            let mean = roots[i] / counts[i];
            // a mean that is not a number is that of no values
            let any = mean > M::Real::ZERO;
            *ratio = if any { within_range(mean * mean, reciprocals[i]) } else { M::Real::ONE };
        }
        Some(self.ratios.as_ref())
    }

    /// Makes the renewal that [`Units::due`] found.
    pub fn renew(&mut self) {
        let (roots, reciprocals) = (self.roots.as_mut(), self.reciprocals.as_mut());
        for (i, &ratio) in self.ratios.as_ref().iter().enumerate() {
            roots[i] /= ratio.sqrt();
            reciprocals[i] /= ratio;
        }
    }
}

/// s₊/s no further in one renewal than P can follow without leaving its range, nor 1/s₊.
fn within_range<T: Real>(ratio: T, reciprocal: T) -> T {
    let most = T::CEILING.sqrt().sqrt().sqrt();
    let (largest, smallest) = (most.min(reciprocal / T::FLOOR), reciprocal / T::CEILING);
    ratio.min(largest).max(smallest.max(T::ONE / most))
}

/// The number of samples after which units of n regressors are next renewed.
pub(crate) fn next_renewal(n: u64, samples: u64) -> u64 {
    (2 * n).saturating_mul((samples / (2 * n) + 1).next_power_of_two())
}

/// Whether they are renewed after so many.
pub(crate) fn is_renewal(n: u64, samples: u64) -> bool {
    samples.is_multiple_of(2 * n) && (samples / (2 * n)).is_power_of_two()
}

impl<M: Memory> State<M::Real> for Units<M> {
    fn visit(&mut self, visitor: &mut dyn Visitor<M::Real>) {
        visitor.reals(self.reciprocals.as_mut());
        visitor.reals(self.roots.as_mut());
        visitor.reals(self.counts.as_mut());
        visitor.whole(&mut self.samples);
    }

    fn is_sound(&self) -> bool {
        let sums = [self.roots.as_ref(), self.counts.as_ref()];
        // twice as far, for rounding
        let two = M::Real::ONE + M::Real::ONE;
        let in_range = |x: &M::Real| *x * two >= M::Real::FLOOR && *x <= M::Real::CEILING * two;
        self.samples <= MOST_SAMPLES
            && sums.iter().all(|sums| sums.iter().all(|x| *x >= M::Real::ZERO && x.is_finite()))
            && self.reciprocals.as_ref().iter().all(in_range)
    }
}
