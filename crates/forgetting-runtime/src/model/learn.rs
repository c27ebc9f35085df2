//! A whole record through a model and the estimator behind it.

use super::recursion::Recursion;
use crate::bank::record::ONE_RULE;
use crate::bank::Bank;
use crate::error::Error;
use crate::estimator::record::{Bounds, Pause, Record, RecordBounds, RecordNoise, Sizes};
use crate::estimator::{Estimator, GoOn, Run};
use crate::missing::Missing;
use crate::number::{each, Array, Elements, Number, View};
use crate::shape;
use forgetting::models::Polynomial;
use forgetting::Skip;

/// Names of what a model can tell of each sample.
///
/// | output | shape | |
/// |---|---|---|
/// | `phi`, `y` | (T, n), (T,) | what the estimator was given: ψ and y − φθ + ψθ, both times a scale; NaN where it was not; of the parameters that are estimated, and less what is known of θ |
/// | `error` | (T,) | y − φθ with the θ of before; NaN where a value is missing |
/// | `theta` | (T, n) | the estimate after each sample |
/// | `scale` | (T,) | the root of how far the sample was trusted, below 1 at the start |
/// | `skipped` | (T,) | why the estimator did not use the sample, 0 if it did |
///
/// What else is named is an output of the estimator or the bank, see [`Run`], of the parameters that are
/// estimated.
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
    (names, bounds): (&[&str], Option<Bounds<'_>>),
    go_on: GoOn<'_>,
) -> Result<Run, Error> {
    let (n, rows, targets) = learner.sizes();
    let own = model.estimated().len();
    if (n, rows, targets) != (own, 1, 1) {
        let reason = format!("the estimator must have {own} parameters, one row and one target");
        return Err(Error::unsupported(reason));
    }
    let samples = check_shapes(model, &inputs, &y)?;
    let (own, others): (Vec<&str>, Vec<&str>) =
        names.iter().partition(|name| MODEL_OUTPUTS.contains(name));
    let mut outputs = Outputs::named(&own);
    let sizes = Sizes { samples, parameters: n, rows: 1, targets: 1 };
    let (inputs, y) = (inputs.numbers().to_f64(), y.numbers().to_f64());
    let record = Signals { inputs: &inputs, count: model.orders().inputs.len(), y: &y };
    let mut found = match learner {
        Learner::Estimator(own) => each!(&mut own.typed, estimator => {
            let bounds = bounds.as_ref().map(|own| RecordBounds::read(own, estimator)).transpose()?;
            let mut kept = estimator.outputs(&others, sizes)?;
            let both = (&mut outputs, &mut kept);
            let taken =
                estimator.all_or_nothing(|own| run(model, own, (record, bounds), both, go_on));
            let found = estimator.finish(kept, sizes);
            taken.map(|()| found)
        }),
        Learner::Bank(_) if bounds.is_some() => return Err(Error::unsupported(ONE_RULE)),
        Learner::Bank(own) => each!(&mut own.typed, bank => {
            let mut kept = bank.outputs(&others, sizes)?;
            let both = (&mut outputs, &mut kept);
            let taken = bank.all_or_nothing(|own| run(model, own, (record, None), both, go_on));
            let found = bank.finish(kept, sizes);
            taken.map(|()| found)
        }),
    }
    .map_err(|(sample, error)| Error::Sample { sample, error })?;
    let own = outputs.finish(samples, (model.orders().parameters(), n));
    found.outputs.extend(own.outputs);
    Ok(Run { used: own.used, ..found })
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
    (record, mut bounds): (Signals<'_>, Option<RecordBounds>),
    (outputs, others): (&mut Outputs, &mut R::Outputs),
    go_on: GoOn<'_>,
) -> Result<(), (usize, forgetting::Error)> {
    let estimated = model.estimated().to_vec();
    let (n, count) = (model.orders().parameters(), estimated.len());
    let sizes = Sizes { samples: 1, parameters: count, rows: 1, targets: 1 };
    let (mut psi, mut theta) = (vec![0.0; n], vec![0.0; n]);
    let (mut given, mut phi) = (vec![0.0; count], vec![T::ZERO; count]);
    let (missing, mut pause) = (Missing::Skip, Pause::new(go_on, 1, count));
    for (k, &y) in record.y.iter().enumerate() {
        let inputs = record.inputs_of(k);
        check(inputs, y).map_err(|error| (k, error))?;
        let sample = model.regress(inputs, &mut psi);
        let complete = sample.complete && !y.is_nan();
        let target = if complete { sample.scale * (y + sample.shift) } else { f64::NAN };
        for ((own, number), &place) in given.iter_mut().zip(&mut phi).zip(&estimated) {
            *own = sample.scale * psi[place];
            *number = T::from_f64(*own);
        }
        let target_ = [T::from_f64(target)];
        let one = Record { sizes, phi: &phi, y: &target_, noise: RecordNoise::Unit, missing };
        let skipped = recursion.take(&one, bounds.as_mut(), others).map_err(|error| (k, error))?;
        model.complete(recursion.theta().iter().map(|x| x.to_f64()), &mut theta);
        model.observe(y, &theta);
        outputs.note(&sample, (&given, target), y, model);
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
    fn named(names: &[&str]) -> Self {
        let room = |name| names.contains(&name).then(Vec::new);
        Self {
            phi: room("phi"),
            y: room("y"),
            error: room("error"),
            theta: room("theta"),
            scale: room("scale"),
            skipped: names.contains(&"skipped").then(Vec::new),
            used: 0,
        }
    }

    fn note(
        &mut self,
        sample: &forgetting::models::Linearised,
        (given, target): (&[f64], f64),
        y: f64,
        model: &Polynomial,
    ) {
        // a target that is missing says that the estimator was not given the sample
        let known = |value: f64| if target.is_nan() { f64::NAN } else { value };
        if let Some(phi) = &mut self.phi {
            phi.extend(given.iter().map(|&x| known(x)));
        }
        push(&mut self.y, target);
        push(&mut self.error, known(y - sample.prediction));
        push(&mut self.scale, sample.scale);
        if let Some(kept) = &mut self.theta {
            let start = kept.len();
            kept.resize(start + model.orders().parameters(), 0.0);
            model.express(&mut kept[start..]);
        }
    }

    fn note_skipped(&mut self, skipped: Option<Skip>) {
        self.used += usize::from(skipped.is_none());
        push(&mut self.skipped, skipped.map_or(0, Skip::code));
    }

    fn finish(self, samples: usize, (n, estimated): (usize, usize)) -> Run {
        let numbers = |numbers: Option<Vec<f64>>| numbers.map(Elements::F64);
        let outputs = [
            ("phi", numbers(self.phi), vec![samples, estimated]),
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
