//! A type of estimator as a table of functions, so that C needs to know no type.

mod after;
mod bounds;
mod saving;

pub(crate) use after::update_after;
pub(crate) use bounds::bounded;
pub use saving::{Saving, View, Whole};

use crate::code::{Code, Why};
use crate::model::Model;
use crate::number::Number;
use crate::report::{Health, Report};
use crate::settings::Settings;
use core::mem::{align_of, size_of};
use core::ptr::NonNull;
use core::slice::{from_raw_parts, from_raw_parts_mut};
use forgetting::compact::Given;

/// Says that memory holds an estimator.
const MARK: u32 = 0x4647_524C;

/// What the memory of the caller's begins with.
#[repr(C)]
#[derive(Debug)]
pub struct Head {
    kind: *const Kind,
    mark: u32,
    parameters: u32,
}

/// An estimator in the memory of the caller's.
#[repr(C)]
struct Held<E> {
    head: Head,
    estimator: E,
}

pub(crate) type Outcome = Result<(), Why>;

/// The functions of a type of estimator. Numbers are those of [`Kind::number`].
#[derive(Debug)]
pub struct Kind {
    /// the type of the numbers
    pub number: Number,
    /// bytes that an estimator takes
    pub size: usize,
    /// its address is a multiple of this, a power of two
    pub alignment: usize,
    /// the least and the most parameters
    pub parameters: (usize, usize),
    pub(crate) init: unsafe fn(*mut Head, &'static Kind, &Settings) -> Outcome,
    pub(crate) saving: Saving,
    pub(crate) reset: unsafe fn(*mut Head),
    pub(crate) samples: unsafe fn(*mut Head) -> u64,
    pub(crate) health: unsafe fn(*mut Head) -> Option<Health>,
    /// φ, y, where to write the report, and null or what is given of a whitened sample
    pub(crate) update: unsafe fn(*mut Head, *const u8, *const u8, *mut u8, *const u8) -> Outcome,
    /// φ, and where to write φθ
    pub(crate) predict: unsafe fn(*mut Head, *const u8, *mut u8),
    /// where to write n numbers
    pub(crate) theta: unsafe fn(*mut Head, *mut u8),
    /// θ, n numbers
    pub(crate) set_theta: unsafe fn(*mut Head, *const u8) -> Outcome,
    /// where to write n x n numbers
    pub(crate) covariance: unsafe fn(*mut Head, *mut u8),
    /// where to write a number for each member of a bank, and for how many there is room
    pub(crate) weights: unsafe fn(*mut Head, *mut u8, usize) -> Result<(), Code>,
}

impl Kind {
    /// The kind of `E`, saved so.
    pub(crate) const fn of<E: Model>(saving: Saving) -> Self {
        Self {
            number: E::NUMBER,
            size: size_of::<Held<E>>(),
            alignment: align_of::<Held<E>>(),
            parameters: E::PARAMETERS,
            init: init::<E>,
            saving,
            reset: reset::<E>,
            samples: samples::<E>,
            health: health::<E>,
            update: update::<E>,
            predict: predict::<E>,
            theta: theta::<E>,
            set_theta: set_theta::<E>,
            covariance: covariance::<E>,
            weights: weights::<E>,
        }
    }

    /// Whether this memory can hold an estimator.
    ///
    /// # Errors
    /// What is wrong with it.
    pub(crate) fn check_memory(&self, memory: *mut u8, size: usize) -> Result<(), Code> {
        if memory.is_null() {
            Err(Code::Null)
        } else if size < self.size {
            Err(Code::Memory)
        } else if memory as usize & self.alignment.wrapping_sub(1) != 0 {
            Err(Code::Alignment)
        } else {
            Ok(())
        }
    }
}

impl Head {
    /// The kind of the estimator here.
    ///
    /// # Errors
    /// [`Code::Null`], [`Code::NotAnEstimator`].
    ///
    /// # Safety
    /// `head` is null or points to memory that can be read as a head.
    pub(crate) unsafe fn kind(head: *const Self) -> Result<&'static Kind, Code> {
        let aligned = head as usize & (align_of::<Self>() - 1) == 0;
        let head = NonNull::new(head.cast_mut()).ok_or(Code::Null)?;
        if !aligned {
            return Err(Code::Alignment);
        }
        // SAFETY: as above.
        let head = unsafe { head.as_ref() };
        if head.mark != MARK {
            return Err(Code::NotAnEstimator);
        }
        // SAFETY: where there is the mark, there is the kind.
        unsafe { head.kind.as_ref() }.ok_or(Code::NotAnEstimator)
    }

