//! The direction with the largest variance, each parameter scaled by the smallest standard
//! deviation it has had.

use super::{FACTOR, LASTING, RECOVERY, SHARE};
use crate::covariance::Factor;
use crate::memory::state::{is_finite, State, Visitor};
use crate::memory::Memory;
use forgetting_kernels::kernel::functions::dot;
use forgetting_kernels::kernel::watch::Gauge;
use forgetting_kernels::Real;

/// w, its variance, and the information that it gets.
#[derive(Clone, Debug)]
pub(super) struct Weakest<M: Memory> {
    bounded: bool,
    /// s²
    pub least: M::Vector,
    /// S w, so that φ̃ w is φ̄ times it
    axis: M::Vector,
    /// the same with length 1
    pub direction: M::Vector,
    /// a buffer: S w of the block before
    before: M::Vector,
    /// σ²
    variance: M::Real,
    /// the variance in P along the direction
    pub spread: M::Real,
    /// σ² when w was last informed
    reference: M::Real,
    /// Σ (φ̃ w)² in this block and in the one before
    information: [M::Real; 2],
    /// Σ (φ̃ w) φ̄ in this block
    products: M::Vector,
}

impl<M: Memory> Weakest<M> {
    /// Of this P with these `variances`; `bounded` if the rule bounds it without excitation.
    pub fn new(factor: &Factor<M>, variances: &[M::Real], bounded: bool) -> Self {
        let (memory, zero) = (factor.memory(), M::Real::ZERO);
        let mut weakest = Self {
            bounded,
            least: memory.vector(),
            axis: memory.vector(),
            direction: memory.vector(),
            before: memory.vector(),
            variance: zero,
            spread: zero,
            reference: zero,
            information: [zero; 2],
            products: memory.vector(),
        };
        weakest.least.as_mut().copy_from_slice(variances);
        for (x, &variance) in weakest.axis.as_mut().iter_mut().zip(variances) {
            *x = variance.sqrt();
        }
        weakest.iterate(factor, variances, 0);
        weakest.reference = weakest.variance;
        weakest
    }

    /// Whether it has wound up.
    #[inline]
    pub fn windup(&self) -> bool {
        self.has_grown() && !self.is_informed()
    }

    /// Whether its variance has grown by more than the factor, and is not bounded.
    #[inline]
    fn has_grown(&self) -> bool {
        !self.bounded && self.variance > M::Real::from_f64(FACTOR) * self.reference
    }

    /// Whether it gets enough information now.
    #[inline]
    pub fn is_informed(&self) -> bool {
        (self.information[0] + self.information[1]) * self.variance >= self.needed()
    }

    /// Whether its variance is so far above the reference that information alone does not make it
    /// the new one.
    #[inline]
    pub fn is_far(&self, variance: M::Real) -> bool {
        variance > M::Real::from_f64(LASTING) * self.reference
    }

    /// σ² over what it was when w was last informed: 1 while it is, unless it is still far above.
    pub fn growth(&self, ever_informed: bool) -> M::Real {
        let far = ever_informed && self.is_far(self.variance);
        if self.is_informed() && !far {
            return M::Real::ONE;
        }
        self.variance / self.reference
    }

    /// The share of information from which on w counts as informed: the further it has wound up,
    /// the larger.
    #[inline]
    fn needed(&self) -> M::Real {
        let (share, recovery) = (M::Real::from_f64(SHARE), M::Real::from_f64(RECOVERY));
        if self.bounded {
            return share;
        }
        let excess = self.variance / (M::Real::from_f64(FACTOR) * self.reference);
        (share * excess).max(share).min(recovery)
    }

