//! Starts afresh from a given covariance when a criterion is met; else forgets as another rule does.
//!
//! ```text
//! F_k = R_k − P_∞⁻¹  if the criterion is met        GF-RLS (55)–(57)
//! F_k of the rule    if not
//! ```
//!
//! | symbol | name | range | default |
//! |---|---|---|---|
//! | | rule | any rule but this one, by its name or with its parameters | none |
//! | | criterion | period, trace, smallest_eigenvalue, change | period |
//! | P_∞ | covariance | a number c > 0 (c·I), n numbers > 0 or an n x n positive definite matrix | 100 |
//! | N | period | whole numbers from 1 | 100 |
//! | h | threshold | (0, ∞) | 1e-3; 20 for change |
//! | d | drift | [0, ∞) | 1 |
//! | M | memory | whole numbers from 1 | 100 |
//!
//! With k the number of samples used before this one, and P before it is forgotten, the criterion
//! is met
//!
//! - period: at k = N, 2N, …
//! - trace: if tr P < h.
//! - smallest_eigenvalue: if that of P is < h, that is, if P − h I is not positive definite.
//! - change: if a sum of the squared innovations in excess of what they were passes h (a one-sided
//!   CUSUM). With u = tr(ēᵀ (I + φ̄ P φ̄ᵀ)⁻¹ ē)/(p m), whose mean is 1 without a change if Γ is right,
//!   and v the mean of u over the samples before (over the last M or so once there are that many):
//!   from k = M on, g ← max(0, g + u/v − 1 − d), met if g > h, and then g ← 0. u/v does not depend
//!   on the scale of the noise. With the defaults and Gaussian noise, one target and one row, a
//!   false alarm comes about once in 40 000 samples, and innovations whose variance suddenly is
//!   ten times as large are found after 4 to 5 samples on average.
//!
//! At a reset P_∞ is the P that the rule finds: it chooses by it what is measured, and whatever its
//! state keeps of P starts anew from it; the rest of its state goes on. A sample that it skips is
//! skipped, and the criterion does not see it, nor one that a gate holds or freezes. The
//! forgetting factor is the rule's.
//!
//! - Proper (A1): if P ≤ P_∞ at every reset and the rule is proper.
//! - P̄ bounded above without excitation (A2): if the rule's is.
//! - P bounded below (A3): if φ is bounded and the rule's P is; or the rule is proper and the
//!   criterion is period, by 1/(N β + 1/p), or smallest_eigenvalue, by 1/(β + 1/min(h, p)), for
//!   φ̄ᵀφ̄ ≤ β I and P₀, P_∞ ≥ p I.
//! - Cost: that of the rule; and O(n²/2) for trace, O(p n²/2) for change, O(n³/3) for
//!   smallest_eigenvalue. State: the rule's, k, g and v.
//! - Use it for parameters that jump: `change` with any rule for the time between the jumps.
//! - Not for slow drift: a reset throws away what is known, and between resets the other rule has
//!   to follow.
//!
//! Reference: G. C. Goodwin, E. K. Teoh, H. Elliott, *Deterministic convergence of a self-tuning
//! regulator with covariance resetting*, IEE Proceedings D 130, 1983; E. S. Page, *Continuous
//! inspection schemes*, Biometrika 41, 1954 (CUSUM).

pub mod criterion;
mod inner;

use super::root::Root;
use super::{Forgetting, Forgotten, InnerRule, Step, RULES};
use crate::choice::guarantee::positive;
use crate::choice::{
    About, Bounds, Claim, Constants, Guarantee, Guarantees, Input, Kind, Parameter, Range, Setting,
    Value, Values,
};
use crate::covariance::Factor;
use crate::error::Error;
use crate::memory::state::{State, Visitor};
use crate::memory::Memory;
use criterion::{Criterion, Watch, CRITERION, DRIFT, MEMORY, PERIOD, THRESHOLD};
use forgetting_kernels::Real;

const RULE: Parameter = Parameter::rule("rule", "none", "how to forget between the resets");
const COVARIANCE: Parameter = Parameter::elements(
    "covariance",
    Kind::Matrix,
    100.0,
    Range::POSITIVE,
    "covariance that a reset starts from: c for c*I, n numbers for a diagonal, or n x n",
);

