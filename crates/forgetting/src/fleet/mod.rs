//! Many independent streams of the same size and rule, updated together: a stream in each lane
//! of the vectors.
//!
//! Each stream is the estimator of one row and one target that [`Fleet::get`] returns, and the
//! recursion is the same source. With at most ten parameters the bits are those of as many
//! estimators; with more, sums are taken in another order.

mod before;
mod following;
mod kind;
mod part;
mod priors;
mod read;
mod size;
mod starts;
mod transfer;
mod units;

pub use before::Before;
pub use forgetting_kernels::kernel::lanes::streams::{Outputs, Samples, REFUSED};
pub use kind::{check_kind, check_stream};
pub use part::{Part, Parts};

use crate::error::Error;
use crate::estimator::AnyEstimator;
use crate::estimator::Numbers;
use crate::memory::Memory;
use crate::rates::Rate;
use alloc::vec::Vec;
use forgetting_kernels::kernel::form::Form;
use forgetting_kernels::kernel::lanes::storage::{Layout, Line};
use forgetting_kernels::kernel::lanes::streams::Streams;
use forgetting_kernels::kernel::lanes::SCRATCH;
use forgetting_kernels::kernel::layout::FEW;
use forgetting_kernels::Kernels;
use priors::Priors;
use size::extend;
use starts::Starts;
use transfer::numbers_of;
use units::Units;

/// Streams of one rule that only scales P or adds to it along the regressor
/// ([`Forgetting::form`]), each with a constant forgetting factor.
///
/// ```
/// use forgetting::fleet::{Fleet, Samples, Outputs};
/// use forgetting::choice::Defaults;
/// use forgetting::rates::AnyRate;
/// use forgetting::rules::Rule;
/// use forgetting::weightings::AnyWeighting;
/// use forgetting::{Dynamic, Estimator, Prior};
///
/// let memory = Dynamic::<f64>::new(2, 1, 1)?;
/// let one = Estimator::new(
///     Rule::named("exponential", &Defaults, memory)?,
///     AnyRate::named("constant", &Defaults, memory)?,
///     AnyWeighting::named("equal", &Defaults, memory)?,
///     Prior::scalar(memory, 100.0)?,
/// );
/// let mut fleet = Fleet::of(one)?;
/// fleet.grow(3)?;
/// for k in 0..50 {
///     let x = f64::from(k % 7);
///     let (phi, y) = ([1.0, x, 1.0, x, 1.0, x], [x, 1.0 + x, 2.0 + x]);
///     let outputs = Outputs { error: None, leverage: None, skipped: None };
///     let used = fleet.update(Samples { phi: &phi, y: &y, mask: None }, outputs)?;
///     assert_eq!(used, 3);
/// }
/// assert!((fleet.get(2).theta()[0] - 2.0).abs() < 1e-3);
/// # Ok::<(), forgetting::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Fleet<T: Kernels> {
    /// what a new stream starts as
    fresh: AnyEstimator<T>,
    form: Form<T>,
    layout: Layout,
    /// the numbers of a new stream
    start: Vec<T>,
    count: usize,
    lines: Vec<Line<T>>,
    offered: Vec<u64>,
    unused: Vec<u64>,
    /// one line, or one a block if `factors` differ
    strengths: Vec<Line<T>>,
    /// λ of each stream; empty if all have that of a new one
    factors: Vec<T>,
    priors: Priors<T>,
    /// if any stream follows the data
    units: Option<Units<T>>,
    scratch: Vec<Line<T>>,
}

impl<T: Kernels> Fleet<T> {
    /// No streams yet; new ones will start as `fresh` is configured.
    ///
    /// # Errors
    /// [`Error::Unsupported`] for an estimator that does more at a sample than to forget in one
    /// of the ways of [`Form`], measure and correct.
    pub fn of(mut fresh: AnyEstimator<T>) -> Result<Self, Error> {
        fresh.reset();
        let Some(form) = form_of(&fresh) else {
            let reason =
                "this fleet takes one row, one target, no monitor, no gate, equal weights, a \
                          constant forgetting factor and a rule that has a form";
            return Err(Error::Unsupported { reason });
        };
        let n = fresh.prior().memory().parameters();
        let layout = Layout::new(n);
        let mut start = numbers_of(layout, &mut fresh)?.numbers;
        start.truncate(layout.length());
        let units = fresh.prior().is_of_data().then(|| Units::new(n));
        Ok(Self {
            priors: Priors::of(fresh.prior().clone()),
            strengths: Vec::from([Line::splat(strength(form))]),
            scratch: Vec::new(),
            lines: Vec::new(),
            offered: Vec::new(),
            unused: Vec::new(),
            factors: Vec::new(),
            count: 0,
            fresh,
            form,
            layout,
            start,
            units,
        })
    }

