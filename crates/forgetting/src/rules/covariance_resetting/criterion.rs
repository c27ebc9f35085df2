//! When to start afresh.

use crate::choice::{Parameter, Range, Value, Values};
use crate::covariance::Factor;
use crate::error::Error;
use crate::memory::state::{is_finite, State, Visitor};
use crate::memory::Memory;
use crate::sample::cholesky;
use crate::sample::Sample;
use forgetting_kernels::kernel::functions::{add_scaled, dot};
use forgetting_kernels::Real;

/// Which criterion.
pub const CRITERION: Parameter = Parameter::word(
    "criterion",
    &["period", "trace", "smallest_eigenvalue", "change"],
    "what makes P start afresh",
);
/// N
pub const PERIOD: Parameter = Parameter::whole(
    "period",
    100.0,
    Range::AT_LEAST_ONE,
    "samples from one reset to the next, for the criterion `period`",
);
/// h
pub const THRESHOLD: Parameter = Parameter::real(
    "threshold",
    1e-3,
    Range::POSITIVE,
    "P is reset when its trace or smallest eigenvalue is below (1e-3 if not given), or when the \
     sum of `change` is above (20 if not given)",
)
.optional();
/// d
pub const DRIFT: Parameter = Parameter::real(
    "drift",
    1.0,
    Range::NON_NEGATIVE,
    "excess of the normalised squared innovation that is no change, for the criterion `change`",
);
/// M
pub const MEMORY: Parameter = Parameter::whole(
    "memory",
    100.0,
    Range::AT_LEAST_ONE,
    "samples that tell how large innovations are without a change, for the criterion `change`",
);

/// What makes P start afresh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Criterion<T> {
    /// this many samples
    Period(u64),
    /// a trace of P below this
    Trace(T),
    /// a smallest eigenvalue of P below this
    SmallestEigenvalue(T),
    /// innovations larger than they were
    Change {
        /// level that the sum of the excess must pass
        threshold: T,
        /// excess that is no change
        drift: T,
        /// samples over which the innovations' usual size is averaged
        memory: u64,
    },
}

impl<T: Real> Criterion<T> {
    /// The criterion that `values` name.
    ///
    /// # Errors
    /// [`Error`] names the parameter that is out of range.
    pub fn configure(values: &dyn Values) -> Result<Self, Error> {
        let threshold = |default: f64| match values.get(THRESHOLD.name) {
            None => Ok(T::from_f64(default)),
            Some(_) => THRESHOLD.number(values),
        };
        // all are checked, whichever is used
        let (period, memory) = (PERIOD.number::<f64>(values)?, MEMORY.number::<f64>(values)?);
        let (drift, below) = (DRIFT.number(values)?, threshold(1e-3)?);
        Ok(match CRITERION.choice(values)? {
            0 => Self::Period(period as u64),
            1 => Self::Trace(below),
            2 => Self::SmallestEigenvalue(below),
            _ => Self::Change { threshold: threshold(20.0)?, drift, memory: memory as u64 },
        })
    }

    /// Names the criterion and those parameters that it uses.
    pub fn describe(&self, each: &mut dyn FnMut(&'static str, Value<'_>)) {
        let mut number = |parameter: Parameter, x: f64| each(parameter.name, Value::Real(x));
        let word = match *self {
            Self::Period(period) => {
                number(PERIOD, period as f64);
                "period"
            }
            Self::Trace(threshold) => {
                number(THRESHOLD, threshold.to_f64());
                "trace"
            }
            Self::SmallestEigenvalue(threshold) => {
                number(THRESHOLD, threshold.to_f64());
                "smallest_eigenvalue"
            }
            Self::Change { threshold, drift, memory } => {
                number(THRESHOLD, threshold.to_f64());
                number(DRIFT, drift.to_f64());
                number(MEMORY, memory as f64);
                "change"
            }
        };
        each(CRITERION.name, Value::Word(word));
    }
}

/// What a criterion remembers.
#[derive(Clone, Debug)]
pub struct Watch<M: Memory> {
    progress: Progress<M::Real>,
    /// not state: n x n, for a trial factorization
    square: M::Square,
    /// not state: p x p, for the root of I + φ̄ P φ̄ᵀ
    noise: M::Noise,
    /// not state: p x m, for the errors in its units
    errors: M::Errors,
}

/// How far the criterion has come, and whether the sample meets it.
#[derive(Clone, Copy, Debug)]
pub struct Progress<T> {
    /// whether P is to start afresh
    pub met: bool,
    samples: u64,
    excess: T,
    usual: T,
}

impl<M: Memory> State<M::Real> for Watch<M> {
    fn visit(&mut self, visitor: &mut dyn Visitor<M::Real>) {
        visitor.whole(&mut self.progress.samples);
        visitor.reals(core::slice::from_mut(&mut self.progress.excess));
        visitor.reals(core::slice::from_mut(&mut self.progress.usual));
    }

