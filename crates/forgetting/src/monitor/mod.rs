//! Watches an estimator while it runs: windup, excitation, noise and whiteness, in O(n) a sample.
//!
//! ```text
//! units               s_i² = min P_ii so far, P̃ = S⁻¹ P S⁻¹, φ̃ = φ̄ S, S = diag(s)
//! weakest direction   w ← P̃ w / ‖P̃ w‖ at the end of each block (power iteration), σ² = wᵀ P̃ w
//! informed            σ² Σ (φ̃ w)² ≥ share, over this block of samples and the one before
//! windup              σ² > factor · (σ² when w was last informed), and w is not informed
//! excited             parameter i is when N φ̄_i² P_ii ≥ share, P_ii as of the last block
//! noise variance      mean of ē² / (1 + φ̄P̄φ̄ᵀ) where φ̄P̄φ̄ᵀ ≤ 1, weighted with the products of λ
//! whiteness           lag-one correlation of ē / √(1 + φ̄P̄φ̄ᵀ), with the same weights
//! ```
//!
//! A direction has wound up when its variance is more than ten times what it was when it last
//! received information, it receives none now, and the rule sets it no bound. The further it has
//! wound up, the larger is the share asked for to end that, up to what holds the variance where it
//! is: beside a large variance the noise of a regressor tells something, too. The one to watch is
//! the largest eigenvector of P in units of what each parameter was known by at its best: whatever
//! winds up becomes it, whichever units the parameters have. A block is N = max(10, 2n, half the
//! memory) samples, so that what costs O(n²) is spread over as many samples.

use crate::state::{is_finite, State, Visitor};
use crate::{Factor, Memory, Real};
use forgetting_kernels::kernel::watch::{Observation, Observations, Residual, Silence, Watch};
use forgetting_kernels::Kernels;
use weakest::Weakest;

#[cfg(feature = "alloc")]
mod information_window;
mod weakest;

#[cfg(feature = "alloc")]
pub use information_window::InformationWindow;

/// Growth of the variance of a silent direction that counts as windup.
pub const FACTOR: f64 = 10.0;
/// Part of its own variance that a direction must be able to tell to count as informed.
pub const SHARE: f64 = 0.01;
/// The same for a direction that has wound up by far. Where a block's information and forgetting
/// balance it is about one half.
pub const RECOVERY: f64 = 0.3;

/// The state of the watch.
#[derive(Clone, Debug)]
pub struct Monitor<M: Memory> {
    weakest: Weakest<M>,
    residual: Residual<M::Real>,
    /// N
    length: M::Real,
    in_block: u64,
    samples: u64,
    /// samples up to when the weakest direction was last informed
    informed: u64,
    /// P_ii as of the last block
    variances: M::Vector,
    /// samples since each parameter was excited
    silence: M::Vector,
}

/// What the watch has seen.
#[derive(Clone, Copy, Debug)]
pub struct Health<'a, T> {
    /// whether the weakest direction has wound up
    pub windup: bool,
    /// whether the weakest direction is informed now
    pub informed: bool,
    /// the weakest direction, a unit vector of n numbers
    pub direction: &'a [T],
    /// the smallest variance of each parameter so far
    pub least_variances: &'a [T],
    /// the variance in P along the direction
    pub variance: T,
    /// its variance over that when it was last informed
    pub growth: T,
    /// samples since it was last informed
    pub since_informed: u64,
    /// samples since each parameter was excited
    pub since_excited: &'a [T],
    /// samples watched
    pub samples: u64,
    /// samples in a block
    pub block: T,
    /// estimate of the variance of the whitened noise; NaN before the first sample
    pub noise_variance: T,
    /// lag-one correlation of the normalized innovations, in [−1, 1]
    pub correlation: T,
    /// number of samples that the two estimates before stand on
    pub weight: T,
}

impl<M: Memory> Monitor<M> {
    /// A watch that starts at this P; `bounded` if the rule bounds it without excitation.
    pub fn new(factor: &Factor<M>, bounded: bool) -> Self {
        let memory = factor.memory();
        let mut variances = memory.vector();
        factor.variances(variances.as_mut());
        let mut monitor = Self {
            weakest: Weakest::new(factor, variances.as_ref(), bounded),
            residual: Residual::new(),
            length: M::Real::ZERO,
            in_block: 0,
            samples: 0,
            informed: 0,
            variances,
            silence: memory.vector(),
        };
        monitor.start_block();
        monitor
    }

