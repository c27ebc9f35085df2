//! Bounds of P by a formula, attacked: a search for rules, starts, factors and regressors that
//! break them.

use crate::dense::Dense;
use crate::record::Noise;
use crate::subjects::{rules, Given, Item, Subject};
use forgetting::choice::{Bounds, Constants, Kind, Parameter, Value};
use forgetting::rules::{Forgetting, Rule, Step};
use forgetting::{Dynamic, Factor, Sample, Work};

/// Relative rounding of P and the bounds.
const ROUNDING: f64 = 1e-7;
/// Above that condition, P is not known well enough to be compared.
const WELL: f64 = 1e8;
const TRIALS: usize = 600;
const SAMPLES: usize = 60;

/// 10^x for a random x within ± `decades`.
fn scale(noise: &mut Noise, decades: f64) -> f64 {
    10f64.powf(decades * noise.next())
}

/// One of so many.
fn pick(noise: &mut Noise, count: usize) -> usize {
    ((noise.next() + 1.0) / 2.0 * count as f64) as usize % count
}

/// A forgetting factor, of any size but mostly near 1; now and then 1.
fn factor(noise: &mut Noise) -> f64 {
    match pick(noise, 4) {
        0 => 1.0,
        1 => (noise.next() + 1.0) / 2.0 * 0.98 + 0.01,
        _ => 1.0 - 0.1 * scale(noise, 1.0).min(5.0),
    }
}

/// A value for a parameter, the default for some.
fn value(parameter: &Parameter, noise: &mut Noise) -> Option<Item> {
    let near = |default, noise: &mut Noise| match parameter.kind {
        Kind::Whole => default + pick(noise, 4) as f64,
        _ if parameter.check(2.0).is_err() => factor(noise),
        _ => default * scale(noise, 2.0),
    };
    Some(match (parameter.kind, parameter.default) {
        (Kind::Word(words), _) => Item::Word(words[pick(noise, words.len())]),
        (Kind::Rule, _) => {
            let all: Vec<_> =
                rules().filter(|rule| rule.about.name != "covariance_resetting").collect();
            let inner = any(&all[pick(noise, all.len())], noise);
            Item::Rule(inner.about.name, inner.given)
        }
        (_, Some(Value::Real(default))) if pick(noise, 3) > 0 => Item::Real(match parameter.name {
            "blocks" => default,
            "period" => 1.0 + pick(noise, 9) as f64,
            _ => near(default, noise),
        }),
        _ => return None,
    })
}

/// The rule with parameters of any size.
fn any(plain: &Subject, noise: &mut Noise) -> Subject {
    let mut subject = plain.clone();
    let own = plain.about.parameters.iter();
    let values = own.filter_map(|p| Some((p.name, value(p, noise)?)));
    subject.given = Given(values.collect());
    subject
}

/// A regressor of length 1 or less, chosen to hurt: along one direction, along axes, any, silent.
fn regressor(kind: usize, k: usize, n: usize, noise: &mut Noise) -> Vec<f64> {
    let mut phi: Vec<f64> = (0..n).map(|_| noise.next()).collect();
    match kind {
        0 => phi = (0..n).map(|i| 1.0 + i as f64).collect(),
        1 => phi = (0..n).map(|i| f64::from(u8::from(i == k % n))).collect(),
        2 if k > SAMPLES / 3 => phi.fill(0.0),
        3 if !k.is_multiple_of(7) => phi.fill(0.0),
        4 if k > 5 => phi = (0..n).map(|i| f64::from(u8::from(i == 0))).collect(),
        5 => phi.iter_mut().skip(1).for_each(|x| *x *= 1e-3),
        _ => {}
    }
    let length = phi.iter().map(|x| x * x).sum::<f64>().sqrt();
    phi.iter_mut().for_each(|x| *x /= length.max(1e-300));
    phi
}

struct Attack {
    rule: Rule<Dynamic<f64>>,
    memory: Dynamic<f64>,
    variance: f64,
    /// the smallest and the largest λ
    factors: (f64, f64),
    /// the length of the longest regressor
    length: f64,
    /// which regressors
    kind: usize,
}

