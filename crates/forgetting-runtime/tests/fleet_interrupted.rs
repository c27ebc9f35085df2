//! An update that is ended leaves every stream as it was, bit for bit, and one that goes on has done
//! what it does where nobody is asked.

mod signals;

use forgetting_runtime::{
    BankSettings, Choice, CoreError, Error, Fleet, FleetUpdate, Settings, View,
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