    /// n
    ///
    /// # Safety
    /// `head` is that of an estimator.
    pub(crate) unsafe fn parameters(head: *const Self) -> usize {
        // SAFETY: as above.
        unsafe { (*head).parameters as usize }
    }
}

/// Puts an estimator where `head` is.
///
/// # Safety
/// There is memory for it.
pub(crate) unsafe fn put<E: Model>(head: *mut Head, kind: &'static Kind, estimator: E) {
    let head_of = Head { kind, mark: MARK, parameters: estimator.parameters() as u32 };
    // SAFETY: as above.
    unsafe { head.cast::<Held<E>>().write(Held { head: head_of, estimator }) }
}

unsafe fn init<E: Model>(head: *mut Head, kind: &'static Kind, settings: &Settings) -> Outcome {
    let estimator = E::make(settings)?;
    // SAFETY: the caller has checked the memory.
    unsafe { put(head, kind, estimator) };
    Ok(())
}

/// The estimator at `head`.
///
/// # Safety
/// There is one, of this type, and nobody else uses it now.
pub(crate) unsafe fn at<'a, E: Model>(head: *mut Head) -> &'a mut E {
    // SAFETY: as above.
    unsafe { &mut (*head.cast::<Held<E>>()).estimator }
}

unsafe fn reset<E: Model>(head: *mut Head) {
    // SAFETY: its kind says so.
    unsafe { at::<E>(head) }.reset();
}

unsafe fn samples<E: Model>(head: *mut Head) -> u64 {
    // SAFETY: its kind says so.
    unsafe { at::<E>(head) }.samples()
}

unsafe fn health<E: Model>(head: *mut Head) -> Option<Health> {
    // SAFETY: its kind says so.
    unsafe { at::<E>(head) }.health()
}

unsafe fn update<E: Model>(
    head: *mut Head,
    phi: *const u8,
    y: *const u8,
    report: *mut u8,
    given: *const u8,
) -> Outcome {
    // SAFETY: its kind says so, and the caller has checked the pointers.
    unsafe {
        let estimator = at::<E>(head);
        let phi = from_raw_parts(phi.cast::<E::Real>(), estimator.parameters());
        let given = given.cast::<Given<E::Real>>().as_ref();
        let outcome = estimator.update(phi, y.cast::<E::Real>().read(), given)?;
        if !report.is_null() {
            report.cast::<Report<E::Real>>().write(outcome);
        }
    }
    Ok(())
}

unsafe fn predict<E: Model>(head: *mut Head, phi: *const u8, prediction: *mut u8) {
    // SAFETY: its kind says so, and the caller has checked the pointers.
    unsafe {
        let estimator = at::<E>(head);
        let phi = from_raw_parts(phi.cast::<E::Real>(), estimator.parameters());
        prediction.cast::<E::Real>().write(estimator.predict(phi));
    }
}

unsafe fn theta<E: Model>(head: *mut Head, theta: *mut u8) {
    // SAFETY: its kind says so, and the caller has checked the pointers.
    unsafe {
        let own = at::<E>(head).theta();
        theta.cast::<E::Real>().copy_from_nonoverlapping(own.as_ptr(), own.len());
    }
}

unsafe fn set_theta<E: Model>(head: *mut Head, theta: *const u8) -> Outcome {
    // SAFETY: its kind says so, and the caller has checked the pointers.
    unsafe {
        let estimator = at::<E>(head);
        estimator.set_theta(from_raw_parts(theta.cast::<E::Real>(), estimator.parameters()))
    }
}

unsafe fn covariance<E: Model>(head: *mut Head, covariance: *mut u8) {
    // SAFETY: its kind says so, and the caller has checked the pointers.
    unsafe {
        let estimator = at::<E>(head);
        let n = estimator.parameters();
        estimator.covariance(from_raw_parts_mut(covariance.cast::<E::Real>(), n * n));
    }
}

unsafe fn weights<E: Model>(head: *mut Head, weights: *mut u8, members: usize) -> Result<(), Code> {
    // SAFETY: its kind says so, and the caller has checked the pointers.
    unsafe {
        let own = at::<E>(head).weights();
        if own.is_empty() {
            return Err(Code::Unsupported);
        }
        if own.len() != members {
            return Err(Code::Length);
        }
        weights.cast::<E::Real>().copy_from_nonoverlapping(own.as_ptr(), members);
    }
    Ok(())
}