impl Attack {
    fn new(subject: &Subject, noise: &mut Noise) -> Option<Self> {
        let n = 1 + pick(noise, 3);
        let memory = Dynamic::<f64>::new(n, 1, 1).unwrap();
        let (one, other) = (factor(noise).clamp(1e-3, 1.0), factor(noise).clamp(1e-3, 1.0));
        let other = if pick(noise, 2) == 0 { one } else { other };
        Some(Self {
            rule: subject.rule(memory).ok()?,
            memory,
            variance: scale(noise, 3.0),
            factors: (one.min(other), one.max(other)),
            length: scale(noise, 1.5),
            kind: pick(noise, 7),
        })
    }

    /// The bounds that the rule states.
    fn stated(&self) -> Bounds {
        let initial = (self.variance, self.variance);
        let constants = Constants {
            parameters: self.memory_parameters(),
            initial,
            forgetting_factors: self.factors,
            regressor_bound: self.length * self.length,
        };
        self.rule.bounds(&constants).with_initial(initial)
    }

    fn memory_parameters(&self) -> usize {
        forgetting::Memory::parameters(&self.memory)
    }

    /// Shows the extreme eigenvalues of P after each sample, as far as they are known.
    fn run(&self, noise: &mut Noise, mut look: impl FnMut(f64, f64)) {
        let n = self.memory_parameters();
        let mut state = self.rule.start(self.memory);
        let mut factor = Factor::scalar(self.memory, self.variance).unwrap();
        let (mut work, mut gain) = (Work::new(self.memory), vec![0.0; n]);
        for k in 0..SAMPLES {
            let shorter = if pick(noise, 3) == 0 { (noise.next() + 1.0) / 2.0 } else { 1.0 };
            let mut phi = regressor(self.kind, k, n, noise);
            phi.iter_mut().for_each(|x| *x *= self.length * shorter);
            let mut errors = [10.0 * noise.next()];
            let mut sample = Sample::new(self.memory, &mut phi, &mut errors);
            let share = if pick(noise, 2) == 0 { 0.0 } else { 1.0 };
            let forgetting_factor = self.factors.0 + share * (self.factors.1 - self.factors.0);
            let (factor_, sample_) = (&mut factor, &mut sample);
            let step = Step {
                factor: factor_,
                sample: sample_,
                forgetting_factor,
                elapsed: 1.0,
                work: &mut work,
            };
            let Ok(outcome) = self.rule.forget(&mut state, step) else { return };
            if outcome.skipped.is_none() {
                (0..sample.rows()).for_each(|i| {
                    factor.add_information(sample.row(i), &mut gain);
                });
            }
            let mut p = vec![0.0; n * n];
            factor.reconstruct(&mut p);
            let spread = Dense::new(n, &p).eigenvalues();
            if spread[n - 1] > WELL * spread[0] {
                return;
            }
            look(spread[0], spread[n - 1]);
        }
    }
}

#[test]
fn no_rule_start_factor_or_regressor_breaks_a_bound() {
    let (mut noise, mut below, mut above) = (Noise::new(3), 0, 0);
    for plain in rules() {
        for trial in 0..TRIALS {
            let subject = any(&plain, &mut noise);
            let Some(attack) = Attack::new(&subject, &mut noise) else { continue };
            let bounds = attack.stated();
            below += usize::from(bounds.below.is_some());
            above += usize::from(bounds.above.is_some());
            let about = || {
                let Attack { variance, factors, length, kind, .. } = attack;
                format!("{subject:?}, trial {trial}: P₀ = {variance}, λ {factors:?}, |φ| {length}, {kind}")
            };
            attack.run(&mut noise, |least, most| {
                if let Some(bound) = bounds.below {
                    assert!(least > bound * (1.0 - ROUNDING), "{}: {least} < {bound}", about());
                }
                if let Some(bound) = bounds.above {
                    assert!(most < bound * (1.0 + ROUNDING), "{}: {most} > {bound}", about());
                }
            });
        }
    }
    assert!(below > 2000 && above > 2000, "{below} and {above} trials had bounds");
}