/// The registry entry.
pub const ABOUT: About = About {
    squares: 5,
    cost: "that of the rule; O(n^3) more for smallest_eigenvalue",
    guarantees: Some(Guarantees {
        proper: Guarantee::when(
            "P <= covariance at every reset, and the rule is",
            Setting::usual(Input::Silent)
                .with(&[("covariance", Value::Real(1.0)), ("period", Value::Real(1.0))]),
        ),
        bounded_above: Guarantee::when(
            "the rule's is",
            Setting::usual(Input::Silent)
                .with(&[("rule", Value::Word("exponential")), ("criterion", Value::Word("trace"))]),
        ),
        bounded_below: Guarantee::when(
            "regressors bounded, and criterion is period or smallest_eigenvalue or the rule's is",
            Setting::usual(Input::Exciting(1))
                .with(&[("criterion", Value::Word("trace")), ("threshold", Value::Real(1e-12))]),
        ),
    }),
    ..About::new(&[RULE, CRITERION, COVARIANCE, PERIOD, THRESHOLD, DRIFT, MEMORY])
};

/// Resets P when a criterion is met; see [`self`](crate::rules::covariance_resetting).
///
/// `F` is the rule for the time between; by default it is any rule, chosen by name.
#[derive(Clone, Debug)]
pub struct CovarianceResetting<M: Memory, F: Forgetting<M> = InnerRule<M>> {
    rule: F,
    criterion: Criterion<M::Real>,
    root: Root<M>,
    covariance: Factor<M>,
}

/// What the rule and the criterion remember.
#[derive(Clone, Debug)]
pub struct Resetting<M: Memory, S> {
    rule: S,
    watch: Watch<M>,
    /// not state: P before a reset, put back if the sample is not used
    before: Factor<M>,
}

impl<M: Memory, S: State<M::Real>> State<M::Real> for Resetting<M, S> {
    fn visit(&mut self, visitor: &mut dyn Visitor<M::Real>) {
        self.rule.visit(visitor);
        self.watch.visit(visitor);
    }

    fn is_sound(&self) -> bool {
        self.rule.is_sound() && self.watch.is_sound()
    }
}

impl<M: Memory, F: Forgetting<M>> CovarianceResetting<M, F> {
    /// Forgets as `rule` does, and starts afresh from `covariance`, given with its root, when
    /// the criterion is met.
    ///
    /// # Errors
    /// [`Error::Indefinite`] names `covariance` unless it is positive definite.
    pub fn new(rule: F, criterion: Criterion<M::Real>, covariance: Root<M>) -> Result<Self, Error> {
        let factor = covariance.factor(COVARIANCE.name)?;
        Ok(Self { rule, criterion, root: covariance, covariance: factor })
    }
}

impl<M: Memory, F: Forgetting<M>> CovarianceResetting<M, F> {
    /// Where the rule only takes information: what data add until the next reset. `smallest` is the
    /// least that P starts from, at first or after a reset, and `least` that after a reset.
    fn bound_below(&self, constants: &Constants, (smallest, least): (f64, f64)) -> Option<f64> {
        let about = RULES.iter().find(|about| about.name == self.rule.name())?;
        if about.guarantees?.proper.claim != Claim::Always {
            return None;
        }
        match self.criterion {
            Criterion::Period(samples) => {
                let added = constants.regressor_bound * samples as f64;
                positive(1.0 / (added + 1.0 / smallest))
            }
            Criterion::SmallestEigenvalue(threshold) => {
                constants.least_after(threshold.to_f64().min(least))
            }
            Criterion::Trace(_) | Criterion::Change { .. } => None,
        }
    }
}

impl<M: Memory, F: Forgetting<M>> Forgetting<M> for CovarianceResetting<M, F> {
    type State = Resetting<M, F::State>;

    fn configure(values: &dyn Values, memory: M) -> Result<Self, Error> {
        let rule = inner::configure(&RULE, values, memory)?;
        let covariance = Root::configure(&COVARIANCE, values, memory)?;
        Self::new(rule, Criterion::configure(values)?, covariance)
    }

    fn describe(&self, each: &mut dyn FnMut(&'static str, Value<'_>)) {
        inner::describe::<M, F>(RULE.name, &self.rule, each);
        self.criterion.describe(each);
        self.root.describe(COVARIANCE.name, each);
    }

    fn start(&self, memory: M) -> Self::State {
        let before = self.covariance.clone();
        Resetting { rule: self.rule.start(memory), watch: Watch::new(memory), before }
    }

    fn is_bounded(&self) -> bool {
        self.rule.is_bounded()
    }

    fn bounds(&self, constants: &Constants) -> Bounds {
        // what holds of the rule from any P between P₀ and P_∞ on holds here
        let (least, most) = self.root.extremes();
        let (least, most) = (least.to_f64(), most.to_f64());
        let initial = (constants.initial.0.min(least), constants.initial.1.max(most));
        let inner = self.rule.bounds(&Constants { initial, ..*constants });
        let Bounds { below, above } = inner.with_initial(initial);
        let below = below.or_else(|| self.bound_below(constants, (initial.0, least)));
        // after the sample of a reset, P is what that sample leaves of P_∞
        let reset = constants.least_after(least).unwrap_or(0.0);
        let below = below.and_then(|below| positive(below.min(reset)));
        Bounds { below, above }
    }