    fn start_block(&mut self) {
        let n = self.variances.as_ref().len();
        let half = M::Real::from_f64(0.5);
        self.length = M::Real::from_f64((2 * n).max(10) as f64).max(half * self.residual.weight);
        self.in_block = 0;
    }

    /// Whether the weakest direction has wound up.
    #[inline]
    pub fn windup(&self) -> bool {
        self.weakest.windup()
    }

    /// How many of `samples` samples may pass before it looks at P again, which it does after the
    /// last of them.
    #[inline]
    pub fn room(&self, samples: usize) -> usize {
        let (length, before) = (self.length.to_f64(), self.in_block as f64);
        if before + samples as f64 <= length {
            return samples;
        }
        let left = libm::ceil(length) - before;
        samples.min((left as usize).max(1))
    }

    /// Notes samples, at most [`room`](Self::room) of them, and P after the last. Returns for how
    /// many of the first ones windup still stood.
    #[inline]
    pub fn watch(&mut self, factor: &Factor<M>, samples: Observations<'_, M::Real>) -> usize {
        let wound_up = M::Real::watch_run(self.kernel(), samples);
        self.count(factor, samples.outcomes.len() as u64);
        wound_up
    }

    /// Notes one sample, None if it was left out, and P after it.
    #[inline]
    pub fn watch_one(&mut self, factor: &Factor<M>, sample: Option<Observation<'_, M::Real>>) {
        M::Real::watch_one(self.kernel(), sample);
        self.count(factor, 1);
    }

    /// What a kernel keeps count of.
    #[inline]
    fn kernel(&mut self) -> Watch<'_, M::Real> {
        let silence = Silence {
            variances: self.variances.as_ref(),
            least: M::Real::from_f64(SHARE) / self.length,
            since: self.silence.as_mut(),
        };
        Watch { residual: &mut self.residual, gauge: self.weakest.gauge(), silence }
    }

    #[inline]
    fn count(&mut self, factor: &Factor<M>, samples: u64) {
        self.samples += samples;
        self.in_block += samples;
        if M::Real::from_f64(self.in_block as f64) >= self.length {
            self.turn(factor);
        }
    }

    /// The end of a block.
    #[cold]
    fn turn(&mut self, factor: &Factor<M>) {
        factor.variances(self.variances.as_mut());
        if self.weakest.turn(factor, self.variances.as_ref(), self.samples) {
            self.informed = self.samples;
        }
        self.start_block();
    }

    /// What the watch has seen.
    pub fn health(&self) -> Health<'_, M::Real> {
        let informed = self.weakest.is_informed();
        Health {
            windup: self.windup(),
            informed,
            direction: self.weakest.direction.as_ref(),
            least_variances: self.weakest.least.as_ref(),
            variance: self.weakest.spread,
            growth: if informed { M::Real::ONE } else { self.weakest.growth() },
            since_informed: if informed { 0 } else { self.samples - self.informed },
            since_excited: self.silence.as_ref(),
            samples: self.samples,
            block: self.length,
            noise_variance: self.residual.variance(),
            correlation: self.residual.correlation(),
            weight: self.residual.weight,
        }
    }
}

impl<M: Memory> State<M::Real> for Monitor<M> {
    fn visit(&mut self, visitor: &mut dyn Visitor<M::Real>) {
        self.weakest.visit(visitor);
        let Residual { weight, squares, products, previous } = &mut self.residual;
        for number in [weight, squares, products, previous] {
            visitor.reals(core::slice::from_mut(number));
        }
        visitor.reals(self.variances.as_mut());
        visitor.reals(self.silence.as_mut());
        visitor.reals(core::slice::from_mut(&mut self.length));
        for count in [&mut self.in_block, &mut self.samples, &mut self.informed] {
            visitor.whole(count);
        }
    }

    fn is_sound(&self) -> bool {
        let vectors = [self.variances.as_ref(), self.silence.as_ref()];
        is_finite(self)
            && self.weakest.is_sound()
            && self.residual.weight >= M::Real::ZERO
            && self.residual.squares >= M::Real::ZERO
            && vectors.iter().all(|vector| vector.iter().all(|&x| x >= M::Real::ZERO))
            && self.length > M::Real::ZERO
            && self.informed <= self.samples
    }
}
