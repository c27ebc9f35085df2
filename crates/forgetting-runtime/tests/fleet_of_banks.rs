//! A fleet of banks is as many banks.

mod signals;

use forgetting_runtime::{
    Bank, BankSettings, Choice, Elements, Estimator, Fleet, FleetUpdate, ForgettingFactor, Member,
    NumberType, Settings, Stream, UpdateOptions, View,
};
use signals::numbers;

const COUNT: usize = 11;
const STEPS: u64 = 70;

fn view<'a>(numbers: &'a [f64], shape: &'a [usize]) -> View<'a> {
    View::new("numbers", numbers, shape).unwrap()
}

fn of_type(n: usize, number_type: NumberType) -> BankSettings<'static> {
    let common = Settings { number_type, ..Settings::new(n) };
    BankSettings { common, ..BankSettings::new(n) }
}

/// Exponential forgetting of two speeds, which winds up.
fn fading(n: usize) -> BankSettings<'static> {
    let member = |factor| Member {
        rule: Choice::named("exponential"),
        forgetting_factor: ForgettingFactor::constant(factor),
    };
    BankSettings { members: Some(vec![member(0.9), member(0.5)]), ..BankSettings::new(n) }
}

/// Numbers of streams, each in a unit of its own, of which the first is silent for some time.
fn phi(step: u64, n: usize) -> Vec<f64> {
    let mut phi = numbers(2 + step, COUNT * n);
    for (i, own) in phi.chunks_mut(n).enumerate() {
        own.iter_mut().for_each(|x| *x *= 10f64.powi(i as i32 - 5));
    }
    if (20..50).contains(&step) {
        phi[..n].fill(0.0);
    }
    phi
}

/// Gives both the same samples, `elapsed` apart, and compares what they say, bit for bit.
fn follow(fleet: &mut Fleet, banks: &mut [Bank], n: usize, elapsed: Option<f64>) {
    for step in 0..STEPS {
        let (phi, y) = (phi(step, n), numbers(1000 + step, COUNT));
        let mask: Vec<_> = (0..COUNT as u64).map(|i| (step + i) % 7 != 3).collect();
        let shape = [COUNT, n];
        let samples = (view(&phi, &shape), view(&y, &shape[..1]), Some(&mask[..]));
        let time = elapsed.map(|elapsed| [elapsed]);
        let time = time.as_ref().map(|time| view(time, &[]));
        let told = fleet.update_after(time, samples, Some(&FleetUpdate::OUTPUTS)).unwrap();
        let (error, leverage) = (told.error.unwrap(), told.leverage.unwrap());
        for (i, bank) in banks.iter_mut().enumerate() {
            if !mask[i] {
                assert!(error.elements.to_f64()[i].is_nan());
                continue;
            }
            let options = UpdateOptions { elapsed: elapsed.unwrap_or(1.0), ..Default::default() };
            let sample = (phi[i * n..(i + 1) * n].into(), y[i..=i].into(), None);
            let alone = bank.update_with(sample, options).unwrap();
            assert_eq!(error.elements.to_f64()[i], alone.error.array().elements.to_f64()[0]);
            assert_eq!(leverage.elements.to_f64()[i], alone.leverage);
        }
    }
    assert_same(fleet, banks, n);
}

fn assert_same(fleet: &Fleet, banks: &[Bank], n: usize) {
    assert_eq!(fleet.count(), banks.len());
    let theta = fleet.theta(&mut || Ok(())).unwrap().elements.to_f64();
    let samples = fleet.samples(&mut || Ok(())).unwrap().elements;
    for (i, bank) in banks.iter().enumerate() {
        assert_eq!(fleet.state(i as i64).unwrap(), bank.to_bytes().unwrap(), "stream {i}");
        let own = fleet.get(i as i64 - banks.len() as i64).unwrap();
        assert_eq!(own.to_bytes().unwrap(), bank.to_bytes().unwrap());
        assert_eq!(theta[i * n..(i + 1) * n], bank.theta().elements.to_f64());
        assert_eq!(fleet.covariance(i as i64).unwrap(), bank.covariance());
    }
    let used = banks.iter().map(|bank| bank.samples() as i64).collect();
    assert_eq!(samples, Elements::I64(used));
}

