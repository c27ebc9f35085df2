//! All kernels, as functions of a number type.

use super::agee_turner::AgeeTurner;
use super::eigen::RankOneUpdate;
use super::lanes::members::Together;
use super::lanes::streams::{Outputs, Samples, Streams};
use super::lanes::together::MixThetas;
use super::lanes::Predict;
use super::measure::Measure;
use super::measured::Measured;
use super::runs::Steps;
use super::symmetric::{SymmetricMultiply, SymmetricSubtract};
use super::triangle::{Leverage, Multiply, MultiplyTransposed, Solve};
use super::units::{ScaleRows, SumRoots};
use super::variances::{Trace, Variances};
use super::vectors::{AddScaled, Arrive, Dot};
use super::watch::{Observation, Observations, Watch};
use crate::number::Real;

/// A number type with its kernels, each compiled once, in the crate that defines the type
/// ([`compile_kernels`](crate::compile_kernels)).
pub trait Kernels: Real {
    /// Σ aᵢ bᵢ
    fn dot(task: Dot<'_, Self>) -> Self;
    /// y ← y + c·x
    fn add_scaled(task: AddScaled<'_, Self>);
    /// φ·θ and φ·φ, with a copy of φ.
    fn arrive(task: Arrive<'_, Self>) -> (Self, Self);
    /// f·P·fᵀ
    fn leverage(task: Leverage<'_, Self>) -> Self;
    /// Forgets in one of the forms, measures one row and corrects θ; None if P has no room.
    fn measure(task: Measure<'_, Self>) -> Option<Measured<Self>>;
    /// P ← P + c·x·xᵀ
    fn agee_turner(task: AgeeTurner<'_, Self>);
    /// x ← U⁻¹·x
    fn solve(task: Solve<'_, Self>);
    /// x ← U·x
    fn multiply(task: Multiply<'_, Self>);
    /// x ← Uᵀ·x
    fn multiply_transposed(task: MultiplyTransposed<'_, Self>);
    /// The product of a symmetric matrix and a vector.
    fn symmetric_multiply(task: SymmetricMultiply<'_, Self>);
    /// A ← c A − x·xᵀ for a symmetric matrix.
    fn symmetric_subtract(task: SymmetricSubtract<'_, Self>);
    /// The diagonal of P.
    fn variances(task: Variances<'_, Self>);
    /// The trace of P.
    fn trace(task: Trace<'_, Self>) -> Self;
    /// Takes samples one after the other; returns how many.
    fn advance(steps: &mut Steps<'_, Self>) -> usize;
    /// Takes a sample of each stream; returns how many used it.
    fn advance_streams(
        streams: &mut Streams<'_, Self>,
        samples: Samples<'_, Self>,
        outputs: &mut Outputs<'_, Self>,
    ) -> usize;
    /// Lets several estimators take the same samples; returns how many samples.
    fn advance_together(task: Together<'_, Self>) -> usize;
    /// θ of the mixture of several estimators.
    fn mix_thetas(task: MixThetas<'_, Self>);
    /// Each row times the same numbers, one for each column.
    fn scale_rows(task: ScaleRows<'_, Self>);
    /// The squares of each column, and how many numbers are not 0.
    fn sum_roots(task: SumRoots<'_, Self>);
    /// φθ of each stream.
    fn predict_streams(task: Predict<'_, Self>);
    /// Shows a run of samples of one row to the monitor; returns how many of them left P wound up.
    fn watch_run(task: Watch<'_, Self>, samples: Observations<'_, Self>) -> usize;
    /// Shows one sample to the monitor, None if it was left out.
    fn watch_one(task: Watch<'_, Self>, sample: Option<Observation<'_, Self>>) -> usize;
    /// The eigenvalues and eigenvectors after a rank-one change; false if they are out of range.
    fn update_eigenvectors(task: RankOneUpdate<'_, Self>) -> bool;
}

/// Compiles all kernels for a number type, with the instructions that `$Dispatch` chooses.
///
/// ```text
/// compile_kernels!(f64, Portable);
/// ```
///
/// With `#[inline]` at the end, other crates compile those that they use.
#[macro_export]
macro_rules! compile_kernels {
    ($Number:ty, $Dispatch:ty $(, #[$inline:meta])?) => {
        const _: () = {
            use $crate::kernel::agee_turner::AgeeTurner;
            use $crate::kernel::eigen::RankOneUpdate;
            use $crate::kernel::lanes::streams::{Outputs, Samples, Streams};
            use $crate::kernel::lanes::members::Together;
            use $crate::kernel::lanes::together::{self, MixThetas};
            use $crate::kernel::lanes::{self, Advance, Predict};
            use $crate::kernel::measure::{self, Measure};
            use $crate::kernel::measured::Measured;
            use $crate::kernel::runs::{self, Steps};
            use $crate::kernel::symmetric::{SymmetricMultiply, SymmetricSubtract};
            use $crate::kernel::triangle::{Leverage, Multiply, MultiplyTransposed, Solve};
            use $crate::kernel::units::{ScaleRows, SumRoots};
            use $crate::kernel::variances::{Trace, Variances};
            use $crate::kernel::vectors::{AddScaled, Arrive, Dot};
            use $crate::kernel::watch::{Observation, Observations, Watch};
            use $crate::{Dispatch, Kernels};

            impl Kernels for $Number {
                $(#[$inline])?
                fn dot(task: Dot<'_, Self>) -> Self {
                    <$Dispatch>::run(task)
                }
                $(#[$inline])?
                fn add_scaled(task: AddScaled<'_, Self>) {
                    <$Dispatch>::run(task)
                }
                $(#[$inline])?
                fn arrive(task: Arrive<'_, Self>) -> (Self, Self) {
                    <$Dispatch>::run(task)
                }
                $(#[$inline])?
                fn leverage(task: Leverage<'_, Self>) -> Self {
                    <$Dispatch>::run(task)
                }
                $(#[$inline])?
                fn measure(task: Measure<'_, Self>) -> Option<Measured<Self>> {
                    measure::measure::<Self, $Dispatch>(task)
                }
                $(#[$inline])?
                fn agee_turner(task: AgeeTurner<'_, Self>) {
                    <$Dispatch>::run(task)
                }
                $(#[$inline])?
                fn solve(task: Solve<'_, Self>) {
                    <$Dispatch>::run(task)
                }
                $(#[$inline])?
                fn multiply(task: Multiply<'_, Self>) {
                    <$Dispatch>::run(task)
                }
                $(#[$inline])?
                fn multiply_transposed(task: MultiplyTransposed<'_, Self>) {
                    <$Dispatch>::run(task)
                }
                $(#[$inline])?
                fn symmetric_multiply(task: SymmetricMultiply<'_, Self>) {
                    <$Dispatch>::run(task)
                }
                $(#[$inline])?
                fn symmetric_subtract(task: SymmetricSubtract<'_, Self>) {
                    <$Dispatch>::run(task)
                }
                $(#[$inline])?
                fn variances(task: Variances<'_, Self>) {
                    <$Dispatch>::run(task)
                }
                $(#[$inline])?
                fn trace(task: Trace<'_, Self>) -> Self {
                    <$Dispatch>::run(task)
                }
                $(#[$inline])?
                fn advance(steps: &mut Steps<'_, Self>) -> usize {
                    runs::advance::<Self, $Dispatch>(steps)
                }
                $(#[$inline])?
                fn advance_streams(
                    streams: &mut Streams<'_, Self>,
                    samples: Samples<'_, Self>,
                    outputs: &mut Outputs<'_, Self>,
                ) -> usize {
                    lanes::advance::<Self, $Dispatch>(Advance { streams, samples, outputs })
                }
                $(#[$inline])?
                fn advance_together(task: Together<'_, Self>) -> usize {
                    together::advance::<Self, $Dispatch>(task)
                }
                $(#[$inline])?
                fn mix_thetas(task: MixThetas<'_, Self>) {
                    <$Dispatch>::run(task)
                }
                $(#[$inline])?
                fn scale_rows(task: ScaleRows<'_, Self>) {
                    <$Dispatch>::run(task)
                }
                $(#[$inline])?
                fn sum_roots(task: SumRoots<'_, Self>) {
                    <$Dispatch>::run(task)
                }
                $(#[$inline])?
                fn predict_streams(task: Predict<'_, Self>) {
                    <$Dispatch>::run(task)
                }
                $(#[$inline])?
                fn watch_run(task: Watch<'_, Self>, samples: Observations<'_, Self>) -> usize {
                    <$Dispatch>::run(task.of(samples))
                }
                $(#[$inline])?
                fn watch_one(
                    task: Watch<'_, Self>,
                    sample: Option<Observation<'_, Self>>,
                ) -> usize {
                    <$Dispatch>::run(task.of(sample))
                }
                $(#[$inline])?
                fn update_eigenvectors(task: RankOneUpdate<'_, Self>) -> bool {
                    <$Dispatch>::run(task)
                }
            }
        };
    };
}
