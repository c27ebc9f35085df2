//! Streams as estimators and back.

use super::part::{Part, Parts};
use super::starts::Starts;
use super::units::Units;
use super::{check_kind, extend, form_of, strength, Fleet, Layout, Line, Streams, FEW};
use crate::covariance::Prior;
use crate::error::Error;
use crate::estimator::{AnyEstimator, Numbers};
use crate::memory::{Dynamic, Memory};
use crate::rates::Rate;
use forgetting_kernels::Kernels;

impl<T: Kernels> Fleet<T> {
    /// Puts `estimator` in the place of a stream.
    ///
    /// # Errors
    /// Those of [`check_kind`], [`Error::Memory`]; nothing has changed.
    ///
    /// # Panics
    /// If there is no such stream.
    pub fn put(&mut self, stream: usize, mut estimator: AnyEstimator<T>) -> Result<(), Error> {
        check_kind(&self.fresh, &estimator)?;
        let given = numbers_of(self.layout, &mut estimator)?;
        let lambda = estimator.rate().constant().unwrap_or(T::ONE);
        let form = form_of(&estimator).unwrap_or(self.form);
        self.place(stream, &given, (lambda, strength(form)), Some(estimator.prior()))
    }

    /// Gives a stream this state, forgetting factor with what its form makes of it, and prior, unless
    /// that is the common one that it has.
    ///
    /// # Errors
    /// [`Error::Memory`], [`Error::Unsupported`] for a prior that the streams cannot have; nothing has
    /// changed.
    pub(super) fn place(
        &mut self,
        stream: usize,
        given: &Numbers<T>,
        factor: (T, T),
        prior: Option<&Prior<Dynamic<T>>>,
    ) -> Result<(), Error> {
        let own = self.priors.get(stream);
        let follows = [own, prior.unwrap_or(own)].map(Prior::is_of_data);
        if follows[1] {
            self.follow()?;
        }
        self.set_factor(stream, factor)?;
        if let Some(prior) = prior {
            self.priors.put(stream, prior, self.count)?;
        }
        let [before, after] = follows.map(usize::from);
        if let Some(units) = &mut self.units {
            units.following += after;
        }
        self.whole().set(stream, given);
        if let Some(units) = &mut self.units {
            units.following -= before;
        }
        Ok(())
    }

    /// Makes room for the units of the streams, if there is none.
    fn follow(&mut self) -> Result<(), Error> {
        let n = self.parameters();
        if n > FEW {
            let reason = "a stream of this fleet has an initial covariance";
            return Err(Error::Unsupported { reason });
        }
        if self.units.is_none() {
            let mut units = Units::new(n);
            units.reserve(self.offered.len(), self.count)?;
            units.grow(&self.offered, self.count);
            self.units = Some(units);
        }
        Ok(())
    }

    /// All streams.
    fn whole(&mut self) -> Part<'_, T> {
        let n = self.parameters();
        let starts = Starts { fresh: &self.fresh, factors: &self.factors, priors: &self.priors };
        let units = self.units.as_mut().filter(|units| units.following > 0);
        let (units, following) = units.map(|units| units.all(starts)).unzip();
        let streams = Streams {
            count: self.count,
            n,
            form: self.form,
            strengths: &self.strengths,
            lines: &mut self.lines,
            offered: &mut self.offered,
            unused: &mut self.unused,
            units,
            scratch: &mut self.scratch,
        };
        Part { streams, following }
    }

    /// All streams, to be split.
    pub(super) fn all(&mut self, blocks: usize, scratch: usize) -> Parts<'_, T> {
        let Part { streams, following } = self.whole();
        Parts { rest: streams, following, blocks, scratch }
    }

    /// Sets λ of a stream, and what its form makes of it.
    fn set_factor(&mut self, stream: usize, (lambda, own): (T, T)) -> Result<(), Error> {
        if lambda == self.forgetting_factor(stream) {
            return Ok(());
        }
        let (factor, common) = (self.factor(), strength(self.form));
        extend(&mut self.factors, self.count, factor)?;
        extend(&mut self.strengths, self.offered.len(), Line::splat(common))?;
        self.factors[stream] = lambda;
        let (block, lane) = (stream / Line::<T>::LANES, stream % Line::<T>::LANES);
        self.strengths[block].set(lane, own);
        Ok(())
    }

    /// What the form of a stream makes of its forgetting factor.
    pub(super) fn strength(&self, stream: usize) -> T {
        let (block, lane) = (stream / Line::<T>::LANES, stream % Line::<T>::LANES);
        if self.factors.is_empty() {
            return strength(self.form);
        }
        self.strengths[block].get(lane)
    }

    /// Starts these streams again from their priors.
    ///
    /// # Panics
    /// If there are no such streams.
    pub fn reset(&mut self, streams: impl IntoIterator<Item = usize>) {
        let common = Numbers::of(&mut self.fresh.clone());
        for stream in streams {
            if self.priors.is_common(stream) {
                self.whole().set(stream, &common);
            } else {
                let own = Numbers::of(&mut self.starts().estimator(stream));
                self.whole().set(stream, &own);
            }
        }
    }
}

/// The numbers of an estimator that is to be a stream.
///
/// # Errors
/// [`Error::Unsupported`] for one that remembers more than P, θ and the units of the data.
pub(super) fn numbers_of<T: Kernels>(
    layout: Layout,
    estimator: &mut AnyEstimator<T>,
) -> Result<Numbers<T>, Error> {
    let n = estimator.prior().memory().parameters();
    let (units, counts) = if estimator.prior().is_of_data() { (3 * n, 2) } else { (0, 1) };
    let numbers = Numbers::of(estimator);
    if (numbers.numbers.len(), numbers.counts.len()) == (layout.length() + units, counts) {
        return Ok(numbers);
    }
    Err(Error::Unsupported { reason: "a stream of this fleet has P and theta alone" })
}
