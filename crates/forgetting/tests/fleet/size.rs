//! Streams that are copied to another fleet, and taken away again.

use super::given::{estimator, given, COUNT};
use forgetting::fleet::{Fleet, Outputs, Samples};
use forgetting::saved::AnyEstimator;
use forgetting::{Dynamic, Error, Estimator, Kernels, Prior};

const N: usize = 3;

fn with_prior<T: Kernels>(factor: f64, prior: Prior<Dynamic<T>>) -> AnyEstimator<T> {
    let like = estimator::<T>("exponential", N, factor);
    Estimator::new(like.rule().clone(), like.rate().clone(), like.weighting().clone(), prior)
}

/// Streams that differ in what they start from and in how fast they forget, or do not.
fn fleets<T: Kernels>() -> [Fleet<T>; 3] {
    let memory = Dynamic::<T>::new(N, 1, 1).unwrap();
    let data = Prior::of_data(memory);
    let own = |x| Prior::scalar(memory, T::from_f64(x)).unwrap();
    let plain = Fleet::of(estimator("exponential", N, 0.95)).unwrap();
    let follows = Fleet::of(with_prior(0.95, data.clone())).unwrap();
    let mut all = [plain.clone(), plain, follows];
    for fleet in &mut all {
        fleet.grow(COUNT).unwrap();
    }
    for i in (0..COUNT).step_by(3) {
        let prior = if i % 2 == 0 { own(1.0 + i as f64) } else { data.clone() };
        all[1].put(i, with_prior(0.5 + 0.01 * i as f64, prior)).unwrap();
    }
    all
}

fn take<T: Kernels>(fleet: &mut Fleet<T>, step: usize) {
    let count = fleet.count();
    let given = given::<T>(step, N);
    let phi: Vec<T> = given.phi.iter().copied().cycle().take(N * count).collect();
    let y: Vec<T> = given.y.iter().copied().cycle().take(count).collect();
    let told = Outputs { error: None, leverage: None, skipped: None };
    fleet.update(Samples { phi: &phi, y: &y, mask: None }, told).unwrap();
}

fn states<T: Kernels>(fleet: &Fleet<T>) -> Vec<Vec<u8>> {
    (0..fleet.count()).map(|i| fleet.get(i).to_bytes().unwrap()).collect()
}

fn check<T: Kernels>() {
    for (a, mut own) in fleets::<T>().into_iter().enumerate() {
        (0..20).for_each(|step| take(&mut own, step));
        for (b, mut others) in fleets::<T>().into_iter().enumerate() {
            (20..50).for_each(|step| take(&mut others, step));
            let (before, theirs) = (states(&own), states(&others));
            let mut both = own.clone();
            both.append(&others, 2..COUNT - 1).unwrap();
            assert_eq!(states(&both), [&before[..], &theirs[2..COUNT - 1]].concat(), "{a} {b}");
            // what is taken away leaves nothing behind: new streams come, and all go on
            let mut grown = own.clone();
            both.truncate(COUNT);
            assert_eq!(states(&both), before, "{a} {b}");
            for fleet in [&mut both, &mut grown] {
                fleet.grow(5).unwrap();
                (50..80).for_each(|step| take(fleet, step));
                fleet.reset((0..COUNT + 5).step_by(2));
            }
            assert_eq!(states(&both), states(&grown), "{a} {b}");
            both.truncate(0);
            both.append(&others, 0..COUNT).unwrap();
            assert_eq!(states(&both), theirs, "{a} {b}");
        }
    }
}

#[test]
fn copies_are_the_streams_and_what_is_taken_away_leaves_nothing_behind() {
    check::<f64>();
    check::<f32>();
}

#[test]
fn streams_that_do_not_fit_change_nothing() {
    // with so many parameters an estimator that follows the data is no stream of lanes
    let memory = Dynamic::<f64>::new(N, 1, 1).unwrap();
    let mut own = Fleet::of(with_prior(0.9, Prior::scalar(memory, 1.0).unwrap())).unwrap();
    own.grow(4).unwrap();
    let mut others = Fleet::of(estimator::<f64>("subspace", N, 0.9)).unwrap();
    others.grow(2).unwrap();
    let before = states(&own);
    assert!(matches!(own.append(&others, 0..2), Err(Error::Unsupported { .. })));
    assert_eq!(states(&own), before);
}
