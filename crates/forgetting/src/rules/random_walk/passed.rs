//! What time adds: in a turn of a cycle, and after a gap.

use forgetting_kernels::Real;

/// Of what a long gap leaves of P, in rounding units: several products are rounded on the way.
const ROUNDING: f64 = 32.0;

/// What a turn of a cycle does.
#[derive(Clone, Copy, Debug)]
pub struct Turns<T> {
    /// κ^(r/2)
    pub scale: T,
    /// (1 − κʳ)/(1 − κ), r without a bound
    pub samples: T,
    /// r
    rank: f64,
    /// 1 − κ, 0 without a bound
    share: f64,
}

impl<T: Real> Turns<T> {
    /// Of a cycle of r = `rank` turns, each `elapsed` after the one before.
    #[inline]
    pub fn new(rank: f64, share: f64, elapsed: f64) -> Self {
        let passed = rank * elapsed;
        if !(share > 0.0) {
            return Self { scale: T::ONE, samples: T::from_f64(passed), rank, share };
        }
        let logarithm = passed * libm::log1p(-share);
        let scale = T::from_f64(libm::exp(0.5 * logarithm)).max(T::EPSILON);
        let samples = T::from_f64(-libm::expm1(logarithm) / share);
        Self { scale, samples, rank, share }
    }

    /// The same where so much time has passed since the last turn of the one before.
    #[inline]
    pub fn after(self, elapsed: T) -> Self {
        if elapsed == T::ONE {
            return self;
        }
        Self::new(self.rank, self.share, elapsed.to_f64())
    }
}

/// How many steps of Q are added in this time, where Q is this share of the bound, κ = 1 − share; 0
/// without a bound.
#[inline]
pub(crate) fn steps_after<T: Real>(share: f64, elapsed: T) -> T {
    if elapsed == T::ONE || !(share > 0.0) {
        return elapsed;
    }
    let kept = libm::exp(elapsed.to_f64() * libm::log1p(-share));
    // so much that rounding cannot make what is left of P negative
    let least = ROUNDING * T::EPSILON.to_f64();
    T::from_f64((1.0 - kept.max(least)) / share)
}
