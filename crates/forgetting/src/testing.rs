//! One step of a rule, seen as dense matrices, for the unit tests of the rules.

use crate::covariance::Factor;
use crate::memory::{Dynamic, Memory};
use crate::rules::{Forgetting, Forgotten, Step};
use crate::sample::{Sample, Work};
pub use dense::Dense;

#[path = "../tests/dense/mod.rs"]
mod dense;

/// What a rule made of P and of the sample.
pub struct Outcome {
    pub covariance: Dense,
    pub regressors: Dense,
    pub forgotten: Forgotten,
}

/// Lets `rule` forget at one sample.
pub fn forget<F: Forgetting<Dynamic<f64>>>(
    rule: &F,
    state: &mut F::State,
    covariance: &Dense,
    phi: &Dense,
    forgetting_factor: f64,
) -> Outcome {
    let errors = Dense::new(phi.rows, &alloc::vec![2.0; phi.rows]);
    forget_with_errors(rule, state, covariance, (phi, &errors), forgetting_factor)
}

/// The same with the errors of the sample, p x m.
pub fn forget_with_errors<F: Forgetting<Dynamic<f64>>>(
    rule: &F,
    state: &mut F::State,
    covariance: &Dense,
    (phi, errors): (&Dense, &Dense),
    forgetting_factor: f64,
) -> Outcome {
    let memory = memory(phi, errors.columns);
    let mut factor = Factor::dense(memory, &covariance.elements).unwrap();
    let (mut regressors, mut errors) = (phi.elements.clone(), errors.elements.clone());
    let mut sample = Sample::new(memory, &mut regressors, &mut errors);
    let mut work = Work::new(memory);
    let step = Step {
        factor: &mut factor,
        sample: &mut sample,
        forgetting_factor,
        elapsed: 1.0,
        work: &mut work,
    };
    let forgotten = rule.forget(state, step).unwrap();
    let rows = sample.rows();
    let n = memory.parameters();
    let mut dense = Dense::zero(n, n);
    factor.reconstruct(&mut dense.elements);
    let regressors = Dense { rows, columns: n, elements: regressors[..rows * n].to_vec() };
    Outcome { covariance: dense, regressors, forgotten }
}

/// The sizes of a sample with this regressor.
pub fn memory(phi: &Dense, targets: usize) -> Dynamic<f64> {
    Dynamic::new(phi.columns, phi.rows, targets).unwrap()
}

/// A positive definite matrix with no pattern, 3 x 3.
pub fn covariance() -> Dense {
    let root = Dense::new(3, &[2.0, 0.3, -0.4, 0.0, 0.7, 0.5, 0.0, 0.0, 1.3]);
    root.clone() * root.transpose()
}

/// A regressor of two rows with no pattern, 2 x 3.
pub fn two_rows() -> Dense {
    Dense::new(2, &[0.8, -0.2, 1.1, 0.4, 0.9, -0.3])
}

/// The measurement step: (P⁻¹ + φᵀφ)⁻¹.
pub fn measured(covariance: &Dense, phi: &Dense) -> Dense {
    (covariance.inverse() + phi.transpose() * phi.clone()).inverse()
}
