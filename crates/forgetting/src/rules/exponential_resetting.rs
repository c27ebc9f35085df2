//! Forgets towards a fixed information matrix, so that in silence P returns to its inverse.
//!
//! ```text
//! F_k = (1 − λ_k) (R_k − R_∞)              GF-RLS (55)
//! R̄ = λ R + (1 − λ) R_∞                    the form used: D ← D / λ, then one information
//!                                          row √(1 − λ) r for each row r of a root of R_∞
//! ```
//!
//! | symbol | name | range | default |
//! |---|---|---|---|
//! | R_∞ | information | a number c ≥ 0 (c·I), n numbers ≥ 0 or an n x n positive semidefinite matrix | 0.01 |
//!
//! - Proper (A1): if R₀ ≥ R_∞.
//! - P̄ bounded above without excitation (A2): if R_∞ > 0: R_k ≥ λᵏR₀ + (1 − λᵏ)R_∞.
//! - P bounded below (A3): if λ_k ≤ λ_max < 1 and φ is bounded.
//! - Cost: O((p + r) n²), r the rank of R_∞; O(n³) for a full one. State: P alone.
//! - Use it when what is known without data should come back in silence. `cyclic_resetting`
//!   does nearly the same in O(n²).
//! - Not where what was learned should outlive silence: it fades towards R_∞. `subspace` keeps it.
//!
//! Reference: B. Lai, D. S. Bernstein, *Generalized forgetting recursive least squares:
//! stability and robustness guarantees*, IEEE Transactions on Automatic Control, 2024, V-E.

use super::{Forgetting, Forgotten, Step};
use crate::choice::guarantee::positive;
use crate::choice::{
    About, Bounds, Constants, Guarantee, Guarantees, Input, Kind, Parameter, Range, Setting, Value,
    Values,
};
use crate::rules::root::Root;
use crate::error::Error;
use crate::memory::Memory;
use forgetting_kernels::Real;

const INFORMATION: Parameter = Parameter::elements(
    "information",
    Kind::Matrix,
    0.01,
    Range::NON_NEGATIVE,
    "information that silence returns to: c for c*I, n numbers for a diagonal, or n x n",
);

/// The registry entry.
pub const ABOUT: About = About {
    forgetting_factor: true,
    squares: 3,
    cost: "O((p + r) n^2), r = rank of information",
    guarantees: Some(Guarantees {
        proper: Guarantee::when(
            "R_0 >= information",
            Setting::usual(Input::Exciting(1)).with(&[("information", Value::Real(1.0))]),
        ),
        bounded_above: Guarantee::when(
            "information is positive definite",
            Setting::usual(Input::Silent).factor(0.99).with(&[("information", Value::Real(0.0))]),
        ),
        bounded_below: Guarantee::when(
            "forgetting factor <= lambda_max < 1, regressors bounded",
            Setting::usual(Input::Exciting(1)).factor(1.0),
        ),
    }),
    ..About::new(&[INFORMATION])
};

/// Forgets towards R_∞; see [`self`](crate::rules::exponential_resetting).
#[derive(Clone, Debug)]
pub struct ExponentialResetting<M: Memory> {
    information: Root<M>,
}

impl<M: Memory> ExponentialResetting<M> {
    /// Towards the information matrix with this root.
    pub fn new(information: Root<M>) -> Self {
        Self { information }
    }
}

impl<M: Memory> Forgetting<M> for ExponentialResetting<M> {
    type State = ();

    fn configure(values: &dyn Values, memory: M) -> Result<Self, Error> {
        Root::configure(&INFORMATION, values, memory).map(Self::new)
    }

    fn describe(&self, each: &mut dyn FnMut(&'static str, Value<'_>)) {
        self.information.describe(INFORMATION.name, each);
    }

    fn start(&self, _: M) {}

    fn is_bounded(&self) -> bool {
        self.information.rank() == self.information.parameters()
    }

    fn bounds(&self, constants: &Constants) -> Bounds {
        let (least, most) = self.information.extremes();
        let forgotten = 1.0 - constants.forgetting_factors.1;
        Bounds {
            below: positive(1.0 / (constants.regressor_bound / forgotten + most.to_f64())),
            above: positive(1.0 / least.to_f64()),
        }
    }

    #[inline]
    fn forget(&self, (): &mut (), step: Step<'_, '_, M>) -> Result<Forgotten, Error> {
        let lambda = step.forgetting_factor;
        if lambda >= M::Real::ONE {
            return Ok(Forgotten::rank(0));
        }
        step.factor.scale(M::Real::ONE / lambda)?;
        let weight = (M::Real::ONE - lambda).sqrt();
        let n = step.factor.parameters();
        let scaled = &mut step.work.first.as_mut()[..n];
        for row in self.information.rows() {
            for (x, &r) in scaled.iter_mut().zip(row) {
                *x = weight * r;
            }
            step.factor.add_information(scaled, step.work.gain.as_mut());
        }
        Ok(Forgotten::rank(n))
    }
}
