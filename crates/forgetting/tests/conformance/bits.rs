//! The same bits on the stack and on the heap, and after a save in the middle.

use crate::record::{record, Datum};
use crate::subjects::{subjects, update, Subject};
use forgetting::rules::Rule;
use forgetting::saved::AnyEstimator;
use forgetting::{
    Constant, Equal, Estimator, Fixed, Forgetting, Kernels, Memory, Noise, Packed, Prior, Rate,
    Real, Size, Weighting,
};

const SAMPLES: usize = 240;

/// Everything that an estimator tells, sample by sample, bit for bit.
fn trace<F, R, W, M>(
    subject: &Subject,
    mut estimator: Estimator<F, R, W, M>,
    data: &[Datum<M::Real>],
) -> Vec<u64>
where
    F: Forgetting<M>,
    R: Rate<M>,
    W: Weighting<M>,
    M: Memory,
{
    let mut told = Vec::new();
    for (k, Datum { phi, y, gamma }) in data.iter().enumerate() {
        let noise = [Noise::Unit, Noise::Scalar(gamma[0]), Noise::Full(gamma)][k % 3];
        let update = update(&mut estimator, phi, y, noise);
        let update = update.unwrap_or_else(|e| panic!("{subject:?}, sample {k}: {e}"));
        told.extend(update.error.iter().map(|x| x.to_bits()));
        told.push(update.leverage.to_bits());
        told.push(update.forgetting_factor.to_bits());
        told.extend([update.rank as u64, update.skipped.map_or(0, |s| s.code().into())]);
        assert!(estimator.is_sound(), "{subject:?}, sample {k}");
        let factor = estimator.factor();
        let state = [estimator.theta(), factor.packed_columns(), factor.diagonal_elements()];
        told.extend(state.iter().flat_map(|part| part.iter().map(|x| x.to_f64().to_bits())));
    }
    told
}

fn same_bits<T: Kernels, const N: usize, const P: usize, const M: usize>()
where
    Size<N>: Packed<T>,
{
    let (memory, data) = (Fixed::<T, N, P, M>::new(), record::<T>((N, P, M), SAMPLES));
    for subject in subjects() {
        let Some(heap) = subject.estimator::<T>((N, P, M), 0.97, 10.0) else { continue };
        let rule: Rule<Fixed<T, N, P, M>> = subject.rule(memory).unwrap();
        let rate = Constant::new(T::from_f64(0.97)).unwrap();
        let prior = Prior::scalar(memory, T::from_f64(10.0)).unwrap();
        let stack = Estimator::new(rule, rate, Equal::new(), prior);
        let (stack, heap) = (trace(&subject, stack, &data), trace(&subject, heap, &data));
        assert!(stack == heap, "{subject:?} with n = {N}, p = {P}, m = {M}");
    }
}

#[test]
fn fixed_and_dynamic_sizes_give_the_same_bits() {
    same_bits::<f64, 3, 1, 1>();
    same_bits::<f64, 9, 3, 2>();
    same_bits::<f32, 3, 1, 1>();
}

fn feed<T: Kernels>(estimator: &mut AnyEstimator<T>, data: &[Datum<T>]) {
    for Datum { phi, y, gamma } in data {
        update(estimator, phi, y, Noise::Full(gamma)).unwrap();
    }
}

fn survives_a_save<T: Kernels>(sizes: (usize, usize, usize)) {
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
fn work_that_fails_changes_no_bit() {
    let data = record::<f64>((3, 1, 1), SAMPLES);
    let (first, rest) = data.split_at(SAMPLES / 2);
    for subject in subjects() {
        let mut estimator = subject.estimator::<f64>((3, 1, 1), 0.97, 10.0).unwrap();
        estimator.enable_monitor();
        feed(&mut estimator, first);
        let (before, mut whole) = (estimator.to_bytes().unwrap(), estimator.clone());
        feed(&mut whole, rest);
        let failed = estimator.all_or_nothing(|estimator| {
            feed(estimator, rest);
            assert!(estimator.to_bytes().unwrap() != before, "{subject:?}");
            Err::<(), _>("failed")
        });
        assert_eq!(failed, Err("failed"));
        assert!(estimator.to_bytes().unwrap() == before, "{subject:?}");
        let done = estimator.all_or_nothing(|estimator| {
            feed(estimator, rest);
            Ok::<_, ()>(estimator.samples())
        });
        assert_eq!(done, Ok(whole.samples()));
        assert!(estimator.to_bytes().unwrap() == whole.to_bytes().unwrap(), "{subject:?}");
    }
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
