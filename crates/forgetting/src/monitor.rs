//! Watches an estimator while it runs: windup, excitation, noise and whiteness, in O(n) a sample.
//!
//! ```text
//! weakest direction   v ← P v / ‖P v‖ at the end of each block (power iteration), σ² = vᵀ P v
//! informed            σ² Σ (φ̄ v)² ≥ share, over this block of samples and the one before
//! windup              σ² > factor · (σ² when v was last informed), and v is not informed
//! excited             parameter i is when N φ̄_i² P_ii ≥ share, P_ii as of the last block
//! noise variance      mean of ē² / (1 + φ̄P̄φ̄ᵀ) where φ̄P̄φ̄ᵀ ≤ 1, weighted with the products of λ
//! whiteness           lag-one correlation of ē / √(1 + φ̄P̄φ̄ᵀ), with the same weights
//! ```
//!
//! A direction has wound up when its variance is more than ten times what it was when it last
//! received information, it receives none now, and the rule sets it no bound. The further it has
//! wound up, the larger is the share asked for to end that, up to what holds the variance where it
//! is: beside a large variance the noise of a regressor tells something, too. The largest
//! eigenvector of P is the one to watch: whatever winds up becomes it. A block is
//! N = max(10, 2n, half the memory) samples, so that what costs O(n²) is spread over as many
//! samples.

use crate::factor::kernel::{add_scaled, dot};
use crate::state::{is_finite, State, Visitor};
use crate::{Factor, Memory, Real};

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
    bounded: bool,
    direction: M::Vector,
    /// a buffer
    before: M::Vector,
    variance: M::Real,
    /// σ² when the direction was last informed
    reference: M::Real,
    /// Σ (φ̄ v)² in this block and in the one before
    information: [M::Real; 2],
    /// Σ (φ̄ v) φ̄ in this block
    told: M::Vector,
    /// N, as a number to multiply with and as one to count to
    length: M::Real,
    in_block: u64,
    samples: u64,
    informed: u64,
    variances: M::Vector,
    /// samples since each parameter was excited
    silence: M::Vector,
    weight: M::Real,
    squares: M::Real,
    products: M::Real,
    previous: M::Real,
}

