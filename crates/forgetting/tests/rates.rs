//! Every rate and every weighting of the registries, whatever they are.

use forgetting::parameter::{Defaults, Kind, Parameter, Value, Values};
use forgetting::rates::{AnyRate, Evidence, Function, Rate, RATES};
use forgetting::rules::Rule;
use forgetting::saved::AnyEstimator;
use forgetting::weighting::{AnyWeighting, Weighting, WEIGHTINGS};
use forgetting::{
    Dynamic, Error, Estimator, Fixed, Forgetting, Memory, Noise, Prior, Real, Subspace,
};

const RULES: [&str; 4] = ["none", "exponential", "exponential_resetting", "subspace"];

/// Values by name; a function where one is wanted, defaults for the rest.
struct Given<'a, M: Memory> {
    values: Vec<(&'a str, Value<'a>)>,
    function: Function<M>,
}

impl<'a, M: Memory> Given<'a, M> {
    fn new(values: &[(&'a str, Value<'a>)]) -> Self {
        let function = Function::new(|evidence: &Evidence<'_, '_, M>| {
            let surprise = evidence.normalized_error / (M::Real::ONE + evidence.normalized_error);
            Ok(M::Real::ONE - M::Real::from_f64(0.1) * surprise)
        });
        Self { values: values.to_vec(), function }
    }
}

impl<M: Memory> Values for Given<'_, M> {
    fn get(&self, name: &str) -> Option<Value<'_>> {
        let given = self.values.iter().find(|(known, _)| *known == name);
        let function = (name == "function").then_some(Value::Function(&self.function));
        given.map(|(_, value)| *value).or(function)
    }
}

type With<F, M> = Estimator<F, AnyRate<M>, AnyWeighting<M>, M>;

/// An estimator with a rule, a rate and a weighting of these names.
fn make<T: Real>(memory: Dynamic<T>, [rule, rate, weighting]: [&str; 3]) -> AnyEstimator<T> {
    with(Rule::named(rule, &Defaults, memory).unwrap(), memory, [rate, weighting], &[])
}