    /// How many streams there are.
    pub fn count(&self) -> usize {
        self.count
    }

    /// What a new stream starts as.
    pub fn fresh(&self) -> &AnyEstimator<T> {
        &self.fresh
    }

    /// n
    pub fn parameters(&self) -> usize {
        self.fresh.prior().memory().parameters()
    }

    /// Whether the prior of any stream follows the data: its first samples then cost more than others.
    pub fn follows_data(&self) -> bool {
        self.units.as_ref().is_some_and(|units| units.following > 0)
    }

    /// Takes a sample for each stream; returns how many used it. See [`Part::update`].
    ///
    /// # Errors
    /// [`Error::Length`] unless everything given has as many numbers as there are streams; then
    /// nothing has changed.
    pub fn update(
        &mut self,
        samples: Samples<'_, T>,
        mut outputs: Outputs<'_, T>,
    ) -> Result<usize, Error> {
        let count = self.count;
        Error::check_length("phi", samples.phi.len(), count * self.parameters())?;
        Error::check_length("y", samples.y.len(), count)?;
        Error::check_length("mask", samples.mask.map_or(count, <[bool]>::len), count)?;
        let length = |numbers: &Option<&mut [T]>| numbers.as_ref().map_or(count, |all| all.len());
        Error::check_length("error", length(&outputs.error), count)?;
        Error::check_length("leverage", length(&outputs.leverage), count)?;
        let codes = outputs.skipped.as_ref().map_or(count, |all| all.len());
        Error::check_length("skipped", codes, count)?;
        Ok(self.parts(1)?.next().map_or(0, |mut part| part.update(samples, &mut outputs)))
    }

    /// The streams in at most `most` parts, which can take their samples at the same time.
    ///
    /// # Errors
    /// [`Error::Memory`] when there is none for more parts than ever before.
    pub fn parts(&mut self, most: usize) -> Result<Parts<'_, T>, Error> {
        let n = self.parameters();
        let blocks = self.offered.len().div_ceil(most.max(1)).max(1);
        let scratch = if n > FEW { SCRATCH * n } else { 0 };
        let lines = scratch * self.offered.len().div_ceil(blocks);
        extend(&mut self.scratch, lines, Line::splat(T::ZERO))?;
        Ok(self.all(blocks, scratch))
    }

    /// The λ of a new stream.
    fn factor(&self) -> T {
        self.fresh.rate().constant().unwrap_or(T::ONE)
    }

    /// λ of a stream.
    pub fn forgetting_factor(&self, stream: usize) -> T {
        self.starts().forgetting_factor(stream)
    }

    /// Samples that a stream has used.
    pub fn samples(&self, stream: usize) -> u64 {
        self.offered[stream / Line::<T>::LANES].wrapping_sub(self.unused[stream])
    }

    /// A copy of the stream, as an estimator that goes on from there.
    ///
    /// # Panics
    /// If there is no such stream.
    pub fn get(&self, stream: usize) -> AnyEstimator<T> {
        let mut estimator = self.starts().estimator(stream);
        self.state(stream).give(&mut estimator);
        estimator
    }

    /// The state of a stream, in the order in which an estimator shows it.
    fn state(&self, stream: usize) -> Numbers<T> {
        let (mut numbers, mut counts) =
            (self.numbers(stream).collect::<Vec<_>>(), Vec::from([self.samples(stream)]));
        let follows = self.priors.get(stream).is_of_data();
        if let Some(units) = self.units.as_ref().filter(|_| follows) {
            numbers.extend(units.numbers(stream));
            counts.push(units.measured(stream, &self.offered));
        }
        Numbers::new(numbers, counts)
    }

    /// The numbers of a stream.
    fn numbers(&self, stream: usize) -> impl Iterator<Item = T> + '_ {
        let (block, lane) = (stream / Line::<T>::LANES, stream % Line::<T>::LANES);
        let length = self.layout.length();
        self.lines[block * length..(block + 1) * length].iter().map(move |line| line.get(lane))
    }

    /// What the streams start from.
    fn starts(&self) -> Starts<'_, T> {
        Starts { fresh: &self.fresh, factors: &self.factors, priors: &self.priors }
    }
}

/// How every sample changes P of an estimator that can be a stream: one that follows the data has few
/// parameters.
fn form_of<T: Kernels>(estimator: &AnyEstimator<T>) -> Option<Form<T>> {
    let few = estimator.prior().memory().parameters() <= FEW;
    let plain = estimator.health().is_none() && (few || !estimator.prior().is_of_data());
    estimator.form().filter(|_| plain)
}

/// What distinguishes forms of one rule.
fn strength<T: Kernels>(form: Form<T>) -> T {
    match form {
        Form::Scale { growth } => growth,
        Form::Along { weight, .. } => weight,
        Form::Walk { noise, .. } => noise,
    }
}