/// What the watch is shown of a sample that was used.
#[derive(Clone, Copy, Debug)]
pub struct Seen<'a, T> {
    /// φ̄, n numbers a row
    pub regressors: &'a [T],
    /// ē, one number a row and target
    pub errors: &'a [T],
    /// ‖ē‖² over rows and targets
    pub squared_error: T,
    /// tr φ̄P̄φ̄ᵀ
    pub leverage: T,
    /// the λ used
    pub forgetting_factor: T,
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
    /// its variance in P
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
        let (memory, zero) = (factor.memory(), M::Real::ZERO);
        let mut monitor = Self {
            bounded,
            direction: memory.vector(),
            before: memory.vector(),
            variance: zero,
            reference: zero,
            information: [zero; 2],
            told: memory.vector(),
            length: zero,
            in_block: 0,
            samples: 0,
            informed: 0,
            variances: memory.vector(),
            silence: memory.vector(),
            weight: zero,
            squares: zero,
            products: zero,
            previous: zero,
        };
        monitor.direction.as_mut().fill(M::Real::ONE);
        monitor.look(factor);
        monitor.reference = monitor.variance;
        monitor
    }

    /// Whether the weakest direction has wound up.
    #[inline]
    pub fn windup(&self) -> bool {
        !self.bounded && self.has_grown() && !self.is_informed()
    }

    /// Whether σ² is so much larger than when v was last informed.
    #[inline]
    fn has_grown(&self) -> bool {
        self.variance > M::Real::from_f64(FACTOR) * self.reference
    }

    /// The share that v must be told of to count as informed: the further it has wound up, the
    /// more.
    #[inline]
    fn needed(&self) -> M::Real {
        let (share, recovery) = (M::Real::from_f64(SHARE), M::Real::from_f64(RECOVERY));
        if self.bounded {
            return share;
        }
        let excess = self.variance / (M::Real::from_f64(FACTOR) * self.reference);
        (share * excess).max(share).min(recovery)
    }

    /// How many of `samples` samples may pass before it looks at P again, which it does after the
    /// last of them.
    #[inline]
    pub fn room(&self, samples: usize) -> usize {
        let length = self.length.to_f64();
        let left = libm::ceil(length) - self.in_block as f64;
        if left >= samples as f64 {
            samples
        } else {
            (left as usize).max(1)
        }
    }

    #[inline]
    fn is_informed(&self) -> bool {
        (self.information[0] + self.information[1]) * self.variance >= self.needed()
    }

    /// Takes note of a sample, none if it was left out, and of P after it.
    #[inline]
    pub fn watch(&mut self, factor: &Factor<M>, seen: Option<Seen<'_, M::Real>>) {
        self.samples += 1;
        match seen {
            Some(seen) => {
                let rows = self.note_excitation(seen.regressors);
                self.note_innovation(&seen, rows);
            }
            None => self.silence.as_mut().iter_mut().for_each(|silence| *silence += M::Real::ONE),
        }
        self.in_block += 1;
        if M::Real::from_f64(self.in_block as f64) >= self.length {
            self.turn(factor);
        }
    }

    /// Returns the number of rows.
    #[inline]
    fn note_excitation(&mut self, regressors: &[M::Real]) -> usize {
        let (direction, variances) = (self.direction.as_ref(), self.variances.as_ref());
        let (share, mut rows) = (M::Real::from_f64(SHARE), 0);
        for row in regressors.chunks_exact(direction.len()) {
            // a sample ages once, whatever its rows
            let age = if rows == 0 { M::Real::ONE } else { M::Real::ZERO };
            let along = dot(row, direction);
            self.information[0] += along * along;
            add_scaled(self.told.as_mut(), along, row);
            let parameters = self.silence.as_mut().iter_mut().zip(variances);
            for (&f, (silence, &variance)) in row.iter().zip(parameters) {
                let excited = f * f * (variance * self.length) >= share;
                *silence = if excited { M::Real::ZERO } else { *silence + age };
            }
            rows += 1;
        }
        rows
    }

    #[inline]
    fn note_innovation(&mut self, seen: &Seen<'_, M::Real>, rows: usize) {
        let Seen { errors, squared_error, leverage, forgetting_factor: lambda, .. } = *seen;
        let average = |x: M::Real, count: usize| {
            if count == 1 {
                x
            } else {
                x / M::Real::from_f64(count as f64)
            }
        };
        let spread = M::Real::ONE + average(leverage, rows);
        if spread > M::Real::from_f64(2.0) {
            return; // more uncertain of the parameters than of the noise: it tells nothing of noise
        }
        let inverse = M::Real::ONE / spread;
        let innovation = errors[0] * inverse.sqrt();
        let square = average(squared_error, errors.len()) * inverse;
        self.weight = lambda.mul_add(self.weight, M::Real::ONE);
        self.squares = lambda.mul_add(self.squares, square);
        self.products = lambda.mul_add(self.products, innovation * self.previous);
        self.previous = innovation;
    }

    /// The end of a block.
    #[cold]
    fn turn(&mut self, factor: &Factor<M>) {
        let (before, needed) = (self.variance, self.needed());
        let along = self.information[0];
        let same = self.look(factor);
        let (last, informed) = if same && along > M::Real::ZERO {
            // Σ (φ̄ v)² of the new v is at least this (Cauchy and Schwarz): a trickle along the old
            // one may be none along the new one, with its larger variance
            let shared = dot(self.told.as_ref(), self.direction.as_ref());
            let last = (shared * (shared / along)).min(M::Real::CEILING);
            (last, last * self.variance >= self.needed())
        } else {
            let informed = along * before >= needed;
            (if informed { along } else { M::Real::ZERO }, informed)
        };
        if informed {
            self.informed = self.samples;
            // no direction had a larger variance before
            self.reference = before;
        }
        self.reference = self.reference.min(self.variance);
        self.information = [M::Real::ZERO, last];
        self.told.as_mut().fill(M::Real::ZERO);
        self.in_block = 0;
    }

    /// Looks for the weakest direction again; says whether it is still about the same. O(n²).
    fn look(&mut self, factor: &Factor<M>) -> bool {
        let n = factor.parameters();
        let half = M::Real::from_f64(0.5);
        self.length = M::Real::from_f64((2 * n).max(10) as f64).max(half * self.weight);
        factor.variances(self.variances.as_mut());
        let (before, direction) = (self.before.as_mut(), self.direction.as_mut());
        before.copy_from_slice(direction);
        // a little of every axis keeps the iteration from missing a direction for ever
        let nudge = M::Real::EPSILON.sqrt();
        for (i, x) in direction.iter_mut().enumerate() {
            let up = (self.samples >> (i % 32)) & 1 == 0;
            *x += if up { nudge } else { -nudge };
        }
        factor.multiply(direction);
        if !normalize(direction) {
            direction.copy_from_slice(before);
        }
        self.variance = factor.leverage(direction);
        let overlap = dot(direction, before);
        overlap * overlap > M::Real::from_f64(0.8)
    }

    /// What the watch has seen.
    pub fn health(&self) -> Health<'_, M::Real> {
        let informed = self.is_informed();
        Health {
            windup: self.windup(),
            informed,
            direction: self.direction.as_ref(),
            variance: self.variance,
            growth: if informed { M::Real::ONE } else { self.variance / self.reference },
            since_informed: if informed { 0 } else { self.samples - self.informed },
            since_excited: self.silence.as_ref(),
            samples: self.samples,
            block: self.length,
            noise_variance: self.squares / self.weight,
            correlation: self.products / self.squares,
            weight: self.weight,
        }
    }
}

