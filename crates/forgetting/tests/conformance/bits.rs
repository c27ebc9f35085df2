//! The same bits on the stack and on the heap, and after a save in the middle.

use crate::record::{record, Datum};
use crate::subjects::{subjects, Subject};
use forgetting::rules::Rule;
use forgetting::saved::AnyEstimator;
use forgetting::{
    Constant, Dynamic, Equal, Error, Estimator, Fixed, Memory, Noise, Packed, Prior, Real, Size,
};

const SAMPLES: usize = 240;

/// Everything that an estimator tells, sample by sample.
fn trace<M: Memory>(subject: &Subject, memory: M, data: &[Datum<M::Real>]) -> Option<Vec<f64>> {
    let rule = match subject.rule(memory) {
        Err(Error::Value { parameter: "rows", .. }) => return None,
        rule => rule.unwrap(),
    };
    let rate = Constant::new(M::Real::from_f64(0.97)).unwrap();
    let prior = Prior::scalar(memory, M::Real::from_f64(10.0)).unwrap();
    let mut estimator: Estimator<Rule<M>, _, Equal<M>, M> =
        Estimator::new(rule, rate, Equal::new(), prior);
    let mut told = Vec::new();
    for (k, Datum { phi, y, gamma }) in data.iter().enumerate() {
        let noise = [Noise::Unit, Noise::Scalar(gamma[0]), Noise::Full(gamma)][k % 3];
        match estimator.update_weighted(phi, y, noise) {
            Ok(update) => {
                told.extend(update.error.iter().map(|x| x.to_f64()));
                told.extend([update.leverage.to_f64(), update.forgetting_factor.to_f64()]);
                told.extend([update.rank as f64, update.skipped.map_or(0.0, |s| s.code().into())]);
            }
            Err(error) => panic!("{subject:?}, sample {k}: {error}"),
        }
        assert!(estimator.is_sound(), "{subject:?}, sample {k}");
        let factor = estimator.factor();
        let state = [estimator.theta(), factor.packed_columns(), factor.diagonal_elements()];
        told.extend(state.iter().flat_map(|part| part.iter().map(|x| x.to_f64())));
    }
    Some(told)
}

fn same_bits<T: Real, const N: usize, const P: usize, const M: usize>()
where
    Size<N>: Packed<T>,
{
    let data = record::<T>((N, P, M), SAMPLES);
    for subject in subjects() {
        let stack = trace(&subject, Fixed::<T, N, P, M>::new(), &data);
        let heap = trace(&subject, Dynamic::new(N, P, M).unwrap(), &data);
        let bits = |told: Option<Vec<f64>>| {
            told.map(|told| told.into_iter().map(f64::to_bits).collect::<Vec<_>>())
        };
        assert!(bits(stack) == bits(heap), "{subject:?} with n = {N}, p = {P}, m = {M}");
    }
}

#[test]
fn fixed_and_dynamic_sizes_give_the_same_bits() {
    same_bits::<f64, 1, 1, 1>();
    same_bits::<f64, 3, 1, 2>();
    same_bits::<f64, 4, 2, 1>();
    same_bits::<f64, 9, 3, 3>();
    same_bits::<f32, 2, 1, 1>();
    same_bits::<f32, 5, 2, 2>();
}

fn feed<T: Real>(estimator: &mut AnyEstimator<T>, data: &[Datum<T>]) {
    for Datum { phi, y, gamma } in data {
        estimator.update_weighted(phi, y, Noise::Full(gamma)).unwrap();
    }
}

fn survives_a_save<T: Real>(sizes: (usize, usize, usize)) {
    let data = record::<T>(sizes, SAMPLES);
    for subject in subjects() {
        let Some(mut whole) = subject.estimator::<T>(sizes, 0.97, 10.0) else { continue };
        let mut broken = whole.clone();
        for piece in data.chunks(SAMPLES / 5 + 3) {
            feed(&mut whole, piece);
            feed(&mut broken, piece);
            let bytes = broken.to_bytes().unwrap();
            broken =
                AnyEstimator::from_bytes(&bytes).unwrap_or_else(|e| panic!("{subject:?}: {e}"));
            assert!(broken.to_bytes().unwrap() == bytes, "{subject:?}");
            assert!(whole.to_bytes().unwrap() == bytes, "{subject:?}");
        }
        // and a reset makes a new one
        let new = subject.estimator::<T>(sizes, 0.97, 10.0).unwrap();
        broken.reset();
        assert!(broken.to_bytes().unwrap() == new.to_bytes().unwrap(), "{subject:?}");
    }
}

#[test]
fn a_save_in_the_middle_changes_no_bit() {
    survives_a_save::<f64>((3, 1, 1));
    survives_a_save::<f64>((4, 2, 3));
    survives_a_save::<f32>((3, 3, 2));
}

#[test]
fn a_damaged_save_is_refused() {
    for subject in subjects() {
        let mut estimator = subject.estimator::<f64>((3, 1, 1), 0.97, 10.0).unwrap();
        feed(&mut estimator, &record((3, 1, 1), 30));
        let bytes = estimator.to_bytes().unwrap();
        for k in 0..bytes.len() {
            assert!(AnyEstimator::<f64>::from_bytes(&bytes[..k]).is_err());
            let mut altered = bytes.clone();
            altered[k] ^= 1 << (k % 8);
            assert!(AnyEstimator::<f64>::from_bytes(&altered).is_err(), "{subject:?}, byte {k}");
        }
    }
}
