//! Samples after a time of their own, or with a noise of their own.
//!
//! A compact estimator is asked for its pace and given a whitened sample, so that the exponential, the
//! logarithm and the square root are linked with `fg_update_after` only.

use super::{Head, Kind, Outcome, Saving, View};
use crate::code::Code;
use crate::model::Float;
use crate::report::Report;
use forgetting_kernels::kernel::layout::FEW;

/// A type of number, and the estimators of it.
pub trait Viewed: Float {
    /// How a compact estimator of this type is looked at.
    fn view(saving: &Saving) -> Option<&View<Self>>;
}

impl Viewed for f32 {
    fn view(saving: &Saving) -> Option<&View<Self>> {
        if let Saving::F32(view) = saving {
            Some(view)
        } else {
            None
        }
    }
}

impl Viewed for f64 {
    fn view(saving: &Saving) -> Option<&View<Self>> {
        if let Saving::F64(view) = saving {
            Some(view)
        } else {
            None
        }
    }
}

/// The estimator at `head` takes the sample (`phi`, `y`), `elapsed` after the last one, of which Γ is
/// `gamma`, if it is known. `report` is null or is told what became of it.
///
/// # Safety
/// It is one of this kind, of this type of number and of as many parameters.
pub(crate) unsafe fn update_after<T: Viewed>(
    (kind, head): (&Kind, *mut Head),
    elapsed: T,
    (phi, y): (&[T], T),
    gamma: *const T,
    report: *mut Report<T>,
) -> Outcome {
    // SAFETY: as above.
    unsafe {
        match (&kind.saving, T::view(&kind.saving)) {
            (_, Some(view)) => {
                let gamma = gamma.as_ref().copied();
                let own = compact((kind, view, head), elapsed, (phi, y), gamma)?;
                if !report.is_null() {
                    report.write(own);
                }
                Ok(())
            }
            (Saving::Whole(whole), None) => {
                let (elapsed, y) = (&raw const elapsed, &raw const y);
                let (phi, gamma) = (phi.as_ptr().cast(), gamma.cast());
                (whole.update_after)(head, elapsed.cast(), phi, y.cast(), gamma, report.cast())
            }
            _ => Err(Code::NumberType.into()),
        }
    }
}

unsafe fn compact<T: Viewed>(
    (kind, view, head): (&Kind, &View<T>, *mut Head),
    elapsed: T,
    (phi, y): (&[T], T),
    gamma: Option<T>,
) -> Result<Report<T>, crate::code::Why> {
    let (mut room, mut product, mut report) = ([T::ZERO; FEW], T::ZERO, Report::default());
    let whitened = room.get_mut(..phi.len()).ok_or(Code::Length)?;
    // SAFETY: the caller says that it is one of this kind, and that there are n numbers.
    unsafe {
        (kind.predict)(head, phi.as_ptr().cast(), (&raw mut product).cast());
        let given = (view.pace)(head).given(elapsed, (phi, y, product), gamma, whitened)?;
        let (y, told) = ((&raw const y).cast(), (&raw mut report).cast());
        let given_at = (&raw const given).cast();
        (kind.update)(head, whitened.as_ptr().cast(), y, told, given_at)?;
        report.forgetting_factor = given.factor;
    }
    report.error = y - product;
    Ok(report)
}