#[test]
fn streams_are_what_banks_are() {
    for number_type in [NumberType::F64, NumberType::F32] {
        // members side by side, and, of more parameters, one by one
        for n in [1, 4, 10, 11] {
            let settings = of_type(n, number_type);
            let mut fleet = Fleet::of_banks(COUNT as i64, &settings).unwrap();
            let mut banks: Vec<_> = (0..COUNT).map(|_| Bank::new(&settings).unwrap()).collect();
            follow(&mut fleet, &mut banks, n, None);
        }
    }
}

#[test]
fn time_between_samples_counts() {
    let mut fleet = Fleet::of_banks(COUNT as i64, &BankSettings::new(3)).unwrap();
    let mut banks: Vec<_> = (0..COUNT).map(|_| Bank::new(&BankSettings::new(3)).unwrap()).collect();
    follow(&mut fleet, &mut banks, 3, Some(0.5));
    follow(&mut fleet, &mut banks, 3, Some(1.0));
}

#[test]
fn weighted_and_gated_members_are_banks_too() {
    let common = Settings {
        weighting: Some(Choice::named("huber")),
        gate: Some(Choice::named("minimum_information")),
        ..Settings::new(3)
    };
    let settings = BankSettings { common, ..BankSettings::new(3) };
    let mut fleet = Fleet::of_banks(COUNT as i64, &settings).unwrap();
    let mut banks: Vec<_> = (0..COUNT).map(|_| Bank::new(&settings).unwrap()).collect();
    follow(&mut fleet, &mut banks, 3, None);
}

#[test]
fn windup_is_that_of_the_last_update() {
    let settings = fading(2);
    let mut fleet = Fleet::of_banks(2, &settings).unwrap();
    let mut bank = Bank::new(&settings).unwrap();
    let mut seen = [false, false];
    for step in 0..200u64 {
        // the first stream is excited in one direction only
        let one = numbers(step, 2);
        let phi = [1.0, 1.0, one[0], one[1]];
        let y = numbers(500 + step, 2);
        fleet.update((view(&phi, &[2, 2]), view(&y, &[2]), None), None).unwrap();
        let alone = bank.update(phi[..2].into(), y[..1].into(), None).unwrap();
        let Elements::Bool(windup) = fleet.health(&mut || Ok(())).unwrap().windup.elements else {
            panic!()
        };
        assert_eq!(windup, [alone.windup, false]);
        seen[usize::from(alone.windup)] = true;
    }
    assert_eq!(seen, [true, true]);
}

#[test]
fn health_bounds_the_eigenvalues() {
    let mut fleet = Fleet::of_banks(COUNT as i64, &BankSettings::new(3)).unwrap();
    for step in 0..STEPS {
        let (phi, y) = (phi(step, 3), numbers(1000 + step, COUNT));
        let samples = (view(&phi, &[COUNT, 3]), view(&y, &[COUNT]), None);
        fleet.update(samples, None).unwrap();
    }
    let (health, variance) = (
        fleet.health(&mut || Ok(())).unwrap(),
        fleet.variance(&mut || Ok(())).unwrap().elements.to_f64(),
    );
    for i in 0..COUNT {
        let own = &variance[3 * i..3 * i + 3];
        let most = own.iter().fold(own[0], |most, &p| most.max(p));
        assert_eq!(health.largest.elements.to_f64()[i], most);
        assert!(health.smallest.elements.to_f64()[i] <= most);
        let diagonal = fleet.covariance(i as i64).unwrap().elements.to_f64();
        for (k, &p) in own.iter().enumerate() {
            assert!((diagonal[4 * k] / p - 1.0).abs() < 1e-9);
        }
    }
}