    fn follow(&self, state: &mut Self::State, step: Step<'_, '_, M>) {
        self.rule.follow(&mut state.rule, step);
    }

    fn change_units(&self, state: &mut Self::State, ratios: &[M::Real]) {
        self.rule.change_units(&mut state.rule, ratios);
    }

    #[inline]
    fn forget(&self, state: &mut Self::State, step: Step<'_, '_, M>) -> Result<Forgotten, Error> {
        let Step { factor, sample, forgetting_factor, elapsed, work } = step;
        let Resetting { rule: own, watch, before } = state;
        let progress = watch.look(&self.criterion, factor, sample, work.first.as_mut());
        if progress.met {
            before.copy_from(factor);
            factor.copy_from(&self.covariance);
        }
        let step = Step { factor: &mut *factor, sample, forgetting_factor, elapsed, work };
        let done = inner::forget(&self.rule, own, step, progress.met);
        let used = matches!(done, Ok(Forgotten { skipped: None, .. }));
        if used {
            watch.remember(progress);
        }
        if !progress.met {
            return done;
        }
        factor.copy_from(if used { &self.covariance } else { before });
        let rank = if used { factor.parameters() } else { 0 };
        Ok(Forgotten { rank, ..done? })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::memory::Dynamic;
    use crate::rules::Subspace;
    use crate::testing::{covariance, forget, forget_with_errors, memory, Dense};

    type Rule = CovarianceResetting<Dynamic<f64>, Subspace<Dynamic<f64>>>;

    fn rule(criterion: Criterion<f64>) -> Rule {
        let m = Dynamic::new(3, 1, 1).unwrap();
        let covariance = Root::scalar(&COVARIANCE, 7.0, m).unwrap();
        CovarianceResetting::new(Subspace::new(1e-3).unwrap(), criterion, covariance).unwrap()
    }

    #[test]
    fn starts_afresh_at_the_period_and_forgets_as_the_rule_between() {
        let (p, phi) = (covariance(), Dense::new(1, &[0.8, -0.2, 1.1]));
        let (rule, m) = (rule(Criterion::Period(2)), memory(&phi, 1));
        let mut state = rule.start(m);
        let plain = forget(&Subspace::new(1e-3).unwrap(), &mut (), &p, &phi, 0.9).covariance;
        let silence = Dense::new(1, &[0.0; 3]);
        for k in 0..6 {
            let outcome = forget(&rule, &mut state, &p, &phi, 0.9);
            let expected =
                if k > 0 && k % 2 == 0 { 7.0 * Dense::identity(3) } else { plain.clone() };
            assert_eq!(outcome.covariance, expected, "sample {k}");
            // skipped by the rule: not counted
            assert!(forget(&rule, &mut state, &p, &silence, 0.9).forgotten.skipped.is_some());
        }
    }

    #[test]
    fn the_size_of_p_is_checked_before_it_is_forgotten() {
        let (p, phi) = (covariance(), Dense::new(1, &[0.8, -0.2, 1.1]));
        let smallest = p.eigenvalues()[0];
        for (exact, criterion) in [
            (p.trace(), Criterion::Trace as fn(f64) -> Criterion<f64>),
            (smallest, Criterion::SmallestEigenvalue),
        ] {
            let reset = |threshold: f64| {
                let rule = rule(criterion(threshold));
                let mut state = rule.start(memory(&phi, 1));
                forget(&rule, &mut state, &p, &phi, 0.9).covariance == 7.0 * Dense::identity(3)
            };
            assert!(reset(exact * (1.0 + 1e-12)) && !reset(exact * (1.0 - 1e-12)));
        }
    }

    #[test]
    fn a_change_of_the_innovations_is_found() {
        let (p, phi) = (covariance(), Dense::new(1, &[0.8, -0.2, 1.1]));
        let rule = rule(Criterion::Change { threshold: 20.0, drift: 0.5, memory: 50 });
        let mut state = rule.start(memory(&phi, 1));
        let mut found = |e: f64| {
            let errors = Dense::new(1, &[e]);
            let outcome = forget_with_errors(&rule, &mut state, &p, (&phi, &errors), 0.9);
            outcome.covariance == 7.0 * Dense::identity(3)
        };
        assert!((0..500).all(|k| !found(if k % 2 == 0 { 1e-3 } else { -1e-3 })));
        // u/v is 16 at first, so that g = 14.5 after one sample and more than 20 after two
        assert_eq!([found(4e-3), found(4e-3)], [false, true]);
    }
}
