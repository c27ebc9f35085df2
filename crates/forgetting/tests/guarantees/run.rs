//! A rule over a record of regressors, step by step, with the matrices of Theorem 1.

use crate::dense::Dense;
use crate::inputs::Input;
use crate::record::Noise;
use crate::subjects::{Given, Subject};
use forgetting::rules::{Forgetting, Step, RULES};
use forgetting::{Dynamic, Factor, Sample, Work};

/// Parameters of every problem here.
pub const N: usize = 3;

/// What is run.
#[derive(Clone, Debug)]
pub struct Setting {
    /// parameters of the rule, the defaults for the rest
    pub given: Given,
    /// λ
    pub factor: f64,
    /// P₀ = variance·I
    pub variance: f64,
    /// the regressors
    pub input: Input,
    /// the size of the errors, for rules that look at them
    pub error: f64,
}

/// One step: R, what forgetting leaves of it, and P with the data.
pub struct Passed {
    pub k: usize,
    /// P_k, before anything
    pub before: Dense,
    /// P̄_k
    pub forgotten: Dense,
    /// P_{k+1}
    pub after: Dense,
}

impl Setting {
    pub fn subject(&self, name: &str) -> Subject {
        let about = RULES.iter().find(|about| about.name == name).unwrap();
        Subject { about, given: self.given.clone() }
    }

    /// Shows each step to `look` until it says that it has seen enough.
    pub fn run(&self, name: &str, samples: usize, mut look: impl FnMut(Passed) -> bool) {
        let memory = Dynamic::<f64>::new(N, self.input.rows(), 1).unwrap();
        let rule = self.subject(name).rule(memory).unwrap();
        let mut state = rule.start(memory);
        let mut factor = Factor::scalar(memory, self.variance).unwrap();
        let (mut work, mut noise) = (Work::new(memory), Noise::new(7));
        let mut gain = [0.0; N];
        for k in 0..samples {
            let mut phi = self.input.regressors(k, &mut noise);
            let mut errors: Vec<f64> =
                (0..self.input.rows()).map(|_| self.error * noise.next()).collect();
            let mut sample = Sample::new(memory, &mut phi, &mut errors);
            let before = dense(&factor);
            let step = Step {
                factor: &mut factor,
                sample: &mut sample,
                forgetting_factor: self.factor,
                work: &mut work,
            };
            let outcome = rule.forget(&mut state, step);
            let outcome = outcome.unwrap_or_else(|error| panic!("{name} {self:?}: {error}"));
            let forgotten = dense(&factor);
            if outcome.skipped.is_none() {
                for i in 0..sample.rows() {
                    factor.add_information(sample.row(i), &mut gain);
                }
            }
            if look(Passed { k, before, forgotten, after: dense(&factor) }) {
                break;
            }
        }
    }
}

fn dense(factor: &Factor<Dynamic<f64>>) -> Dense {
    let mut p = [0.0; N * N];
    factor.reconstruct(&mut p);
    Dense::new(N, &p)
}