/// An estimator with this rule, values for the rate and defaults elsewhere.
fn with<F: Forgetting<M>, M: Memory>(
    rule: F,
    memory: M,
    [rate, weighting]: [&str; 2],
    values: &[(&str, Value<'_>)],
) -> With<F, M> {
    Estimator::new(
        rule,
        AnyRate::named(rate, &Given::<M>::new(values), memory).unwrap(),
        AnyWeighting::named(weighting, &Defaults, memory).unwrap(),
        Prior::scalar(memory, M::Real::from_f64(100.0)).unwrap(),
    )
}

/// Deterministic noise, about normal with variance 1.
fn noise(seed: &mut u64) -> f64 {
    (0..12).fold(-6.0, |sum, _| {
        *seed =
            seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        sum + (*seed >> 11) as f64 / (1u64 << 53) as f64
    })
}

/// Sample `k` of a record: it excites, θ jumps at 150, it is silent from 250 on, then keeps to
/// one direction with noise.
fn sample<M: Memory>(memory: M, k: usize) -> (Vec<M::Real>, Vec<M::Real>) {
    let (n, p, m) = (memory.parameters(), memory.rows(), memory.targets());
    let mut seed = 1 + k as u64;
    let phi: Vec<f64> = (0..p * n)
        .map(|i| match k {
            250..300 => 0.0,
            300.. => 1.0 + (i % n) as f64,
            _ => 2.0 * noise(&mut seed),
        })
        .collect();
    let theta = |i: usize, target: usize| {
        let jump = if k < 150 { 1.0 } else { -4.0 };
        jump + (i + 2 * target) as f64
    };
    let y = (0..p * m).map(|j| {
        let (row, target) = (j / m, j % m);
        (0..n).fold(noise(&mut seed), |y, i| y + phi[row * n + i] * theta(i, target))
    });
    let y = y.map(M::Real::from_f64).collect();
    (phi.into_iter().map(M::Real::from_f64).collect(), y)
}

/// Takes a sample; returns its λ. Not to be inlined: an update is large.
#[inline(never)]
fn take<F: Forgetting<M>, M: Memory>(
    estimator: &mut With<F, M>,
    phi: &[M::Real],
    y: &[M::Real],
    noise: Noise<'_, M::Real>,
) -> Result<M::Real, Error> {
    estimator.update_weighted(phi, y, noise).map(|update| update.forgetting_factor)
}

/// λ of samples `from..to`, as bits.
fn factors<F, M>(estimator: &mut With<F, M>, from: usize, to: usize) -> Vec<u64>
where
    F: Forgetting<M>,
    M: Memory,
{
    let memory = estimator.prior().memory();
    let bits = |k| {
        let (phi, y) = sample(memory, k);
        let lambda = take(estimator, &phi, &y, Noise::Unit).unwrap();
        assert!(estimator.is_sound());
        lambda.to_f64().to_bits()
    };
    (from..to).map(bits).collect()
}

/// The number that the rate has for this parameter.
fn number<M: Memory>(rate: &AnyRate<M>, name: &str) -> Option<f64> {
    let mut found = None;
    rate.describe(&mut |known, value| {
        if let (true, Value::Real(x)) = (known == name, value) {
            found = Some(x);
        }
    });
    found
}

fn refused_values(parameter: &Parameter) -> Vec<f64> {
    let candidates = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -1.0, -0.5, 0.0, 1.0, 1.5, 2.0];
    let fits = |x: f64| {
        let whole = parameter.kind != Kind::Whole || x.trunc() == x;
        x.is_finite() && parameter.range.contains(x) && whole
    };
    candidates.into_iter().filter(|&x| !fits(x)).collect()
}

fn names(error: &Error, parameter: &str) -> bool {
    error.to_string().contains(parameter)
}

#[test]
fn every_parameter_is_checked() {
    let memory = Dynamic::<f64>::new(3, 1, 1).unwrap();
    let rates = RATES.iter().map(|about| (about.name, about.parameters, true));
    let weightings = WEIGHTINGS.iter().map(|about| (about.name, about.parameters, false));
    for (name, parameters, is_rate) in rates.chain(weightings) {
        for parameter in parameters {
            let word = matches!(parameter.kind, Kind::Word(_) | Kind::Function);
            let bad: Vec<Value<'_>> = if word {
                vec![Value::Real(0.5), Value::Word("no such word")]
            } else {
                refused_values(parameter).into_iter().map(Value::Real).collect()
            };
            assert!(bad.len() > 1, "{name}.{}", parameter.name);
            for value in bad {
                let given = Given::<Dynamic<f64>>::new(&[(parameter.name, value)]);
                let error = if is_rate {
                    AnyRate::named(name, &given, memory).err()
                } else {
                    AnyWeighting::named(name, &given, memory).err()
                };
                let error =
                    error.unwrap_or_else(|| panic!("{name}.{} = {value:?}", parameter.name));
                assert!(names(&error, parameter.name), "{name}: {error}");
            }
        }
    }
}

#[test]
fn every_name_and_parameter_is_documented() {
    let rates = RATES.iter().map(|about| (about.name, about.source, about.parameters));
    let weightings = WEIGHTINGS.iter().map(|about| (about.name, about.source, about.parameters));
    for (name, source, parameters) in rates.chain(weightings) {
        let header: Vec<_> = source.lines().take_while(|line| line.starts_with("//!")).collect();
        assert!(header[0].ends_with('.'), "{name}: one sentence first");
        assert!(header.iter().any(|line| line.contains("- Use it")), "{name}: when to use it");
        assert!(header.iter().any(|line| line.contains("Cost:")), "{name}: what it costs");
        for parameter in parameters {
            let row = format!("| {} |", parameter.name);
            assert!(header.iter().any(|line| line.contains(&row)), "{name}: {row}");
            assert!(!parameter.about.is_empty());
        }
    }
}

