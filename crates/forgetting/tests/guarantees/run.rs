//! A rule over a record of regressors, step by step, with the matrices of Theorem 1.

use crate::dense::Dense;
use crate::inputs::{regressors, rows};
use crate::record::Noise;
use crate::subjects::{Given, Item, Subject};
use forgetting::choice::{Setting, Value};
use forgetting::rules::{Forgetting, Step, AXIS};
use forgetting::{Dynamic, Factor, Sample, Work};

/// Parameters of every problem here.
pub const N: usize = 3;

/// One step: R, what forgetting leaves of it, and P with the data.
pub struct Passed {
    pub k: usize,
    /// the sum of the squares of φ_k
    pub phi_squared: f64,
    /// P_k, before anything
    pub before: Dense,
    /// P̄_k
    pub forgotten: Dense,
    /// P_{k+1}
    pub after: Dense,
    /// R_{k+1}, which is exact where P is too ill-conditioned to be inverted
    pub information: Dense,
}

/// The rule called `name` with the parameters of this setting.
pub fn subject(name: &str, setting: &Setting) -> Subject {
    let about = AXIS.find(name).unwrap();
    let given = setting.parameters.iter().map(|&(name, value)| match value {
        Value::Real(x) => (name, Item::Real(x)),
        Value::Word(word) => (name, Item::Word(word)),
        other => panic!("{name} = {other:?}: a setting has numbers and words"),
    });
    Subject { about, given: Given(given.collect()) }
}

/// Shows each step to `look` until it says that it has seen enough.
pub fn run(name: &str, setting: &Setting, samples: usize, mut look: impl FnMut(Passed) -> bool) {
    run_all(name, setting, samples, &mut look);
}

/// One copy of all rules, whatever looks at them.
fn run_all(name: &str, setting: &Setting, samples: usize, look: &mut dyn FnMut(Passed) -> bool) {
    let rows = rows(setting.input);
    let memory = Dynamic::<f64>::new(N, rows, 1).unwrap();
    let rule = subject(name, setting).rule(memory).unwrap();
    let mut state = rule.start(memory);
    let mut factor = Factor::scalar(memory, setting.variance).unwrap();
    let (mut work, mut noise) = (Work::new(memory), Noise::new(7));
    let mut gain = [0.0; N];
    for k in 0..samples {
        let mut phi = regressors(setting.input, k, &mut noise);
        let phi_squared = phi.iter().map(|x| x * x).sum();
        let mut errors: Vec<f64> = (0..rows).map(|_| setting.error * noise.next()).collect();
        let mut sample = Sample::new(memory, &mut phi, &mut errors);
        let before = dense(&factor);
        let step = Step {
            factor: &mut factor,
            sample: &mut sample,
            forgetting_factor: setting.forgetting_factor,
            elapsed: 1.0,
            work: &mut work,
        };
        let outcome = rule.forget(&mut state, step);
        let outcome = outcome.unwrap_or_else(|error| panic!("{name} {setting:?}: {error}"));
        let forgotten = dense(&factor);
        if outcome.skipped.is_none() {
            for i in 0..sample.rows() {
                factor.add_information(sample.row(i), &mut gain);
            }
        }
        let (after, information) = (dense(&factor), information(&factor));
        if look(Passed { k, phi_squared, before, forgotten, after, information }) {
            break;
        }
    }
}

fn dense(factor: &Factor<Dynamic<f64>>) -> Dense {
    let mut p = [0.0; N * N];
    factor.reconstruct(&mut p);
    Dense::new(N, &p)
}

fn information(factor: &Factor<Dynamic<f64>>) -> Dense {
    let (mut r, mut work) = ([0.0; N * N], [0.0; N * N]);
    factor.reconstruct_information(&mut r, &mut work);
    Dense::new(N, &r)
}
