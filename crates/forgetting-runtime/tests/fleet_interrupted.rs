//! An update that is ended leaves every stream as it was, bit for bit, and one that goes on has done
//! what it does where nobody is asked.

mod signals;

use forgetting_runtime::{
    BankSettings, Choice, CoreError, Error, Fleet, FleetUpdate, GoOn, Settings, View,
};
use signals::numbers;

/// Fleets of so many numbers that an update may take long.
fn fleets() -> [Fleet; 4] {
    let of_rule = |name, count, n| {
        let settings = Settings { rule: Some(Choice::named(name)), ..Settings::new(n) };
        Fleet::new(count, &settings, None).unwrap()
    };
    [
        of_rule("exponential", 66_001, 10),
        of_rule("subspace", 25_001, 12),
        of_rule("oblique_projection", 120_001, 3),
        Fleet::of_banks(40_001, &BankSettings::new(3)).unwrap(),
    ]
}

/// Takes a sample of each stream, and is told to end at the question with this number, counted from 0;
/// nobody is asked where there is none. Of two streams the sample cannot be used.
fn update(fleet: &mut Fleet, seed: u64, end: Option<usize>) -> Result<FleetUpdate, Error> {
    let (count, n) = (fleet.count(), fleet.parameters());
    let (mut phi, y) = (numbers(seed, count * n), numbers(seed + 1, count));
    (phi[n], phi[2 * n]) = (f64::NAN, 1e300);
    let (shape, length) = ([count, n], [count]);
    let samples = (View::new("phi", &phi[..], &shape)?, View::new("y", &y[..], &length)?, None);
    let outputs = Some(&FleetUpdate::OUTPUTS[..]);
    let Some(end) = end else { return fleet.update(samples, outputs) };
    let mut asked = 0;
    fleet.update_while(None, samples, outputs, &mut || {
        asked += 1;
        if asked > end {
            return Err(CoreError::Function { parameter: "go_on" });
        }
        Ok(())
    })
}

/// Of every seventh stream.
fn states(fleet: &Fleet) -> Vec<Vec<u8>> {
    (0..fleet.count() as i64).step_by(7).map(|i| fleet.state(i).unwrap()).collect()
}

fn bits(told: &FleetUpdate) -> Vec<u64> {
    let arrays = [&told.error, &told.leverage, &told.skipped];
    let numbers = arrays.into_iter().flat_map(|array| array.as_ref().unwrap().elements.to_f64());
    numbers.map(f64::to_bits).collect()
}

#[test]
fn streams_are_as_they_were() {
    for (which, mut fleet) in fleets().into_iter().enumerate() {
        let mut never = fleet.clone();
        for seed in [10, 20] {
            let before = states(&fleet);
            // at its start, and once some streams have taken their samples
            for end in [0, 1] {
                let ended = update(&mut fleet, seed, Some(end)).err();
                assert!(matches!(ended, Some(Error::Core(CoreError::Function { .. }))), "{which}");
                assert!(states(&fleet) == before, "fleet {which}, seed {seed}, question {end}");
            }
            let told = update(&mut fleet, seed, Some(usize::MAX)).unwrap();
            let wanted = update(&mut never, seed, None).unwrap();
            assert!((fleet.count() - 2..fleet.count()).contains(&told.used), "fleet {which}");
            assert!(told.used == wanted.used && bits(&told) == bits(&wanted), "fleet {which}");
            assert!(states(&fleet) == states(&never), "fleet {which}, seed {seed}");
        }
    }
}

/// Fleets of so many numbers that to start again may take long, one of streams with priors of their own.
fn with_and_without_priors() -> [Fleet; 4] {
    let (count, n) = (17_001, 10);
    let variances: Vec<f64> = (0..count * n).map(|i| 1.0 + (i % 7) as f64).collect();
    let shape = [count, n];
    let of_rule = |name, variances: Option<&[f64]>| {
        let given = variances.map(|variances| View::new("P", variances, &shape).unwrap());
        let rule = Some(Choice::named(name));
        let settings = Settings { rule, initial_covariance: given, ..Settings::new(n) };
        Fleet::new(count as i64, &settings, None).unwrap()
    };
    [
        of_rule("exponential", None),
        of_rule("directional", Some(&variances)),
        of_rule("oblique_projection", None),
        Fleet::of_banks(40_001, &BankSettings::new(3)).unwrap(),
    ]
}

/// Work on all streams.
type Work = fn(&mut Fleet, GoOn<'_>) -> Result<(), Error>;

const WORKS: [(&str, Work); 4] = [
    ("grow", |fleet, go_on| fleet.grow_while(9_000, go_on)),
    ("append", |fleet, go_on| {
        let other = fleet.copy(&mut || Ok(()))?;
        fleet.append_while(&other, go_on)
    }),
    ("reset", |fleet, go_on| fleet.reset(None, go_on)),
    ("reset some", |fleet, go_on| {
        let mask: Vec<_> = (0..fleet.count()).map(|i| i % 3 == 1).collect();
        fleet.reset(Some(&mask), go_on)
    }),
];

/// Answers no to the question with this number, counted from 0.
fn no(end: usize) -> impl FnMut() -> Result<(), CoreError> {
    let mut asked = 0;
    move || {
        asked += 1;
        match asked > end {
            true => Err(CoreError::Function { parameter: "go_on" }),
            false => Ok(()),
        }
    }
}

#[test]
fn streams_that_come_or_start_again_are_as_they_were() {
    for (which, mut fleet) in with_and_without_priors().into_iter().enumerate() {
        update(&mut fleet, 10, None).unwrap();
        let (before, count) = (states(&fleet), fleet.count());
        for (name, work) in WORKS {
            let mut never = fleet.clone();
            work(&mut never, &mut || Ok(())).unwrap();
            let mut other = fleet.clone();
            for end in [0, 1, 2, usize::MAX] {
                if work(&mut other, &mut no(end)).is_ok() {
                    assert!(end > 0, "fleet {which}, {name} asks nobody");
                    break;
                }
                assert_eq!(other.count(), count, "fleet {which}, {name}, question {end}");
                assert!(states(&other) == before, "fleet {which}, {name}, question {end}");
            }
            // and it goes on as one that was never ended
            update(&mut other, 30, None).unwrap();
            update(&mut never, 30, None).unwrap();
            assert!(states(&other) == states(&never), "fleet {which}, {name}");
        }
    }
}

#[test]
fn a_fleet_is_made_and_read_as_long_as_it_is_to_go_on() {
    let ends = |error: Option<Error>| {
        assert!(matches!(error, Some(Error::Core(CoreError::Function { .. }))));
    };
    ends(Fleet::new_while(3, &Settings::new(3), None, &mut no(0)).err());
    ends(Fleet::of_banks_while(3, &BankSettings::new(3), &mut no(0)).err());
    for fleet in fleets() {
        let shape = [fleet.count(), fleet.parameters()];
        let phi = vec![1.0; shape[0] * shape[1]];
        ends(fleet.theta(&mut no(0)).err());
        ends(fleet.variance(&mut no(0)).err());
        ends(fleet.samples(&mut no(0)).err());
        ends(fleet.health(&mut no(0)).err());
        ends(fleet.copy(&mut no(0)).err());
        ends(fleet.predict(View::new("phi", &phi[..], &shape).unwrap(), &mut no(0)).err());
    }
}
