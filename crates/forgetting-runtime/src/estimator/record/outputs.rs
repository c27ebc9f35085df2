//! The outputs of a record as they grow, sample by sample.

use super::kept::{arrays, push, room};
use super::run::Run;
use super::shapes::Sizes;
use crate::error::Error;
use crate::estimator::accessors::by_parameter;
use crate::number::{Elements, Number};
use forgetting::{Answer, AnyEstimator, Dynamic, Factor, Memory, Outcome, Skip, Update};

/// The outputs that were asked for, each as long as there were samples.
pub(crate) struct Outputs<T> {
    theta: Option<Vec<T>>,
    error: Option<Vec<T>>,
    leverage: Option<Vec<T>>,
    forgetting_factor: Option<Vec<T>>,
    rank: Option<Vec<i64>>,
    skipped: Option<Vec<u8>>,
    gate: Option<Vec<u8>>,
    windup: Option<Vec<bool>>,
    whitened_innovation: Option<Vec<T>>,
    variance: Option<Vec<T>>,
    covariance: Option<Vec<T>>,
    prior_covariance: Option<Vec<T>>,
    weight: Option<Vec<T>>,
    used: usize,
    reweighted: bool,
}

impl<T: Number> Outputs<T> {
    /// Room for the outputs of these names.
    ///
    /// # Errors
    /// [`Error::Output`] for an unknown name, [`Error::Core`] when there is not enough memory.
    pub fn named(names: &[&str], sizes: Sizes) -> Result<Self, Error> {
        if let Some(name) = names.iter().find(|name| !Run::OUTPUTS.contains(name)) {
            return Err(Error::Output { name: (*name).into(), allowed: Run::OUTPUTS.join(", ") });
        }
        let Sizes { samples, parameters: n, rows: p, targets: m } = sizes;
        Ok(Self {
            theta: room(names, "theta", &[samples, n, m])?,
            error: room(names, "error", &[samples, p, m])?,
            leverage: room(names, "leverage", &[samples])?,
            forgetting_factor: room(names, "forgetting_factor", &[samples])?,
            rank: room(names, "rank", &[samples])?,
            skipped: room(names, "skipped", &[samples])?,
            gate: room(names, "gate", &[samples])?,
            windup: room(names, "windup", &[samples])?,
            whitened_innovation: room(names, "whitened_innovation", &[samples, p, m])?,
            variance: room(names, "variance", &[samples, n])?,
            covariance: room(names, "covariance", &[samples, n, n])?,
            prior_covariance: room(names, "prior_covariance", &[samples, n, n])?,
            weight: room(names, "weight", &[samples])?,
            used: 0,
            reweighted: false,
        })
    }

    /// Makes `estimator` keep what the outputs need beside what it keeps anyway.
    pub fn prepare(&self, estimator: &mut AnyEstimator<T>) {
        estimator.keep_innovations(self.whitened_innovation.is_some());
        estimator.keep_prior(self.prior_covariance.is_some());
    }

    /// Notes what a sample did.
    #[inline(always)]
    pub fn note(&mut self, update: &Update<'_, T>) {
        if let Some(error) = &mut self.error {
            error.extend_from_slice(update.error);
        }
        push(&mut self.leverage, update.leverage);
        self.note_rest(update);
    }

    /// Notes what samples of one row and one target did.
    pub fn note_all(&mut self, estimator: &AnyEstimator<T>, outcomes: &[Outcome<T>]) {
        if let Some(error) = &mut self.error {
            error.extend(outcomes.iter().map(|outcome| outcome.error));
        }
        if let Some(leverage) = &mut self.leverage {
            leverage.extend(outcomes.iter().map(|outcome| outcome.leverage));
        }
        for outcome in outcomes {
            self.note_rest(&estimator.report(outcome));
        }
    }

    /// Notes all but errors and leverages.
    #[inline(always)]
    fn note_rest(&mut self, update: &Update<'_, T>) {
        push(&mut self.forgetting_factor, update.forgetting_factor);
        push(&mut self.weight, update.weight);
        self.reweighted |= update.weight != T::ONE;
        push(&mut self.rank, update.rank as i64);
        push(&mut self.skipped, update.skipped.map_or(0, Skip::code));
        push(&mut self.gate, update.gate.code());
        push(&mut self.windup, update.windup);
        if let Some(whitened) = &mut self.whitened_innovation {
            let start = whitened.len();
            whitened.resize(start + update.error.len(), T::ZERO);
            let kept = update.whiten(&mut whitened[start..]);
            debug_assert!(kept.is_ok(), "prepared for");
        }
        self.used += usize::from(update.skipped.is_none());
    }

