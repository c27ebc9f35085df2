//! Where P nears the ends of the range of numbers.

use super::given::{estimator, fleet, noise, COUNT};
use forgetting::fleet::{Outputs, Samples};
use forgetting::{Kernels, Real};

/// P of every other stream grows until there is no room: the bound is made tight as often as an
/// estimator does, and from then on nothing is forgotten.
#[test]
fn a_stream_at_the_end_of_the_range_does_what_an_estimator_does() {
    for n in [2, 5, 10, 12] {
        let mut fleet = fleet::<f32>("exponential", n, 0.5);
        let mut singles = [(); 2].map(|()| estimator::<f32>("exponential", n, 0.5));
        let mut held = [0, 0];
        for step in 0..200 {
            let excited = |i: usize| step * n + i;
            let silent = |i: usize| if i == 0 { step } else { usize::MAX };
            let of = |at: usize| if at == usize::MAX { 0.0 } else { noise(at) as f32 };
            let pair: Vec<f32> =
                (0..n).map(|i| of(excited(i))).chain((0..n).map(|i| of(silent(i)))).collect();
            let phi: Vec<f32> = pair.iter().copied().cycle().take(COUNT * n).collect();
            let y = vec![noise(step + 1) as f32; COUNT];
            let told = Outputs { error: None, leverage: None, skipped: None };
            let used = fleet.update(Samples { phi: &phi, y: &y, mask: None }, told).unwrap();
            assert_eq!(used, COUNT);
            for ((single, phi), held) in singles.iter_mut().zip(pair.chunks(n)).zip(&mut held) {
                *held += usize::from(single.update(phi, &y[..1]).unwrap().rank == 0);
            }
        }
        assert!(held[0] == 0 && (100..160).contains(&held[1]), "{held:?}");
        for stream in (0..COUNT).filter(|_| n <= 10) {
            let (of_fleet, single) = (fleet.get(stream).to_bytes(), singles[stream % 2].to_bytes());
            assert_eq!(of_fleet, single, "n = {n}, stream {stream}");
        }
        assert!(fleet.get(1).factor().trace() < f32::CEILING);
    }
}

/// Regressors of every size bring D to its floor and its columns to every length: P becomes no larger.
fn a_measurement_adds_nothing<T: Kernels>(n: usize) {
    let mut fleet = fleet::<T>("none", n, 1.0);
    let size = 0.48 * T::CEILING.to_f64().log10();
    for step in 0..40 {
        let number = |i: usize| {
            let (k, silent) = (step * 7919 + 3 * i, noise(i + step) > 0.3);
            if silent {
                0.0
            } else {
                noise(k).signum() * 10f64.powf(size * noise(k + 1))
            }
        };
        let phi: Vec<T> = (0..COUNT * n).map(|i| T::from_f64(number(i))).collect();
        let before: Vec<_> = (0..COUNT).map(|i| fleet.get(i).factor().trace().to_f64()).collect();
        let told = Outputs { error: None, leverage: None, skipped: None };
        let y = vec![T::ONE; COUNT];
        fleet.update(Samples { phi: &phi, y: &y, mask: None }, told).unwrap();
        for (i, before) in before.iter().enumerate() {
            let (stream, most) = (fleet.get(i), before * (1.0 + 1e-3));
            let trace = stream.factor().trace().to_f64();
            assert!(stream.is_sound(), "n = {n}, stream {i}, step {step}: {:?}", stream.factor());
            assert!(trace <= most, "n = {n}, stream {i}, step {step}: {trace:e} > {most:e}");
        }
    }
}

#[test]
fn at_the_floor_of_d_a_measurement_adds_nothing() {
    for n in [2, 5, 8, 10, 12, 17] {
        a_measurement_adds_nothing::<f64>(n);
        a_measurement_adds_nothing::<f32>(n);
    }
}

#[test]
fn a_hundred_thousand_silent_samples_in_f32() {
    for rule in ["subspace", "none"] {
        let mut fleet = fleet::<f32>(rule, 3, 0.9);
        let mut phi = vec![0.0; COUNT * 3];
        for step in 0..100_000 {
            phi.iter_mut().step_by(3).for_each(|x| *x = noise(step) as f32);
            let told = Outputs { error: None, leverage: None, skipped: None };
            let y = [0.5; COUNT];
            fleet.update(Samples { phi: &phi, y: &y, mask: None }, told).unwrap();
        }
        for i in 0..COUNT {
            let stream = fleet.get(i);
            assert!(stream.is_sound(), "{rule}");
            // nothing was ever told of the other two: they are as they were, but for the rounding
            // of D at each sample (measured 0.0045)
            for d in &stream.factor().diagonal_elements()[1..] {
                assert!((d - 10.0).abs() < 0.02, "{rule}: {d}");
            }
            assert_eq!(stream.theta()[1..], [0.0, 0.0], "{rule}");
        }
    }
}
