//! Members that run side by side beside the same estimators one by one: the same bits.

use forgetting::bank::{Bank, BankOutcome, Kept};
use forgetting::choice::Defaults;
use forgetting::mixers::AnyMixer;
use forgetting::rates::AnyRate;
use forgetting::rules::{RandomWalk, Rule};
use forgetting::weightings::{AnyWeighting, Equal};
use forgetting::{AnyEstimator, Constant, Dynamic, Estimator, Kernels, Noise, Prior};

/// Numbers between −1 and 1.
fn random(seed: u64) -> impl FnMut() -> f64 {
    let mut seed = seed;
    move || {
        seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (seed >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

/// The last of several parameters is silent at first, the first one is silent now and then.
fn record<T: Kernels>(n: usize, samples: usize) -> (Vec<T>, Vec<T>) {
    let mut next = random(n as u64 + 3);
    let (mut phi, mut y) = (Vec::new(), Vec::new());
    for k in 0..samples {
        for i in 0..n {
            let silent = (i + 1 == n && k < 25 && n > 1) || (i == 0 && k % 13 == 4);
            phi.push(T::from_f64(if silent { 0.0 } else { 3.0 * next() }));
        }
        y.push(T::from_f64(next() * if k % 7 == 3 { 1e3 } else { 1.0 }));
    }
    (phi, y)
}

fn walks<T: Kernels>(n: usize, count: usize) -> Vec<AnyEstimator<T>> {
    let memory = Dynamic::new(n, 1, 1).unwrap();
    let member = |i: usize| {
        let noise = T::from_f64(10f64.powf(i as f64 % 12.0 - 8.0));
        let rule = RandomWalk::bounded(noise, T::from_f64(1e5), memory).unwrap();
        estimator(Rule::RandomWalk(rule), 1.0, memory)
    };
    (0..count).map(member).collect()
}

fn exponentials<T: Kernels>(n: usize, count: usize) -> Vec<AnyEstimator<T>> {
    let memory = Dynamic::new(n, 1, 1).unwrap();
    let rule = || Rule::named("exponential", &Defaults, memory).unwrap();
    (0..count).map(|i| estimator(rule(), 1.0 - 0.02 * (i % 11) as f64, memory)).collect()
}

fn estimator<T: Kernels>(
    rule: Rule<Dynamic<T>>,
    lambda: f64,
    memory: Dynamic<T>,
) -> AnyEstimator<T> {
    let rate = AnyRate::Constant(Constant::new(T::from_f64(lambda)).unwrap());
    let prior = Prior::scalar(memory, T::from_f64(1e4)).unwrap();
    Estimator::new(rule, rate, AnyWeighting::Equal(Equal::new()), prior)
}

fn mixer<T: Kernels>(name: &str, count: usize) -> AnyMixer<Dynamic<T>> {
    AnyMixer::named(name, &Defaults, Dynamic::new(count, 1, 1).unwrap()).unwrap()
}

/// Everything that a bank reports of a record.
#[derive(Debug, Default, PartialEq)]
struct Reported {
    errors: Vec<u64>,
    leverages: Vec<u64>,
    factors: Vec<u64>,
    windup: Vec<bool>,
    thetas: Vec<u64>,
    weights: Vec<u64>,
    memory: Vec<u64>,
}

fn bits<T: Kernels>(numbers: &[T]) -> impl Iterator<Item = u64> + '_ {
    numbers.iter().map(|x| x.to_f64().to_bits())
}

impl Reported {
    fn note<T: Kernels>(&mut self, outcome: &BankOutcome<T>) {
        self.errors.extend(bits(&[outcome.error]));
        self.leverages.extend(bits(&[outcome.leverage]));
        self.factors.extend(bits(&[outcome.forgetting_factor]));
        self.windup.push(outcome.windup);
    }
}

/// One update a sample; with this noise the members cannot run side by side.
fn one_by_one<T: Kernels>(bank: &mut Bank<T>, (phi, y): (&[T], &[T]), unit: bool) -> Reported {
    let (n, mut reported) = (phi.len() / y.len(), Reported::default());
    for (phi, &y) in phi.chunks_exact(n).zip(y) {
        reported.weights.extend(bits(bank.weights()));
        let noise = if unit { Noise::Unit } else { Noise::Scalar(T::ONE) };
        let update = bank.update(phi, &[y], noise).unwrap();
        assert_eq!((update.asleep, update.skipped), (0, None));
        reported.note(&BankOutcome {
            error: update.error[0],
            leverage: update.leverage,
            forgetting_factor: update.forgetting_factor,
            windup: update.windup,
        });
        reported.thetas.extend(bits(bank.theta()));
        reported.memory.extend(bits(&[bank.memory_in_samples()]));
    }
    reported
}

/// As many samples a call as it takes.
fn together<T: Kernels>(bank: &mut Bank<T>, (phi, y): (&[T], &[T])) -> (Reported, usize) {
    let (n, count, mut reported) = (phi.len() / y.len(), bank.weights().len(), Reported::default());
    let (mut k, mut calls) = (0, 0);
    while k < y.len() {
        let most = (y.len() - k).min(50);
        let zeros = |length: usize| vec![T::ZERO; length];
        let [mut theta, mut weights] = [zeros(n * most), zeros(count * most)];
        let mut memory = zeros(most);
        let mut outcomes = vec![BankOutcome::default(); most];
        let mut kept = Kept { theta: &mut theta, weights: &mut weights, memory: &mut memory };
        let taken = bank.update_many(&phi[k * n..], &y[k..], &mut outcomes, &mut kept);
        calls += 1;
        if taken == 0 {
            let rest = one_by_one(bank, (&phi[k * n..(k + 1) * n], &y[k..k + 1]), true);
            reported.extend(rest);
        }
        outcomes[..taken].iter().for_each(|outcome| reported.note(outcome));
        reported.thetas.extend(bits(&theta[..taken * n]));
        reported.weights.extend(bits(&weights[..taken * count]));
        reported.memory.extend(bits(&memory[..taken]));
        k += taken.max(1);
    }
    (reported, calls)
}

impl Reported {
    fn extend(&mut self, other: Self) {
        self.errors.extend(other.errors);
        self.leverages.extend(other.leverages);
        self.factors.extend(other.factors);
        self.windup.extend(other.windup);
        self.thetas.extend(other.thetas);
        self.weights.extend(other.weights);
        self.memory.extend(other.memory);
    }
}

/// A saved bank goes on as the bank does, and one that is reset is `fresh`.
fn goes_on<T: Kernels>(mut bank: Bank<T>, fresh: Bank<T>, record: (&[T], &[T])) {
    let mut again = Bank::from_bytes(&bank.to_bytes().unwrap()).unwrap();
    let (expected, _) = together(&mut bank, record);
    assert_eq!(together(&mut again, record).0, expected);
    bank.reset();
    assert_eq!(bank.to_bytes().unwrap(), fresh.to_bytes().unwrap());
}

fn same_by_all_ways<T: Kernels>(n: usize, members: &[AnyEstimator<T>], name: &str, data: bool) {
    let make = || {
        let mixer = mixer(name, members.len());
        if data {
            Bank::of_data(members.to_vec(), mixer).unwrap()
        } else {
            Bank::new(members.to_vec(), mixer).unwrap()
        }
    };
    let (phi, y) = record::<T>(n, 300);
    let [mut apart, mut single, mut many] = [make(), make(), make()];
    let expected = one_by_one(&mut apart, (&phi, &y), false);
    assert_eq!(one_by_one(&mut single, (&phi, &y), true), expected, "{n} {name}");
    let (reported, calls) = together(&mut many, (&phi, &y));
    assert_eq!(reported, expected, "{n} {name}");
    assert!(calls < 90, "{calls} calls: the members do not run side by side");
    let bytes = apart.to_bytes().unwrap();
    assert_eq!(single.to_bytes().unwrap(), bytes);
    assert_eq!(many.to_bytes().unwrap(), bytes);
    goes_on(many, make(), (&phi, &y));
}

#[test]
fn walks_are_the_same_side_by_side() {
    for n in 1..=10 {
        same_by_all_ways(n, &walks::<f64>(n, 8), "mlpol", n % 2 == 0);
        same_by_all_ways(n, &walks::<f32>(n, 8), "mlpol", n % 2 == 1);
    }
}

/// The largest difference of two lists of the bits of numbers, in units of the largest number.
fn difference(one: &[u64], other: &[u64]) -> f64 {
    let (one, other) = (one.iter(), other.iter());
    let pairs = one.zip(other).map(|(&a, &b)| (f64::from_bits(a), f64::from_bits(b)));
    let (most, size) = pairs.fold((0.0, 0.0), |(most, size): (f64, f64), (a, b)| {
        (most.max((a - b).abs()), size.max(a.abs()))
    });
    assert!(most.is_finite() && size > 0.0);
    most / size
}

/// Of more than ten parameters the members add up in another order side by side than one by one.
fn same_to_rounding<T: Kernels>(n: usize, count: usize, data: bool, tolerance: f64) {
    let members = walks::<T>(n, count);
    let make = || {
        let mixer = mixer("mlpol", count);
        if data { Bank::of_data(members.clone(), mixer) } else { Bank::new(members.clone(), mixer) }
            .unwrap()
    };
    let (phi, y) = record::<T>(n, 400);
    let [mut apart, mut single, mut many] = [make(), make(), make()];
    let expected = one_by_one(&mut apart, (&phi, &y), false);
    let of_single = one_by_one(&mut single, (&phi, &y), true);
    let (reported, calls) = together(&mut many, (&phi, &y));
    assert!(calls < 400, "{calls} calls: the members do not run side by side");
    assert_eq!(reported, of_single, "{n}");
    assert_eq!(reported.windup, expected.windup);
    for (what, own, expected) in [
        ("errors", &reported.errors, &expected.errors),
        ("leverages", &reported.leverages, &expected.leverages),
        ("theta", &reported.thetas, &expected.thetas),
    ] {
        let found = difference(expected, own);
        assert!(found < tolerance, "{what} of {n}: {found}");
    }
    let bytes = many.to_bytes().unwrap();
    assert_eq!(single.to_bytes().unwrap(), bytes);
    goes_on(many, make(), (&phi, &y));
}

#[test]
fn walks_of_many_parameters_are_the_same_side_by_side_to_rounding() {
    for (n, count) in [(11, 8), (12, 5), (13, 9), (16, 2), (27, 17), (40, 8)] {
        same_to_rounding::<f64>(n, count, n % 2 == 0, 1e-9);
        same_to_rounding::<f32>(n, count, n % 2 == 1, 2e-3);
    }
}

#[test]
fn any_number_of_members_is_the_same_side_by_side() {
    for count in [2, 3, 7, 9, 16, 17, 40] {
        same_by_all_ways(3, &walks::<f64>(3, count), "mlpol", true);
        same_by_all_ways(3, &exponentials::<f64>(3, count), "best", false);
        same_by_all_ways(2, &exponentials::<f32>(2, count), "dynamic_model_averaging", true);
    }
}

#[test]
fn members_in_lanes_are_estimators() {
    for n in 1..=10 {
        let members = walks::<f64>(n, 5);
        let mut bank = Bank::new(members.clone(), mixer("mlpol", 5)).unwrap();
        let (phi, y) = record::<f64>(n, 200);
        together(&mut bank, (&phi, &y));
        for (member, mut alone) in bank.members().iter().zip(members) {
            for (phi, y) in phi.chunks_exact(n).zip(&y) {
                alone.update(phi, &[*y]).unwrap();
            }
            assert_eq!(member.to_bytes().unwrap(), alone.to_bytes().unwrap(), "{n}");
        }
    }
}

#[test]
fn a_sample_that_is_refused_changes_nothing() {
    let mut bank = Bank::of_data(walks::<f64>(2, 8), mixer("mlpol", 8)).unwrap();
    let (phi, y) = record::<f64>(2, 100);
    together(&mut bank, (&phi, &y));
    let before = bank.to_bytes().unwrap();
    for (phi, y) in [([1.0, f64::NAN], 0.0), ([1.0, 1.0], f64::NAN), ([1.0, 1.0], 1e300)] {
        let mut outcomes = [BankOutcome::default()];
        assert_eq!(bank.update_many(&phi, &[y], &mut outcomes, &mut Kept::default()), 0);
        assert!(bank.update(&phi, &[y], Noise::Unit).is_err());
        assert_eq!(bank.to_bytes().unwrap(), before);
    }
}

#[test]
fn members_that_differ_in_kind_run_one_by_one() {
    let mut members = walks::<f64>(2, 3);
    members.extend(exponentials(2, 2));
    let mut bank = Bank::new(members, mixer("mlpol", 5)).unwrap();
    let (phi, y) = record::<f64>(2, 10);
    let mut outcomes = [BankOutcome::default(); 10];
    assert_eq!(bank.update_many(&phi, &y, &mut outcomes, &mut Kept::default()), 0);
    assert!(bank.update(&phi[..2], &y[..1], Noise::Unit).is_ok());
}