    /// What the kernel needs of it.
    #[inline]
    pub fn gauge(&mut self) -> Gauge<'_, M::Real> {
        Gauge {
            variance: self.variance,
            needed: if self.has_grown() { self.needed() } else { M::Real::ZERO },
            information: &mut self.information,
            axis: self.axis.as_ref(),
            products: self.products.as_mut(),
        }
    }

    /// Finds w for the next block, after so many samples; returns whether it was informed in this
    /// one. `ever_informed` if it was in any before: else the reference is the initial variance,
    /// which says nothing of what is normal.
    pub fn end_block(
        &mut self,
        factor: &Factor<M>,
        variances: &[M::Real],
        samples: u64,
        ever_informed: bool,
    ) -> bool {
        let (before, needed) = (self.variance, self.needed());
        let along = self.information[0];
        let same = self.iterate(factor, variances, samples);
        let (last, informed) = if same && along > M::Real::ZERO {
            // by Cauchy and Schwarz, Σ (φ̃ w)² of the new w is at least this; information that was
            // enough for the old w may be too little for the new one, with its larger variance
            let shared = dot(self.products.as_ref(), self.axis.as_ref());
            let last = (shared * (shared / along)).min(M::Real::CEILING);
            (last, last * self.variance >= self.needed())
        } else {
            let informed = along * before >= needed;
            (if informed { along } else { M::Real::ZERO }, informed)
        };
        if informed && !(ever_informed && self.is_far(before)) {
            // no direction had a larger variance before
            self.reference = before;
        }
        self.reference = self.reference.min(self.variance);
        self.information = [M::Real::ZERO, last];
        self.products.as_mut().fill(M::Real::ZERO);
        informed
    }

    /// Goes on in other units: P ← S P S with S = diag(`ratios`). All of w is as it was.
    pub fn change_units(&mut self, ratios: &[M::Real]) {
        let parts = self.least.as_mut().iter_mut().zip(self.axis.as_mut()).zip(ratios);
        for ((least, axis), &ratio) in parts {
            *least = (*least * ratio * ratio).max(M::Real::FLOOR);
            *axis *= ratio;
        }
        for (product, &ratio) in self.products.as_mut().iter_mut().zip(ratios) {
            *product /= ratio;
        }
        self.direction.as_mut().copy_from_slice(self.axis.as_ref());
        normalize(self.direction.as_mut(), |x| dot(x, x));
    }

    /// A step of the power iteration; returns whether w is still about the same. O(n²).
    fn iterate(&mut self, factor: &Factor<M>, variances: &[M::Real], samples: u64) -> bool {
        let (before, direction) = (self.before.as_mut(), self.direction.as_mut());
        for (least, &now) in self.least.as_mut().iter_mut().zip(variances) {
            *least = least.min(now).max(M::Real::FLOOR);
        }
        before.copy_from_slice(self.axis.as_ref());
        let (axis, least) = (self.axis.as_mut(), self.least.as_ref());
        iterate_axis(factor, axis, [before, least], direction, samples);
        for ((u, &x), &least) in direction.iter_mut().zip(axis.iter()).zip(least) {
            *u = x / least;
        }
        let overlap = dot(direction, before);
        let variance = factor.leverage(direction);
        // written so that a NaN becomes the ceiling
        let fits = variance <= M::Real::CEILING;
        self.variance = if fits { variance } else { M::Real::CEILING };
        direction.copy_from_slice(axis);
        normalize(direction, |x| dot(x, x));
        self.spread = factor.leverage(direction);
        overlap * overlap > M::Real::from_f64(0.8)
    }
}

impl<M: Memory> State<M::Real> for Weakest<M> {
    fn visit(&mut self, visitor: &mut dyn Visitor<M::Real>) {
        for vector in [&mut self.least, &mut self.axis, &mut self.direction, &mut self.products] {
            visitor.reals(vector.as_mut());
        }
        visitor.reals(&mut self.information);
        for number in [&mut self.variance, &mut self.spread, &mut self.reference] {
            visitor.reals(core::slice::from_mut(number));
        }
    }

    fn is_sound(&self) -> bool {
        let zero = M::Real::ZERO;
        let parts = self.axis.as_ref().iter().zip(self.least.as_ref());
        let length = parts.fold(zero, |sum, (&x, &least)| sum + x * (x / least));
        is_finite(self)
            && self.least.as_ref().iter().all(|&least| least >= M::Real::FLOOR)
            && self.information.iter().all(|&x| x >= zero)
            && self.variance > zero
            && self.reference > zero
            && self.spread >= zero
            && length >= M::Real::from_f64(0.5)
            && length <= M::Real::CEILING
    }
}

/// S w ← S P̃ w / ‖P̃ w‖ = P S⁻¹w / ‖S⁻¹P S⁻¹w‖ in `axis`, which is `before`; uses `work`.
fn iterate_axis<M: Memory>(
    factor: &Factor<M>,
    axis: &mut [M::Real],
    [before, least]: [&[M::Real]; 2],
    work: &mut [M::Real],
    samples: u64,
) {
    // with a little of every axis in it the iteration cannot miss a direction for ever
    let nudge = M::Real::EPSILON.sqrt();
    for (i, (u, (&x, &least))) in work.iter_mut().zip(axis.iter().zip(least)).enumerate() {
        let up = (samples >> (i % 32)) & 1 == 0;
        let s = least.sqrt();
        *u = (x + nudge * if up { s } else { -s }) / least;
    }
    factor.multiply(work, axis);
    let squares = |x: &[M::Real]| {
        x.iter().zip(least).fold(M::Real::ZERO, |sum, (&x, &least)| sum + x * x / least)
    };
    if !normalize(axis, squares) {
        axis.copy_from_slice(before);
    }
}

/// Scales x to length 1; false, and x as it was, if it has no length.
fn normalize<T: Real>(x: &mut [T], squared_length: impl Fn(&[T]) -> T) -> bool {
    let largest = x.iter().fold(T::ZERO, |largest, x| largest.max(x.abs()));
    let inverse = T::ONE / largest;
    if !(inverse > T::ZERO && inverse.is_finite()) {
        return false;
    }
    // first so that no square overflows
    x.iter_mut().for_each(|x| *x *= inverse);
    let inverse = T::ONE / squared_length(x).sqrt();
    x.iter_mut().for_each(|x| *x *= inverse);
    true
}