    fn is_sound(&self) -> bool {
        let Progress { excess, usual, .. } = self.progress;
        let most = M::Real::CEILING + M::Real::CEILING * M::Real::EPSILON.sqrt();
        is_finite(self) && excess >= M::Real::ZERO && usual >= M::Real::ZERO && usual <= most
    }
}

impl<M: Memory> Watch<M> {
    /// Before the first sample.
    pub fn new(memory: M) -> Self {
        let (excess, usual) = (M::Real::ZERO, M::Real::ZERO);
        Self {
            progress: Progress { met: false, samples: 0, excess, usual },
            square: memory.square(),
            noise: memory.noise(),
            errors: memory.errors(),
        }
    }

    /// Looks at a sample, before anything is done with it; `work` is p x n.
    pub fn look(
        &mut self,
        criterion: &Criterion<M::Real>,
        factor: &Factor<M>,
        sample: &Sample<'_, M>,
        work: &mut [M::Real],
    ) -> Progress<M::Real> {
        let mut progress = self.progress;
        progress.samples += 1;
        progress.met = match *criterion {
            Criterion::Period(period) => {
                self.progress.samples > 0 && self.progress.samples.is_multiple_of(period.max(1))
            }
            Criterion::Trace(threshold) => factor.trace() < threshold,
            Criterion::SmallestEigenvalue(threshold) => self.is_below(factor, threshold),
            Criterion::Change { threshold, drift, memory } => {
                let u = self.normalised_square(factor, sample, work);
                // written so that what is not a number is capped, too
                let u = if u < M::Real::CEILING { u } else { M::Real::CEILING };
                let known = self.progress.samples >= memory;
                progress.accumulate(u, known.then_some((threshold, drift)), memory)
            }
        };
        progress
    }

    /// Stores the progress, once the sample is used.
    pub fn remember(&mut self, progress: Progress<M::Real>) {
        self.progress = progress;
    }

    /// Whether the smallest eigenvalue of P is below `threshold`.
    fn is_below(&mut self, factor: &Factor<M>, threshold: M::Real) -> bool {
        if factor.smallest() < threshold {
            return true;
        }
        let (n, trial) = (factor.parameters(), self.square.as_mut());
        factor.reconstruct(trial);
        for i in 0..n {
            trial[i * n + i] -= threshold;
        }
        cholesky(trial, n, "covariance").is_err()
    }

    /// u = tr(ēᵀ (I + φ̄ P φ̄ᵀ)⁻¹ ē)/(p m), by the root L of I + φ̄ P φ̄ᵀ, row by row.
    fn normalised_square(
        &mut self,
        factor: &Factor<M>,
        sample: &Sample<'_, M>,
        work: &mut [M::Real],
    ) -> M::Real {
        let (n, p, m) = (factor.parameters(), sample.rows(), sample.error(0).len());
        let (root, errors) = (self.noise.as_mut(), &mut self.errors.as_mut()[..p * m]);
        let rows = &mut work[..p * n];
        errors.copy_from_slice(sample.errors());
        rows.copy_from_slice(sample.regressors());
        rows.chunks_exact_mut(n).for_each(|row| factor.apply_root_transposed(row));
        let row = |i: usize| &rows[i * n..(i + 1) * n];
        for i in 0..p {
            let (done, current) = errors.split_at_mut(i * m);
            let current = &mut current[..m];
            for k in 0..i {
                let inner = dot(&root[i * p..i * p + k], &root[k * p..k * p + k]);
                let l = (dot(row(i), row(k)) - inner) / root[k * p + k];
                root[i * p + k] = l;
                add_scaled(current, -l, &done[k * m..(k + 1) * m]);
            }
            let above = &root[i * p..i * p + i];
            // never below 1 but for rounding
            let pivot = M::Real::ONE + (dot(row(i), row(i)) - dot(above, above));
            root[i * p + i] = pivot.max(M::Real::ONE).sqrt();
            current.iter_mut().for_each(|x| *x /= root[i * p + i]);
        }
        dot(errors, errors) / M::Real::from_f64((p * m) as f64)
    }
}

impl<T: Real> Progress<T> {
    /// Takes note of `u`; says whether the excess passes the threshold, if there is one yet.
    fn accumulate(&mut self, u: T, test: Option<(T, T)>, memory: u64) -> bool {
        let mut met = false;
        if let Some((threshold, drift)) = test {
            let ratio = if self.usual > T::ZERO { u / self.usual } else { T::ONE };
            let sum = (self.excess + ratio - T::ONE - drift).max(T::ZERO);
            met = sum > threshold;
            self.excess = if met { T::ZERO } else { sum };
        }
        // `samples` counts this one already
        let weight = T::from_f64(self.samples.min(memory).max(1) as f64);
        self.usual += (u - self.usual) / weight;
        met
    }
}