fn stays_within_its_limits<T: Real>(rate: &str, sizes: (usize, usize, usize)) {
    let memory = Dynamic::<T>::new(sizes.0, sizes.1, sizes.2).unwrap();
    let narrow = [("smallest", Value::Real(0.95)), ("largest", Value::Real(0.98))];
    for values in [&[][..], &narrow] {
        for rule in RULES {
            let rule_of_name = Rule::named(rule, &Defaults, memory).unwrap();
            let mut estimator = with(rule_of_name, memory, [rate, "equal"], values);
            let limit = |name, default| number(estimator.rate(), name).unwrap_or(default);
            let (smallest, largest) = (limit("smallest", f64::MIN_POSITIVE), limit("largest", 1.0));
            let found = factors(&mut estimator, 0, 400);
            for lambda in found.iter().map(|&bits| f64::from_bits(bits)) {
                assert!(smallest <= lambda && lambda <= largest, "{rate}, {rule}: {lambda}");
            }
            let adapts = number(estimator.rate(), "smallest").is_some();
            assert!(!adapts || found.iter().any(|bits| *bits != found[0]), "{rate} does not move");
        }
    }
}

#[test]
fn every_factor_is_within_its_limits() {
    for about in RATES {
        for sizes in [(1, 1, 1), (3, 1, 1), (3, 2, 1), (2, 1, 3), (3, 3, 2)] {
            stays_within_its_limits::<f64>(about.name, sizes);
            stays_within_its_limits::<f32>(about.name, sizes);
        }
    }
}

/// y and √Γ in units 2⁸ times as small: the same whitened errors, bit for bit, the same λ.
#[test]
fn no_factor_depends_on_the_units_of_the_output() {
    let unit = 256.0;
    for about in RATES {
        for (n, p, m) in [(3, 1, 1), (2, 2, 2)] {
            let memory = Dynamic::<f64>::new(n, p, m).unwrap();
            let names = ["exponential", about.name, "huber"];
            let mut plain = make(memory, names);
            let mut scaled = Estimator::new(
                plain.rule().clone(),
                plain.rate().clone(),
                plain.weighting().clone(),
                Prior::scalar(memory, 100.0 * unit * unit).unwrap(),
            );
            for k in 0..250 {
                let (phi, mut y) = sample(memory, k);
                let expected = take(&mut plain, &phi, &y, Noise::Unit).unwrap();
                y.iter_mut().for_each(|y| *y *= unit);
                let gamma = Noise::Scalar(unit * unit);
                let found = take(&mut scaled, &phi, &y, gamma).unwrap();
                assert_eq!(found.to_bits(), expected.to_bits(), "{}, sample {k}", about.name);
            }
        }
    }
}

/// Rates whose parameters are data, which can be saved.
fn saved_rates() -> impl Iterator<Item = &'static str> {
    let data = |about: &&forgetting::rates::AboutRate| {
        about.parameters.iter().all(|parameter| parameter.kind != Kind::Function)
    };
    RATES.iter().filter(data).map(|about| about.name)
}

fn saves_in_the_middle<T: Real>(rate: &str, weighting: &str) {
    let memory = Dynamic::<T>::new(3, 2, 2).unwrap();
    let mut whole = make(memory, ["subspace", rate, weighting]);
    for stop in [0, 1, 137] {
        let mut restored = AnyEstimator::<T>::from_bytes(&whole.to_bytes().unwrap()).unwrap();
        let next = stop.max(1) * 2;
        let expected = factors(&mut whole.clone(), stop, next);
        assert_eq!(factors(&mut restored, stop, next), expected, "{rate}, {weighting}");
        factors(&mut whole, stop, next);
        assert_eq!(restored.to_bytes().unwrap(), whole.to_bytes().unwrap());
        if stop == 1 {
            factors(&mut whole, next, 137);
        }
    }
}

#[test]
fn saving_in_the_middle_changes_no_bit() {
    for rate in saved_rates() {
        for weighting in WEIGHTINGS {
            saves_in_the_middle::<f64>(rate, weighting.name);
            saves_in_the_middle::<f32>(rate, weighting.name);
        }
    }
}