    /// Notes a sample that never reached the estimator, which stays as it is.
    pub fn note_missing(&mut self, width: usize) {
        let nothing = T::from_f64(f64::NAN);
        for output in [&mut self.error, &mut self.whitened_innovation].into_iter().flatten() {
            output.extend(std::iter::repeat_n(nothing, width));
        }
        push(&mut self.leverage, nothing);
        push(&mut self.forgetting_factor, T::ONE);
        push(&mut self.weight, T::ONE);
        push(&mut self.rank, 0);
        push(&mut self.skipped, Skip::Missing.code());
        push(&mut self.gate, Answer::Update.code());
        push(&mut self.windup, false);
    }

    /// Whether an output is taken from the estimator after each sample, other than θ.
    pub fn need_every_state(&self) -> bool {
        [&self.variance, &self.covariance, &self.prior_covariance].into_iter().any(Option::is_some)
    }

    /// Lets `update_many` write θ after each of at most `most` samples of n numbers, if θ is kept, and
    /// keeps those of as many samples as it says it took.
    pub fn with_thetas(
        &mut self,
        (most, n): (usize, usize),
        update_many: impl FnOnce(&mut [T]) -> usize,
    ) -> usize {
        let Some(theta) = &mut self.theta else { return update_many(&mut []) };
        let before = theta.len();
        theta.resize(before + most * n, T::ZERO);
        let taken = update_many(&mut theta[before..]);
        theta.truncate(before + taken * n);
        taken
    }

    /// Notes P̄ of a sample, which is P where it was `missing`.
    #[inline(always)]
    pub fn note_prior(&mut self, estimator: &AnyEstimator<T>, missing: bool) {
        if let Some(covariance) = &mut self.prior_covariance {
            let prior = estimator.prior_factor().filter(|_| !missing);
            let prior = prior.unwrap_or_else(|| estimator.factor());
            reconstruct(covariance, &estimator.express(prior));
        }
    }

    /// Notes the state after a sample.
    #[inline(always)]
    pub fn note_state(&mut self, estimator: &AnyEstimator<T>) {
        if let Some(theta) = &mut self.theta {
            match estimator.prior().memory().targets() {
                1 => theta.extend_from_slice(estimator.theta()),
                _ => by_parameter(estimator, theta),
            }
        }
        if let Some(variance) = &mut self.variance {
            let start = variance.len();
            let factor = estimator.express(estimator.factor());
            variance.resize(start + factor.parameters(), T::ZERO);
            factor.variances(&mut variance[start..]);
        }
        if let Some(covariance) = &mut self.covariance {
            reconstruct(covariance, &estimator.express(estimator.factor()));
        }
    }

    /// The outputs as arrays, errors in the shape of y.
    pub fn finish(self, sizes: Sizes, per_row: &[usize]) -> Run {
        let Sizes { samples, parameters: n, targets: m, .. } = sizes;
        // one target has no dimension of its own
        let theta = [samples, n, m][..3 - usize::from(m == 1)].to_vec();
        let numbers = |numbers: Option<Vec<T>>| numbers.map(T::elements);
        let (each, square) = (vec![samples], vec![samples, n, n]);
        let outputs = [
            ("theta", numbers(self.theta), theta),
            ("error", numbers(self.error), per_row.to_vec()),
            ("leverage", numbers(self.leverage), each.clone()),
            ("forgetting_factor", numbers(self.forgetting_factor), each.clone()),
            ("weight", numbers(self.weight), each.clone()),
            ("rank", self.rank.map(Elements::I64), each.clone()),
            ("skipped", self.skipped.map(Elements::U8), each.clone()),
            ("gate", self.gate.map(Elements::U8), each.clone()),
            ("windup", self.windup.map(Elements::Bool), each),
            ("whitened_innovation", numbers(self.whitened_innovation), per_row.to_vec()),
            ("variance", numbers(self.variance), vec![samples, n]),
            ("covariance", numbers(self.covariance), square.clone()),
            ("prior_covariance", numbers(self.prior_covariance), square),
        ];
        let reweighted = self.reweighted;
        Run { outputs: arrays(outputs), samples, used: self.used, reweighted }
    }
}

/// Appends the n x n numbers of P.
fn reconstruct<T: Number>(covariances: &mut Vec<T>, factor: &Factor<Dynamic<T>>) {
    let (start, n) = (covariances.len(), factor.parameters());
    covariances.resize(start + n * n, T::ZERO);
    factor.reconstruct(&mut covariances[start..]);
}
