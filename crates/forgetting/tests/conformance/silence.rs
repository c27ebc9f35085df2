//! Long silence, then one direction for as long: P stays positive definite, and what winds up
//! says so before it is refused.

use crate::subjects::{rules, subjects, Subject};
use forgetting::{
    Constant, Equal, Error, Estimator, Fixed, Kernels, Memory, Packed, Prior, Real, Size,
};

/// P₀ = 10 I; what counts as windup is ten times that.
const VARIANCE: f64 = 10.0;

fn run<T: Kernels, const N: usize>(subject: &Subject, samples: usize)
where
    Size<N>: Packed<T>,
{
    let memory = Fixed::<T, N>::new();
    let rate = Constant::new(T::from_f64(0.99)).unwrap();
    let prior = Prior::scalar(memory, T::from_f64(VARIANCE)).unwrap();
    let rule = subject.rule(memory).unwrap();
    let mut estimator = Estimator::new(rule, rate, Equal::new(), prior);
    let direction: [T; N] = core::array::from_fn(|i| T::from_f64(0.3 + i as f64));
    let mut windup = false;
    for k in 0..2 * samples {
        let (phi, y) = if k < samples { ([T::ZERO; N], T::ZERO) } else { (direction, T::ONE) };
        let before = numbers(&estimator);
        match estimator.update(&phi, &[y]) {
            Ok(update) => windup |= update.windup,
            Err(Error::Range { .. }) => {
                assert!(windup, "{subject:?}: refused at sample {k} without a warning");
                assert!(numbers(&estimator) == before, "{subject:?}: sample {k}");
            }
            Err(error) => panic!("{subject:?}, sample {k}: {error}"),
        }
        if k % 1000 == 0 {
            assert!(estimator.is_sound(), "{subject:?}, sample {k}");
        }
    }
    assert!(estimator.is_sound(), "{subject:?}");
    let grown = estimator.factor().largest() > T::from_f64(10.0 * VARIANCE);
    assert!(!grown || windup, "{subject:?}: P grew and nothing was said");
}

/// The first 20 numbers of the state: all of it for the sizes below.
fn numbers<F, R, W, M>(estimator: &Estimator<F, R, W, M>) -> [M::Real; 20]
where
    F: forgetting::Forgetting<M>,
    R: forgetting::Rate<M>,
    W: forgetting::Weighting<M>,
    M: Memory,
{
    let factor = estimator.factor();
    let parts = [estimator.theta(), factor.packed_columns(), factor.diagonal_elements()];
    let mut all = [M::Real::ZERO; 20];
    all.iter_mut().zip(parts.into_iter().flatten()).for_each(|(to, &x)| *to = x);
    all
}

#[test]
fn a_million_silent_samples_in_double_precision() {
    rules().for_each(|subject| run::<f64, 3>(&subject, 1_000_000));
}

#[test]
fn a_million_silent_samples_in_single_precision() {
    rules().for_each(|subject| run::<f32, 3>(&subject, 1_000_000));
}

#[test]
fn every_choice_of_words_and_rules_in_silence() {
    for subject in subjects() {
        run::<f64, 3>(&subject, 30_000);
        run::<f32, 3>(&subject, 30_000);
    }
}