impl<M: Memory> State<M::Real> for Monitor<M> {
    fn visit(&mut self, visitor: &mut dyn Visitor<M::Real>) {
        for vector in [&mut self.direction, &mut self.told, &mut self.variances, &mut self.silence]
        {
            visitor.reals(vector.as_mut());
        }
        visitor.reals(&mut self.information);
        for number in [
            &mut self.variance,
            &mut self.reference,
            &mut self.length,
            &mut self.weight,
            &mut self.squares,
            &mut self.products,
            &mut self.previous,
        ] {
            visitor.reals(core::slice::from_mut(number));
        }
        for count in [&mut self.in_block, &mut self.samples, &mut self.informed] {
            visitor.whole(count);
        }
    }

    fn is_sound(&self) -> bool {
        let (zero, one) = (M::Real::ZERO, M::Real::ONE);
        let direction = self.direction.as_ref();
        let numbers = [self.weight, self.squares];
        let parts = [self.variances.as_ref(), self.silence.as_ref(), &self.information, &numbers];
        is_finite(self)
            && parts.iter().all(|part| part.iter().all(|&x| x >= zero))
            && [self.variance, self.reference, self.length].iter().all(|&x| x > zero)
            && (dot(direction, direction) - one).abs() <= M::Real::from_f64(1e-3)
            && self.informed <= self.samples
    }
}

/// x ← x / ‖x‖, if that has a value; says whether it has.
fn normalize<T: Real>(x: &mut [T]) -> bool {
    let largest = x.iter().fold(T::ZERO, |largest, x| largest.max(x.abs()));
    if !(largest > T::ZERO && largest.is_finite()) {
        return false;
    }
    x.iter_mut().for_each(|x| *x /= largest);
    let length = dot(x, x).sqrt();
    x.iter_mut().for_each(|x| *x /= length);
    true
}
