//! What is saved comes back bit for bit, in its number type.

mod signals;

use forgetting_runtime::{Choice, Estimator, Fleet, Missing, NumberType, Settings, View};
use signals::numbers;

const SAMPLES: usize = 60;

fn run(estimator: &mut Estimator, seed: u64) {
    let (phi, y) = (numbers(seed, SAMPLES * 3), numbers(seed + 1, SAMPLES));
    let phi = View::new("phi", &phi[..], &[SAMPLES, 3]).unwrap();
    let y = View::new("y", &y[..], &[SAMPLES]).unwrap();
    estimator.run((phi, y, None), Missing::Error, None).unwrap();
}

#[test]
fn an_estimator_goes_on_as_if_it_had_not_been_saved() {
    for number_type in [NumberType::F64, NumberType::F32] {
        for rule in ["subspace", "variable_direction", "multiple"] {
            let rule = Some(Choice::named(rule));
            let mut estimator =
                Estimator::new(&Settings { number_type, rule, monitor: true, ..Settings::new(3) })
                    .unwrap();
            run(&mut estimator, 1);
            let state = estimator.to_bytes().unwrap();
            let mut restored = Estimator::from_bytes(&state).unwrap();
            assert_eq!(restored.number_type(), number_type);
            assert_eq!(restored.to_bytes().unwrap(), state);
            run(&mut estimator, 3);
            run(&mut restored, 3);
            assert_eq!(restored.to_bytes().unwrap(), estimator.to_bytes().unwrap());
            assert_eq!(restored.health().unwrap().samples, 2 * SAMPLES as u64);
            restored.reset();
            assert_eq!((restored.samples(), restored.health().unwrap().samples), (0, 0));
        }
    }
}

#[test]
fn what_is_no_state_is_refused() {
    let state = Estimator::new(&Settings::new(2)).unwrap().to_bytes().unwrap();
    for length in 0..state.len() {
        let error = Estimator::from_bytes(&state[..length]).err().unwrap();
        assert!(error.to_string().starts_with("state: "), "{error}");
    }
}

#[test]
fn a_fleet_goes_on_as_if_it_had_not_been_saved() {
    for number_type in [NumberType::F64, NumberType::F32] {
        let settings = Settings { number_type, ..Settings::new(2) };
        let mut fleet = Fleet::new(11, &settings, None).unwrap();
        let (phi, y) = (numbers(5, 22), numbers(6, 11));
        let (shape, count) = ([11, 2], [11]);
        let sample = || {
            let phi = View::new("phi", &phi[..], &shape).unwrap();
            (phi, View::new("y", &y[..], &count).unwrap(), None)
        };
        fleet.update(sample(), None).unwrap();
        let states: Vec<_> = (0..11).map(|i| fleet.state(i).unwrap()).collect();
        let slices: Vec<&[u8]> = states.iter().map(Vec::as_slice).collect();
        let mut restored =
            Fleet::from_states(&fleet.fresh_state().unwrap(), &slices, &mut || Ok(())).unwrap();
        assert_eq!(restored.number_type(), number_type);
        fleet.update(sample(), None).unwrap();
        restored.update(sample(), None).unwrap();
        restored.grow(1).unwrap();
        fleet.grow(1).unwrap();
        for stream in 0..12 {
            assert_eq!(restored.state(stream).unwrap(), fleet.state(stream).unwrap());
        }
        let error = Fleet::from_states(&states[0], &[&states[0], b"no state"], &mut || Ok(()))
            .err()
            .unwrap();
        assert_eq!(error.to_string(), "stream 1: state: it is truncated");
    }
}
