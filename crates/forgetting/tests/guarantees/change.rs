//! How often the change detector of `covariance_resetting` is wrong, and how soon it is right: the
//! numbers of its header.

use crate::record::Noise;
use crate::subjects::{Given, Item};
use forgetting::rules::covariance_resetting::CovarianceResetting;
use forgetting::{Constant, Equal, Estimator, Fixed, Forgetting, NoForgetting, Prior};

type One = Fixed<f64, 1>;
type Rule = CovarianceResetting<One, NoForgetting<One>>;
type Detector = Estimator<Rule, Constant<One>, Equal<One>, One>;

fn detector() -> Detector {
    let memory = One::new();
    let change = Given::one("criterion", Item::Word("change"));
    let rule = change.with(|values| <Rule as Forgetting<One>>::configure(values, memory)).unwrap();
    let prior = Prior::scalar(memory, 1.0).unwrap();
    Estimator::new(rule, Constant::new(1.0).unwrap(), Equal::new(), prior)
}

/// A standard normal number, by Box and Muller.
fn normal(noise: &mut Noise) -> f64 {
    let (u, v) = ((noise.next() + 1.0) / 2.0, noise.next());
    (-2.0 * u.max(f64::MIN_POSITIVE).ln()).sqrt() * (std::f64::consts::PI * v).cos()
}

/// Whether the sample makes P start afresh; between resets nothing is forgotten.
fn resets(detector: &mut Detector, y: f64) -> bool {
    detector.update(&[1.0], &[y]).unwrap().rank > 0
}

#[test]
fn a_false_alarm_comes_once_in_40_000_samples() {
    let (mut detector, mut noise) = (detector(), Noise::new(1));
    const SAMPLES: usize = 4_000_000;
    let alarms = (0..SAMPLES).filter(|_| resets(&mut detector, normal(&mut noise))).count();
    // over ten seeds: 75 to 96
    assert!((65..125).contains(&alarms), "{alarms}");
}

#[test]
fn tenfold_variance_is_found_after_4_to_5_samples() {
    let mut noise = Noise::new(2);
    const TRIALS: usize = 2000;
    let mut delays = 0;
    for _ in 0..TRIALS {
        let mut detector = detector();
        for _ in 0..300 {
            resets(&mut detector, normal(&mut noise));
        }
        let mut found = || resets(&mut detector, 10f64.sqrt() * normal(&mut noise));
        delays += 1 + (0..1000).take_while(|_| !found()).count();
    }
    let mean = delays as f64 / TRIALS as f64;
    assert!((4.0..5.0).contains(&mean), "{mean}");
}
