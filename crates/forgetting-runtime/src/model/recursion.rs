//! What a model needs of the estimator behind it: to take one sample and to say θ.

use crate::bank::outputs::Outputs as BankOutputs;
use crate::bank::record as bank_record;
use crate::error::Error;
use crate::estimator::record::{self, Record, RecordBounds, Run, Sizes};
use crate::number::Number;
use forgetting::{bank, AnyEstimator, Skip};

/// One sample at a time, whatever takes it.
pub(super) trait Recursion<T> {
    /// What is kept of each sample.
    type Outputs;

    /// Room for the outputs of these names.
    fn outputs(&mut self, names: &[&str], sizes: Sizes) -> Result<Self::Outputs, Error>;

    /// Takes the one sample of `record`, or leaves it out; why it was not used, if it was not.
    fn take(
        &mut self,
        record: &Record<'_, T>,
        bounds: Option<&mut RecordBounds>,
        outputs: &mut Self::Outputs,
    ) -> Result<Option<Skip>, forgetting::Error>;

    /// The estimate.
    fn theta(&self) -> &[T];

    /// The outputs as arrays.
    fn finish(&mut self, outputs: Self::Outputs, sizes: Sizes) -> Run;
}

impl<T: Number> Recursion<T> for AnyEstimator<T> {
    type Outputs = record::Outputs<T>;

    fn outputs(&mut self, names: &[&str], sizes: Sizes) -> Result<Self::Outputs, Error> {
        let outputs = record::Outputs::named(names, sizes)?;
        outputs.prepare(self);
        Ok(outputs)
    }

    fn take(
        &mut self,
        record: &Record<'_, T>,
        bounds: Option<&mut RecordBounds>,
        outputs: &mut Self::Outputs,
    ) -> Result<Option<Skip>, forgetting::Error> {
        record::one(self, (record, None, bounds), 0, outputs)
    }

    fn theta(&self) -> &[T] {
        AnyEstimator::theta(self)
    }

    fn finish(&mut self, outputs: Self::Outputs, sizes: Sizes) -> Run {
        self.keep_innovations(false);
        self.keep_prior(false);
        outputs.finish(sizes, &[sizes.samples])
    }
}

impl<T: Number> Recursion<T> for bank::Bank<T> {
    type Outputs = BankOutputs<T>;

    fn outputs(&mut self, names: &[&str], sizes: Sizes) -> Result<Self::Outputs, Error> {
        BankOutputs::named(names, sizes, self.weights().len())
    }

    fn take(
        &mut self,
        record: &Record<'_, T>,
        _: Option<&mut RecordBounds>,
        outputs: &mut Self::Outputs,
    ) -> Result<Option<Skip>, forgetting::Error> {
        bank_record::one(self, (record, None), 0, outputs)
    }

    fn theta(&self) -> &[T] {
        bank::Bank::theta(self)
    }

    fn finish(&mut self, outputs: Self::Outputs, sizes: Sizes) -> Run {
        outputs.finish(sizes, self.weights().len(), &[sizes.samples])
    }
}