#[test]
fn a_refused_sample_changes_no_bit() {
    for rate in saved_rates() {
        for weighting in WEIGHTINGS {
            let memory = Dynamic::<f64>::new(3, 2, 1).unwrap();
            let mut estimator = make(memory, ["exponential", rate, weighting.name]);
            factors(&mut estimator, 0, 120);
            let before = estimator.to_bytes().unwrap();
            let (phi, y) = sample(memory, 120);
            let mut bad_phi = phi.clone();
            bad_phi[4] = f64::INFINITY;
            let indefinite = [1.0, 2.0, 2.0, 1.0];
            let mut refuses =
                |phi: &[f64], y: &[f64], noise| take(&mut estimator, phi, y, noise).is_err();
            let refused = [
                refuses(&phi, &[1.0, f64::NAN], Noise::Unit),
                refuses(&bad_phi, &y, Noise::Unit),
                refuses(&phi[1..], &y, Noise::Unit),
                refuses(&phi, &[1e300, 1.0], Noise::Unit),
                refuses(&phi, &y, Noise::Full(&indefinite)),
            ];
            assert_eq!(refused, [true; 5]);
            assert_eq!(estimator.to_bytes().unwrap(), before, "{rate}, {}", weighting.name);
        }
    }
}

/// A rule that must refuse a sample, because P would overflow, does so after the rate has been
/// asked; the rate has not learned from the sample.
#[test]
fn a_sample_that_the_rule_refuses_changes_no_bit() {
    let memory = Dynamic::<f64>::new(2, 1, 1).unwrap();
    for rate in saved_rates() {
        let mut estimator = Estimator::new(
            Rule::named("exponential", &Defaults, memory).unwrap(),
            AnyRate::named(rate, &Defaults, memory).unwrap(),
            AnyWeighting::named("equal", &Defaults, memory).unwrap(),
            Prior::scalar(memory, 1e150).unwrap(),
        );
        for k in 0..100_000 {
            let before = estimator.to_bytes().unwrap();
            match take(&mut estimator, &[0.0, 0.0], &[(k % 50) as f64], Noise::Unit) {
                Ok(_) => {}
                Err(error) => {
                    assert!(matches!(error, Error::Range { .. }), "{error}");
                    assert_eq!(estimator.to_bytes().unwrap(), before, "{rate}");
                    break;
                }
            }
        }
    }
}

/// λ of a record with the rule `subspace`.
fn with_subspace<M: Memory>(memory: M, names: [&str; 2]) -> Vec<u64> {
    let rule = Subspace::new(M::Real::from_f64(1e-3)).unwrap();
    factors(&mut with(rule, memory, names, &[]), 0, 400)
}

#[test]
fn fixed_and_dynamic_sizes_give_the_same_bits() {
    for rate in RATES {
        for weighting in WEIGHTINGS {
            let names = [rate.name, weighting.name];
            let fixed = with_subspace(Fixed::<f64, 3, 2, 2, 512>::new(), names);
            let dynamic = with_subspace(Dynamic::<f64>::new(3, 2, 2).unwrap(), names);
            assert_eq!(fixed, dynamic, "{names:?}");
            let fixed = with_subspace(Fixed::<f32, 2, 1, 1, 101>::new(), names);
            let dynamic = with_subspace(Dynamic::<f32>::new(2, 1, 1).unwrap(), names);
            assert_eq!(fixed, dynamic, "{names:?}");
        }
    }
}

/// 10⁵ samples with nothing in them, then noise without a regressor, then one direction.
fn survives_silence<T: Real>(rate: &str, rule: &str) {
    let memory = Dynamic::<T>::new(3, 1, 1).unwrap();
    let mut estimator = make(memory, [rule, rate, "student_t"]);
    factors(&mut estimator, 0, 120);
    let (zero, one) = (T::ZERO, T::ONE);
    for k in 0..100_000 {
        let phi = if k < 66_000 { [zero; 3] } else { [one, -one, one + one] };
        let y = if k < 33_000 { zero } else { T::from_f64((k % 7) as f64 - 3.0) };
        match take(&mut estimator, &phi, &[y], Noise::Unit) {
            Ok(lambda) => assert!(lambda > T::ZERO),
            Err(error) => {
                // windup is refused before it overflows
                assert!(matches!(error, Error::Range { .. }), "{rate}, {rule}: {error}");
                break;
            }
        }
    }
    assert!(estimator.is_sound(), "{rate}, {rule}");
}

