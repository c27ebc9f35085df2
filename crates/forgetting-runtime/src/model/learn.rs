//! A whole record through a model and the estimator behind it.

use crate::bank::Bank;
use crate::error::Error;
use crate::estimator::record::Pause;
use crate::estimator::{Estimator, GoOn, Run};
use crate::number::{each, Array, Elements, Number, View};
use crate::shape;
use forgetting::models::Polynomial;
use forgetting::{bank, AnyEstimator, Noise, Skip};

/// Names of what a model can tell of each sample.
///
/// | output | shape | |
/// |---|---|---|
/// | `phi`, `y` | (T, n), (T,) | what the estimator was given: ψ and y − φθ + ψθ, both times a scale; NaN where it was not |
/// | `error` | (T,) | y − φθ with the θ of before; NaN where a value is missing |
/// | `theta` | (T, n) | the estimate after each sample |
/// | `scale` | (T,) | the root of how far the sample was trusted, below 1 at the start |
/// | `skipped` | (T,) | why the estimator did not use the sample, 0 if it did |
pub const MODEL_OUTPUTS: [&str; 6] = ["phi", "y", "error", "theta", "scale", "skipped"];

/// Whatever learns from regressors.
pub enum Learner<'a> {
    /// one estimator
    Estimator(&'a mut Estimator),
    /// several, mixed
    Bank(&'a mut Bank),
}

impl Learner<'_> {
    fn sizes(&self) -> (usize, usize, usize) {
        match self {
            Self::Estimator(own) => (own.parameters(), own.rows(), own.targets()),
            Self::Bank(own) => (own.parameters(), own.rows(), own.targets()),
        }
    }
}

/// One sample at a time, whatever takes it.
trait Recursion<T> {
    /// Takes a sample; why it was not used, if it was not.
    fn take(&mut self, phi: &[T], y: T) -> Result<Option<Skip>, forgetting::Error>;
    /// The estimate.
    fn theta(&self) -> &[T];
}

impl<T: Number> Recursion<T> for AnyEstimator<T> {
    fn take(&mut self, phi: &[T], y: T) -> Result<Option<Skip>, forgetting::Error> {
        self.update(phi, &[y]).map(|update| update.skipped)
    }

    fn theta(&self) -> &[T] {
        AnyEstimator::theta(self)
    }
}

impl<T: Number> Recursion<T> for bank::Bank<T> {
    fn take(&mut self, phi: &[T], y: T) -> Result<Option<Skip>, forgetting::Error> {
        self.update(phi, &[y], Noise::Unit).map(|update| update.skipped)
    }

    fn theta(&self) -> &[T] {
        bank::Bank::theta(self)
    }
}

/// What is kept of each sample.
#[derive(Default)]
struct Outputs {
    phi: Option<Vec<f64>>,
    y: Option<Vec<f64>>,
    error: Option<Vec<f64>>,
    theta: Option<Vec<f64>>,
    scale: Option<Vec<f64>>,
    skipped: Option<Vec<u8>>,
    used: usize,
}

/// Takes the record; `model` is left as it is when the error is told.
pub(super) fn learn(
    model: &mut Polynomial,
    learner: Learner<'_>,
    (inputs, y): (View<'_>, View<'_>),
    names: &[&str],
    go_on: GoOn<'_>,
) -> Result<Run, Error> {
    let (n, rows, targets) = learner.sizes();
    let own = model.orders().parameters();
    if (n, rows, targets) != (own, 1, 1) {
        let reason = format!("the estimator must have {own} parameters, one row and one target");
        return Err(Error::unsupported(reason));
    }
    let samples = check_shapes(model, &inputs, &y)?;
    let mut outputs = Outputs::named(names)?;
    let (inputs, y) = (inputs.numbers().to_f64(), y.numbers().to_f64());
    let record = Signals { inputs: &inputs, count: model.orders().inputs.len(), y: &y };
    let taken = match learner {
        Learner::Estimator(own) => each!(&mut own.typed, estimator => {
            estimator.all_or_nothing(|own| run(model, own, record, &mut outputs, go_on))
        }),
        Learner::Bank(own) => each!(&mut own.typed, bank => {
            bank.all_or_nothing(|own| run(model, own, record, &mut outputs, go_on))
        }),
    };
    taken.map_err(|(sample, error)| Error::Sample { sample, error })?;
    Ok(outputs.finish(samples, n))
}

/// Predicts each y one sample ahead, with θ as it is.
pub(super) fn predict(
    model: &mut Polynomial,
    (inputs, y): (View<'_>, View<'_>),
) -> Result<Vec<f64>, Error> {
    let samples = check_shapes(model, &inputs, &y)?;
    let (inputs, y) = (inputs.numbers().to_f64(), y.numbers().to_f64());
    let record = Signals { inputs: &inputs, count: model.orders().inputs.len(), y: &y };
    let theta = model.theta().to_vec();
    let mut psi = vec![0.0; theta.len()];
    let mut prediction = Vec::with_capacity(samples);
    for (sample, &y) in record.y.iter().enumerate() {
        let inputs = record.inputs_of(sample);
        check(inputs, y).map_err(|error| Error::Sample { sample, error })?;
        prediction.push(model.regress(inputs, &mut psi).prediction);
        model.observe(y, &theta);
    }
    Ok(prediction)
}

