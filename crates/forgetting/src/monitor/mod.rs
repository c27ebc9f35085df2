//! Monitors an estimator while it runs: windup, excitation, noise and whiteness, in O(n) a sample.
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
//! received information, it receives none now, and the rule does not bound it. Where the variance
//! is large, even the noise of a regressor brings some information: so the share that ends windup
//! grows with the variance, up to the share that keeps the variance where it is. Only the weakest
//! direction is followed, the largest eigenvector of P with each parameter scaled by the smallest
//! standard deviation it has had: whatever winds up becomes it, in any units. Information ends the
//! alarm, yet a variance a thousand times that of before is no new normal: it is compared with what
//! it was until it has come down. A block is
//! N = max(10, 2n, half the memory) samples, so that its end, O(n²), costs O(n) a sample.

use crate::covariance::Factor;
use crate::memory::state::{is_finite, State, Visitor};
use crate::memory::Memory;
use forgetting_kernels::kernel::watch::{Observation, Observations, Residual, Silence, Watch};
use forgetting_kernels::Kernels;
use forgetting_kernels::Real;
mod health;
#[cfg(feature = "alloc")]
mod information_window;
mod weakest;

pub use health::Health;
#[cfg(feature = "alloc")]
pub use information_window::InformationWindow;
use weakest::Weakest;

/// Growth of the variance of a silent direction that counts as windup.
pub const FACTOR: f64 = 10.0;
/// Growth from which on information does not make a variance the one to compare with.
pub const LASTING: f64 = 1000.0;
/// Information over a block, as a share of 1/σ², from which on a direction counts as informed.
pub const SHARE: f64 = 0.01;
/// The same for a direction that has wound up far. About one half would keep its variance where it
/// is: as much information comes in a block as is forgotten.
pub const RECOVERY: f64 = 0.3;

/// What is computed over the samples so far. A part of the estimator's state.
#[derive(Clone, Debug)]
pub struct Monitor<M: Memory> {
    weakest: Weakest<M>,
    residual: Residual<M::Real>,
    /// N
    length: M::Real,
    in_block: u64,
    samples: u64,
    /// `samples` when the weakest direction was last informed
    informed: u64,
    /// P_ii as of the last block
    variances: M::Vector,
    /// samples since each parameter was excited
    silence: M::Vector,
}

impl<M: Memory> Monitor<M> {
    /// Starts at this P; `bounded` if the rule bounds P without excitation.
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

    /// How many of `samples` samples fit into this block. P is read after the last of a block.
    #[inline]
    pub fn room(&self, samples: usize) -> usize {
        let (length, before) = (self.length.to_f64(), self.in_block as f64);
        if before + samples as f64 <= length {
            return samples;
        }
        let left = libm::ceil(length) - before;
        samples.min((left as usize).max(1))
    }

    /// Notes `samples`, at most [`room`](Self::room), and P after the last of them. Returns for how
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

    /// The sums that a kernel adds to.
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
            self.end_block(factor);
        }
    }

    /// Goes on in other units: P ← S P S with S = diag(`ratios`).
    pub fn change_units(&mut self, ratios: &[M::Real]) {
        self.weakest.change_units(ratios);
        for (variance, &ratio) in self.variances.as_mut().iter_mut().zip(ratios) {
            *variance *= ratio * ratio;
        }
    }

    /// Reads P and starts the next block.
    #[cold]
    fn end_block(&mut self, factor: &Factor<M>) {
        factor.variances(self.variances.as_mut());
        let ever = self.informed > 0;
        if self.weakest.end_block(factor, self.variances.as_ref(), self.samples, ever) {
            self.informed = self.samples;
        }
        self.start_block();
    }

    /// What has been found so far.
    pub fn health(&self) -> Health<'_, M::Real> {
        let informed = self.weakest.is_informed();
        Health {
            windup: self.windup(),
            informed,
            direction: self.weakest.direction.as_ref(),
            least_variances: self.weakest.least.as_ref(),
            variance: self.weakest.spread,
            growth: self.weakest.growth(self.informed > 0),
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