#[test]
fn every_rate_survives_silence() {
    for (k, about) in RATES.iter().enumerate() {
        // a rule that winds up, and another one
        for rule in ["exponential", ["none", "exponential_resetting", "subspace"][k % 3]] {
            survives_silence::<f64>(about.name, rule);
            survives_silence::<f32>(about.name, rule);
        }
    }
}

/// ‖(Pφ̄ᵀ)_i‖ for each i, with P before the sample and φ̄ whitened by Γ = diag(gamma).
fn reach(estimator: &AnyEstimator<f64>, phi: &[f64], gamma: &[f64]) -> Vec<f64> {
    let n = estimator.factor().parameters();
    let mut squares = vec![0.0; n];
    for (row, gamma) in phi.chunks_exact(n).zip(gamma) {
        let mut x: Vec<f64> = row.iter().map(|x| x / gamma.sqrt()).collect();
        estimator.factor().multiply(&mut x);
        squares.iter_mut().zip(x).for_each(|(sum, x)| *sum += x * x);
    }
    squares.into_iter().map(f64::sqrt).collect()
}

/// One outlier moves no parameter of any target by more than c ‖(P̄φ̄ᵀ)_i‖.
#[test]
fn an_outlier_has_bounded_influence() {
    let memory = Dynamic::<f64>::new(3, 2, 2).unwrap();
    let gamma = [4.0, 0.25];
    let full = [gamma[0], 0.0, 0.0, gamma[1]];
    let mut bounded = 0;
    for weighting in WEIGHTINGS {
        let mut estimator = make(memory, ["none", "constant", weighting.name]);
        let Some(c) = estimator.weighting().influence(2) else { continue };
        bounded += 1;
        for k in 0..100 {
            let (phi, y) = sample(memory, k);
            // with `none` P̄ is P
            let limits = reach(&estimator, &phi, &gamma);
            for size in [1.0, 2.0, 1e6, -1e9, 1e60] {
                let mut shot = estimator.clone();
                let y = [y[0] + size, y[1], y[2] - size, y[3] + 2.0 * size];
                take(&mut shot, &phi, &y, Noise::Full(&full)).unwrap();
                for (target, before) in estimator.theta().chunks_exact(3).enumerate() {
                    for i in 0..3 {
                        let moved = (shot.theta()[target * 3 + i] - before[i]).abs();
                        let rounding = 1e-12 * before[i].abs();
                        assert!(moved <= c * limits[i] * (1.0 + 1e-9) + rounding, "{size:e}");
                    }
                }
            }
            take(&mut estimator, &phi, &y, Noise::Full(&full)).unwrap();
        }
        // the bound is reached, or nearly
        let (phi, y) = sample(memory, 100);
        let limits = reach(&estimator, &phi, &gamma);
        let most = (0..60).map(|k| {
            let mut shot = estimator.clone();
            let y = [y[0] + f64::from(k - 10).exp(), y[1], y[2], y[3]];
            take(&mut shot, &phi, &y, Noise::Full(&full)).unwrap();
            (shot.theta()[0] - estimator.theta()[0]).abs() / (c * limits[0])
        });
        assert!(most.fold(0.0, f64::max) > 0.05, "{}", weighting.name);
    }
    assert_eq!(bounded, WEIGHTINGS.len() - 1, "only equal weights are not bounded");
}

/// However large the outlier, a rate sees no more than the clipped error.
#[test]
fn no_rate_forgets_more_for_a_larger_outlier() {
    let memory = Dynamic::<f64>::new(2, 1, 1).unwrap();
    for about in RATES {
        let mut estimator = make(memory, ["exponential", about.name, "huber"]);
        factors(&mut estimator, 0, 149);
        let (phi, y) = sample(memory, 149);
        let after = |size: f64| {
            let mut shot = estimator.clone();
            let mut next = |y: &[f64]| take(&mut shot, &phi, y, Noise::Unit).unwrap();
            [next(&[y[0] + size]), next(&y)]
        };
        for (large, larger) in after(1e6).into_iter().zip(after(1e60)) {
            assert!((large - larger).abs() < 1e-4, "{}: {large}, {larger}", about.name);
        }
    }
}