/// T, if the signals are (T, inputs) and (T,).
fn check_shapes(model: &Polynomial, inputs: &View<'_>, y: &View<'_>) -> Result<usize, Error> {
    let samples = y.shape().first().copied().unwrap_or(1);
    shape::check("y", y.shape(), &[samples], &[1])?;
    shape::check("u", inputs.shape(), &[samples], &[model.orders().inputs.len()])?;
    Ok(samples)
}

/// The signals of a record.
#[derive(Clone, Copy)]
struct Signals<'a> {
    inputs: &'a [f64],
    /// inputs a sample
    count: usize,
    y: &'a [f64],
}

impl<'a> Signals<'a> {
    fn inputs_of(&self, k: usize) -> &'a [f64] {
        &self.inputs[k * self.count..(k + 1) * self.count]
    }
}

fn run<T: Number, R: Recursion<T>>(
    model: &mut Polynomial,
    recursion: &mut R,
    record: Signals<'_>,
    outputs: &mut Outputs,
    go_on: GoOn<'_>,
) -> Result<(), (usize, forgetting::Error)> {
    let n = model.orders().parameters();
    let (mut psi, mut phi) = (vec![0.0; n], vec![T::ZERO; n]);
    let mut theta: Vec<f64> = recursion.theta().iter().map(|x| x.to_f64()).collect();
    let mut pause = Pause::new(go_on, 1, n);
    for (k, &y) in record.y.iter().enumerate() {
        let inputs = record.inputs_of(k);
        check(inputs, y).map_err(|error| (k, error))?;
        let sample = model.regress(inputs, &mut psi);
        let given = sample.complete && !y.is_nan();
        let target = sample.scale * (y + sample.shift);
        let mut skipped = Some(Skip::Missing);
        if given {
            for (own, &x) in phi.iter_mut().zip(&psi) {
                *own = T::from_f64(sample.scale * x);
            }
            skipped = recursion.take(&phi, T::from_f64(target)).map_err(|error| (k, error))?;
            theta.iter_mut().zip(recursion.theta()).for_each(|(own, x)| *own = x.to_f64());
        }
        model.observe(y, &theta);
        outputs.note(&sample, (&psi, target, given), y, model);
        outputs.note_skipped(skipped);
        pause.after(1).map_err(|error| (k, error))?;
    }
    Ok(())
}

/// Refuses what is infinite.
fn check(inputs: &[f64], y: f64) -> Result<(), forgetting::Error> {
    let allowed = "finite, or NaN for a value that is missing";
    for (i, &u) in inputs.iter().enumerate() {
        if u.is_infinite() {
            return Err(forgetting::Error::value("u", u, allowed).at(i));
        }
    }
    match y.is_infinite() {
        true => Err(forgetting::Error::value("y", y, allowed)),
        false => Ok(()),
    }
}

impl Outputs {
    /// None of a sample yet.
    fn named(names: &[&str]) -> Result<Self, Error> {
        if let Some(name) = names.iter().find(|name| !MODEL_OUTPUTS.contains(name)) {
            return Err(Error::Output { name: (*name).into(), allowed: MODEL_OUTPUTS.join(", ") });
        }
        let room = |name| names.contains(&name).then(Vec::new);
        Ok(Self {
            phi: room("phi"),
            y: room("y"),
            error: room("error"),
            theta: room("theta"),
            scale: room("scale"),
            skipped: names.contains(&"skipped").then(Vec::new),
            used: 0,
        })
    }

    fn note(
        &mut self,
        sample: &forgetting::models::Linearised,
        (psi, target, given): (&[f64], f64, bool),
        y: f64,
        model: &Polynomial,
    ) {
        let known = |value: f64| if given { value } else { f64::NAN };
        if let Some(phi) = &mut self.phi {
            phi.extend(psi.iter().map(|x| known(sample.scale * x)));
        }
        push(&mut self.y, known(target));
        push(&mut self.error, known(y - sample.prediction));
        push(&mut self.scale, sample.scale);
        if let Some(kept) = &mut self.theta {
            let start = kept.len();
            kept.resize(start + psi.len(), 0.0);
            model.express(&mut kept[start..]);
        }
    }

    fn note_skipped(&mut self, skipped: Option<Skip>) {
        self.used += usize::from(skipped.is_none());
        push(&mut self.skipped, skipped.map_or(0, Skip::code));
    }

    fn finish(self, samples: usize, n: usize) -> Run {
        let numbers = |numbers: Option<Vec<f64>>| numbers.map(Elements::F64);
        let outputs = [
            ("phi", numbers(self.phi), vec![samples, n]),
            ("y", numbers(self.y), vec![samples]),
            ("error", numbers(self.error), vec![samples]),
            ("theta", numbers(self.theta), vec![samples, n]),
            ("scale", numbers(self.scale), vec![samples]),
            ("skipped", self.skipped.map(Elements::U8), vec![samples]),
        ];
        let outputs = outputs.into_iter().filter_map(|(name, elements, shape)| {
            elements.map(|elements| (name, Array { shape, elements }))
        });
        Run { outputs: outputs.collect(), samples, used: self.used, reweighted: false }
    }
}

fn push<X>(values: &mut Option<Vec<X>>, value: X) {
    if let Some(values) = values {
        values.push(value);
    }
}
