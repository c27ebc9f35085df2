//! One sample in one call.

use crate::error::Error;
use crate::missing::{is_missing, Missing};
use crate::number::{Array, Elements, Number, View};
use crate::shape;
use forgetting::{Answer, AnyEstimator, Dynamic, Memory, Noise, Real, Skip};

/// One number a row and target of a sample.
#[derive(Clone, Debug, PartialEq)]
pub enum Innovation {
    /// of one row and one target
    Scalar(f64),
    /// of several
    Array {
        /// the p x m numbers, row by row
        elements: Box<[f64]>,
        /// m
        targets: usize,
    },
}

impl Innovation {
    #[inline]
    pub(crate) fn new<T: Real>(elements: &[T], targets: usize) -> Self {
        match elements {
            [element] => Self::Scalar(element.to_f64()),
            elements => {
                Self::Array { elements: elements.iter().map(|x| x.to_f64()).collect(), targets }
            }
        }
    }

    /// The numbers in their shape: (), (rows,) or (rows, targets).
    #[must_use]
    pub fn array(&self) -> Array {
        let (elements, shape) = match self {
            Self::Scalar(element) => (vec![*element], vec![]),
            Self::Array { elements, targets: 1 } => (elements.to_vec(), vec![elements.len()]),
            Self::Array { elements, targets } => {
                (elements.to_vec(), vec![elements.len() / targets, *targets])
            }
        };
        Array { shape, elements: Elements::F64(elements) }
    }
}

/// How a sample is taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UpdateOptions {
    /// the time since the last sample, in the unit in which forgetting is stated: a forgetting factor
    /// becomes its power, at least 1/1024, and process noise a multiple
    pub elapsed: f64,
    /// what is done with a sample that has a NaN
    pub missing: Missing,
}

impl Default for UpdateOptions {
    fn default() -> Self {
        Self { elapsed: 1.0, missing: Missing::Error }
    }
}

/// What one sample did.
#[derive(Clone, Debug, PartialEq)]
pub struct Update {
    /// y − φθ with the θ of before, in units of y
    pub error: Innovation,
    /// L⁻¹(y − φθ) with L Lᵀ = Γ + φP̄φᵀ, L lower triangular; see [`forgetting::Update::whiten`]
    pub whitened_innovation: Innovation,
    /// tr φ̄P̄φ̄ᵀ: the variance of the prediction in units of the noise variance
    pub leverage: f64,
    /// Γ was divided by this, by the weighting and by the rule
    pub weight: f64,
    /// the forgetting factor used, in (0, 1]
    pub forgetting_factor: f64,
    /// number of directions that lost information
    pub rank: usize,
    /// why the sample was left out, if it was
    pub skipped: Option<Skip>,
    /// what the gate said
    pub gate: Answer,
    /// whether P has wound up
    pub windup: bool,
}

impl Update {
    /// Of a sample that is missing, of so many errors.
    fn of_missing(errors: usize, targets: usize) -> Self {
        let nothing = Innovation::new(&vec![f64::NAN; errors], targets);
        Self {
            error: nothing.clone(),
            whitened_innovation: nothing,
            leverage: f64::NAN,
            weight: 1.0,
            forgetting_factor: 1.0,
            rank: 0,
            skipped: Some(Skip::Missing),
            gate: Answer::Update,
            windup: false,
        }
    }

    /// From the core's; several rows must be whitened.
    #[inline]
    fn new<T: Real>(update: &forgetting::Update<'_, T>, targets: usize) -> Result<Self, Error> {
        let whitened_innovation = if update.error.len() == 1 {
            let mut whitened = [T::ZERO];
            update.whiten(&mut whitened)?;
            Innovation::Scalar(whitened[0].to_f64())
        } else {
            let mut whitened = vec![T::ZERO; update.error.len()];
            update.whiten(&mut whitened)?;
            Innovation::new(&whitened, targets)
        };
        Ok(Self {
            error: Innovation::new(update.error, targets),
            whitened_innovation,
            leverage: update.leverage.to_f64(),
            weight: update.weight.to_f64(),
            forgetting_factor: update.forgetting_factor.to_f64(),
            rank: update.rank,
            skipped: update.skipped,
            gate: update.gate,
            windup: update.windup,
        })
    }
}

/// Updates `estimator` with one sample: φ (p, n), y (p, m) and Γ, 1, () or (p, p).
#[inline]
pub(crate) fn update<T: Number>(
    estimator: &mut AnyEstimator<T>,
    (phi, y, gamma): (View<'_>, View<'_>, Option<View<'_>>),
    options: UpdateOptions,
) -> Result<Update, Error> {
    let memory = estimator.prior().memory();
    let (p, m) = (memory.rows(), memory.targets());
    check_shapes(memory, &phi, &y, gamma.as_ref())?;
    if p > 1 {
        estimator.keep_innovations(true);
    }
    let gamma = gamma.map(|gamma| T::read(gamma.numbers()));
    let noise = noise_of(gamma.as_deref());
    let (phi, y) = (T::read(phi.numbers()), T::read(y.numbers()));
    if options.missing == Missing::Skip && is_missing(&phi, &y) {
        return Ok(Update::of_missing(p * m, m));
    }
    let update = estimator.update_after(T::from_f64(options.elapsed), &phi, &y, noise)?;
    Update::new(&update, m)
}

/// Refuses a sample whose φ is not (p, n), whose y is not (p, m), or whose Γ does not fit.
#[inline]
pub(crate) fn check_shapes<T: Number>(
    memory: Dynamic<T>,
    phi: &View<'_>,
    y: &View<'_>,
    gamma: Option<&View<'_>>,
) -> Result<(), Error> {
    let (n, p, m) = (memory.parameters(), memory.rows(), memory.targets());
    shape::check("phi", phi.shape(), &[], &[p, n])?;
    shape::check("y", y.shape(), &[], &[p, m])?;
    gamma.map_or(Ok(()), |gamma| check_gamma(gamma.shape(), p))
}

/// Γ as it was given: nothing, a number or p x p numbers.
#[inline]
pub(crate) fn noise_of<T: Real>(gamma: Option<&[T]>) -> Noise<'_, T> {
    match gamma {
        None => Noise::Unit,
        Some([scalar]) => Noise::Scalar(*scalar),
        Some(full) => Noise::Full(full),
    }
}

/// Refuses a Γ of one sample that is neither a number nor p x p numbers.
pub(crate) fn check_gamma(gamma: &[usize], p: usize) -> Result<(), Error> {
    if gamma.is_empty() || shape::fits(gamma, &[p, p]) {
        return Ok(());
    }
    let allowed = if p == 1 { shape::forms(&[], &[1, 1]) } else { format!("() or ({p}, {p})") };
    Err(Error::shape("gamma", gamma, allowed))
}
