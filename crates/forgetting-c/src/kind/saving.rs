//! How an estimator is saved and loaded.
//!
//! What this takes is linked with [`fg_save`](crate::fg_save) and [`fg_load`](crate::fg_load) only: the
//! tables of compact kinds hold no more than how to look at an estimator. So it is with
//! [time](super::after).

use super::{at, put, Head, Held, Kind, Outcome};
use crate::model::{Compact, Saves};
use crate::report::Report;
use core::mem::{size_of, MaybeUninit};
use core::slice::from_raw_parts;
use forgetting::choice::Values;
use forgetting::compact::{load, save, Pace, Saved};
use forgetting::{Error, Kernels};

/// Takes bytes, one piece after the other.
type Put<'a> = dyn FnMut(&[u8]) + 'a;

/// How estimators of a kind are saved.
#[derive(Debug)]
pub enum Saving {
    /// a compact one of `float`
    F32(View<f32>),
    /// a compact one of `double`
    F64(View<f64>),
    /// by itself
    Whole(Whole),
}

/// How a compact estimator is made and looked at.
#[derive(Debug)]
pub struct View<T: Kernels> {
    rule: &'static str,
    make: unsafe fn(*mut Head, &'static Kind, &dyn Values, T) -> Result<(), Error>,
    at: unsafe fn(*mut Head) -> *mut dyn Saved<T>,
    pub(super) pace: unsafe fn(*mut Head) -> Pace<T>,
}

/// How an estimator saves and loads itself.
#[derive(Debug)]
pub struct Whole {
    save: unsafe fn(*mut Head, &mut Put<'_>) -> Outcome,
    load: unsafe fn(*mut Head, &'static Kind, &[u8]) -> Outcome,
    /// time, φ, y, Γ or null, and where to write the report
    pub(super) update_after:
        unsafe fn(*mut Head, *const u8, *const u8, *const u8, *const u8, *mut u8) -> Outcome,
}

/// Words of eight bytes that hold any compact estimator.
const MOST: usize = 64;

impl<T: Kernels> View<T> {
    /// That of `E`.
    pub(crate) const fn of<E: Compact<Real = T>>() -> Self {
        assert!(size_of::<Held<E>>() <= 8 * MOST);
        Self { rule: E::RULE, make: make::<E>, at: look_at::<E>, pace: pace::<E> }
    }

    /// Loads into memory of its own first: what was there before stays if the bytes are refused.
    unsafe fn load(&self, head: *mut Head, kind: &'static Kind, bytes: &[u8]) -> Outcome {
        let mut memory = [MaybeUninit::<u64>::uninit(); MOST];
        let place = memory.as_mut_ptr().cast::<Head>();
        load((self.rule, kind.parameters.0), bytes, |values, lambda| {
            // SAFETY: an estimator of this kind fits, and is what is then looked at.
            unsafe {
                (self.make)(place, kind, values, lambda)?;
                Ok(&mut *(self.at)(place))
            }
        })?;
        // SAFETY: the caller has checked the memory; an estimator holds no pointer into itself.
        unsafe { place.cast::<u8>().copy_to_nonoverlapping(head.cast(), kind.size) };
        Ok(())
    }
}

impl Whole {
    /// That of `E`.
    pub(crate) const fn of<E: Saves>() -> Self {
        let update_after = update_whole_after::<E>;
        Self { save: save_whole::<E>, load: load_whole::<E>, update_after }
    }
}

impl Saving {
    /// Gives the bytes of the estimator at `head` to `put`.
    ///
    /// # Safety
    /// It is one of this kind.
    pub(crate) unsafe fn save(&self, head: *mut Head, put: &mut Put<'_>) -> Outcome {
        // SAFETY: as above.
        unsafe {
            match self {
                Self::F32(view) => save(&mut *(view.at)(head), view.rule, put)?,
                Self::F64(view) => save(&mut *(view.at)(head), view.rule, put)?,
                Self::Whole(whole) => return (whole.save)(head, put),
            };
        }
        Ok(())
    }

    /// Puts the estimator that was saved as `bytes` where `head` is.
    ///
    /// # Safety
    /// There is memory for one of this kind.
    pub(crate) unsafe fn load(
        &self,
        head: *mut Head,
        kind: &'static Kind,
        bytes: &[u8],
    ) -> Outcome {
        // SAFETY: as above.
        unsafe {
            match self {
                Self::F32(view) => view.load(head, kind, bytes),
                Self::F64(view) => view.load(head, kind, bytes),
                Self::Whole(whole) => (whole.load)(head, kind, bytes),
            }
        }
    }
}

unsafe fn make<E: Compact>(
    head: *mut Head,
    kind: &'static Kind,
    values: &dyn Values,
    lambda: E::Real,
) -> Result<(), Error> {
    let estimator = E::of_values(values, lambda)?;
    // SAFETY: the caller has memory for it.
    unsafe { put(head, kind, estimator) };
    Ok(())
}

unsafe fn look_at<E: Compact>(head: *mut Head) -> *mut dyn Saved<E::Real> {
    // SAFETY: the caller says that there is one.
    unsafe { at::<E>(head) }.saved()
}

unsafe fn pace<E: Compact>(head: *mut Head) -> Pace<E::Real> {
    // SAFETY: the caller says that there is one.
    unsafe { at::<E>(head) }.pace()
}

unsafe fn update_whole_after<E: Saves>(
    head: *mut Head,
    elapsed: *const u8,
    phi: *const u8,
    y: *const u8,
    gamma: *const u8,
    report: *mut u8,
) -> Outcome {
    // SAFETY: its kind says so, and the caller has checked the pointers.
    unsafe {
        let estimator = at::<E>(head);
        let phi = from_raw_parts(phi.cast::<E::Real>(), estimator.parameters());
        let number = |place: *const u8| place.cast::<E::Real>().read();
        let gamma = gamma.cast::<E::Real>().as_ref().copied();
        let outcome = estimator.update_after(number(elapsed), phi, number(y), gamma)?;
        if !report.is_null() {
            report.cast::<Report<E::Real>>().write(outcome);
        }
    }
    Ok(())
}

unsafe fn save_whole<E: Saves>(head: *mut Head, put: &mut Put<'_>) -> Outcome {
    // SAFETY: its kind says so.
    unsafe { at::<E>(head) }.save(put)
}

unsafe fn load_whole<E: Saves>(head: *mut Head, kind: &'static Kind, bytes: &[u8]) -> Outcome {
    let estimator = E::load(bytes)?;
    // SAFETY: the caller has checked the memory.
    unsafe { put(head, kind, estimator) };
    Ok(())
}
