//! Estimators with a rate and a weighting of a registry, and a record for them.

use forgetting::choice::{About, Defaults, Kind, Value, Values};
use forgetting::rates::{AnyRate, Evidence, Function, RATES};
use forgetting::rules::Rule;
use forgetting::saved::AnyEstimator;
use forgetting::weightings::AnyWeighting;
use forgetting::{Dynamic, Error, Estimator, Forgetting, Kernels, Memory, Noise, Prior, Real};

/// Rules that use the factor of the rate, whatever it is.
pub const RULES: [&str; 3] = ["exponential", "exponential_resetting", "subspace"];

/// Values by name; a function where one is wanted, defaults for the rest.
pub struct Given<'a, M: Memory> {
    values: Vec<(&'a str, Value<'a>)>,
    function: Function<M>,
}

impl<'a, M: Memory> Given<'a, M> {
    pub fn new(values: &[(&'a str, Value<'a>)]) -> Self {
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

pub type With<F, M> = Estimator<F, AnyRate<M>, AnyWeighting<M>, M>;

/// An estimator with a rule, a rate and a weighting of these names.
pub fn make<T: Kernels>(memory: Dynamic<T>, [rule, rate, weighting]: [&str; 3]) -> AnyEstimator<T> {
    with(Rule::named(rule, &Defaults, memory).unwrap(), memory, [rate, weighting], &[])
}

/// An estimator with this rule, values for the rate and defaults elsewhere.
pub fn with<F: Forgetting<M>, M: Memory>(
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
pub fn noise(seed: &mut u64) -> f64 {
    (0..12).fold(-6.0, |sum, _| {
        *seed =
            seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        sum + (*seed >> 11) as f64 / (1u64 << 53) as f64
    })
}

/// Sample `k` of a record: it excites, θ jumps at 150, it is silent from 250 on, then keeps to
/// one direction with noise.
pub fn sample<M: Memory>(memory: M, k: usize) -> (Vec<M::Real>, Vec<M::Real>) {
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
pub fn take<F: Forgetting<M>, M: Memory>(
    estimator: &mut With<F, M>,
    phi: &[M::Real],
    y: &[M::Real],
    noise: Noise<'_, M::Real>,
) -> Result<M::Real, Error> {
    estimator.update_with_noise(phi, y, noise).map(|update| update.forgetting_factor)
}

/// λ of samples `from..to`, as bits.
pub fn factors<F, M>(estimator: &mut With<F, M>, from: usize, to: usize) -> Vec<u64>
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

/// Rates whose parameters are data, which can be saved.
pub fn saved_rates() -> impl Iterator<Item = &'static str> {
    let data =
        |about: &&About| about.parameters.iter().all(|parameter| parameter.kind != Kind::Function);
    RATES.iter().filter(data).map(|about| about.name)
}