#[test]
fn states_come_back_bit_for_bit_and_are_checked() {
    let settings = BankSettings::new(3);
    let mut fleet = Fleet::of_banks(COUNT as i64, &settings).unwrap();
    let mut banks: Vec<_> = (0..COUNT).map(|_| Bank::new(&settings).unwrap()).collect();
    follow(&mut fleet, &mut banks, 3, None);
    let states: Vec<_> = (0..COUNT as i64).map(|i| fleet.state(i).unwrap()).collect();
    let slices: Vec<_> = states.iter().map(Vec::as_slice).collect();
    let fresh = fleet.fresh_state().unwrap();
    let mut restored = Fleet::from_states(&fresh, &slices, &mut || Ok(())).unwrap();
    follow(&mut restored, &mut banks, 3, None);

    let refused = |states: &[&[u8]]| {
        Fleet::from_states(&fresh, states, &mut || Ok(())).err().unwrap().to_string()
    };
    let mut altered = states[1].clone();
    altered[100] ^= 1;
    assert!(refused(&[&states[0], &altered]).starts_with("stream 1: state: it is truncated or"));
    assert_eq!(refused(&[&states[0][..50]]), "stream 0: state: it is truncated");
    let single = Estimator::new(&Settings::new(3)).unwrap().to_bytes().unwrap();
    assert_eq!(refused(&[&single]), "stream 0: state: it is not a saved bank of estimators");
    let other = Bank::new(&fading(3)).unwrap().to_bytes().unwrap();
    assert!(refused(&[&other]).contains("the same members, mixer and prior"));
}

#[test]
fn streams_are_put_added_and_reset() {
    let settings = BankSettings::new(3);
    let mut fleet = Fleet::of_banks(2, &settings).unwrap();
    let fresh = fleet.state(0).unwrap();
    let mut bank = Bank::new(&settings).unwrap();
    bank.update([1.0, 2.0, 3.0][..].into(), [1.0][..].into(), None).unwrap();
    fleet.put(1, bank.clone()).unwrap();
    let other = fleet.clone();
    fleet.append(&other).unwrap();
    fleet.grow(1).unwrap();
    let learned = bank.to_bytes().unwrap();
    for (i, state) in [&fresh, &learned, &fresh, &learned, &fresh].into_iter().enumerate() {
        assert_eq!(fleet.state(i as i64).unwrap(), *state);
    }
    fleet.reset(Some(&[false, true, false, false, false]), &mut || Ok(())).unwrap();
    assert_eq!(fleet.state(1).unwrap(), fresh);
    assert_eq!(fleet.state(3).unwrap(), learned);
    fleet.reset(None, &mut || Ok(())).unwrap();
    assert_eq!(fleet.state(3).unwrap(), fresh);
    assert!(fleet.describe().is_none() && fleet.forgetting_factor().unwrap().is_none());

    let mut refused = |new: Stream| fleet.put(0, new).unwrap_err().to_string();
    let single = Estimator::new(&Settings::new(3)).unwrap();
    assert_eq!(refused(single.into()), "a stream of this fleet is a bank, not one estimator");
    let larger = Bank::new(&BankSettings::new(4)).unwrap();
    assert_eq!(refused(larger.into()), "a stream has as many parameters as its fleet");
    let f32 = Bank::new(&of_type(3, NumberType::F32)).unwrap();
    assert_eq!(refused(f32.into()), "a stream has the dtype of its fleet");
    let fading = Bank::new(&fading(3)).unwrap();
    assert!(refused(fading.into()).contains("the same members, mixer and prior"));
    let rows = Settings { rows: 2, ..Settings::new(3) };
    let rows = BankSettings { common: rows, ..BankSettings::new(3) };
    let rows = Bank::new(&rows).unwrap();
    assert_eq!(refused(rows.into()), "a stream has one row and one target");
    let estimators = Fleet::new(1, &Settings::new(3), None).unwrap();
    assert!(fleet.append(&estimators).unwrap_err().to_string().contains("is a bank"));
    assert_eq!(fleet.count(), 5);
}

#[test]
fn threads_change_nothing() {
    let mut one = Fleet::of_banks(COUNT as i64, &BankSettings::new(4)).unwrap();
    let mut other = one.clone();
    one.set_threads(Some(1));
    other.set_threads(Some(3));
    for step in 0..STEPS {
        let (phi, y) = (phi(step, 4), numbers(1000 + step, COUNT));
        let time = numbers(2000 + step, COUNT).iter().map(|x| x.abs()).collect::<Vec<_>>();
        let update = |fleet: &mut Fleet| {
            let samples = (view(&phi, &[COUNT, 4]), view(&y, &[COUNT]), None);
            let time = (step % 3 == 0).then(|| view(&time, &[COUNT]));
            fleet.update_after(time, samples, Some(&FleetUpdate::OUTPUTS)).unwrap()
        };
        assert_eq!(update(&mut one), update(&mut other));
    }
    for i in 0..COUNT as i64 {
        assert_eq!(one.state(i).unwrap(), other.state(i).unwrap());
    }
}
