//! The functions that take numbers, once for each type of them.

use super::{code, Estimator};
use crate::code::Code;
use crate::kind::{bounded, update_after, Head, Kind};
use crate::number::Number;
use crate::report::Report;
use core::ptr::null;
use core::slice::{from_raw_parts, from_raw_parts_mut};

/// The kind of an estimator that computes with `number`, if `pointers` are not null.
///
/// # Safety
/// `estimator` is null or points to memory for one.
unsafe fn of_number(
    estimator: *mut Estimator,
    number: Number,
    pointers: &[bool],
) -> Result<&'static Kind, Code> {
    // SAFETY: as above.
    let kind = unsafe { Head::kind(estimator)? };
    if pointers.iter().any(|null| *null) {
        Err(Code::Null)
    } else if kind.number != number {
        Err(Code::NumberType)
    } else {
        Ok(kind)
    }
}

/// The same of an estimator of n parameters.
///
/// # Safety
/// `estimator` is null or points to memory for one.
unsafe fn checked(
    estimator: *mut Estimator,
    number: Number,
    n: usize,
    pointers: &[bool],
) -> Result<&'static Kind, Code> {
    // SAFETY: as above.
    let kind = unsafe { of_number(estimator, number, pointers)? };
    // SAFETY: it has a kind.
    if unsafe { Head::parameters(estimator) } == n {
        Ok(kind)
    } else {
        Err(Code::Length)
    }
}

macro_rules! typed {
    ($T:ty, $number:expr, $update:ident, $update_after:ident, $predict:ident, $theta:ident,
     $set_theta:ident, $bounded:ident, $covariance:ident, $weights:ident) => {
        /// Takes a sample.
        ///
        /// # Safety
        /// Each pointer is null or points to what it says.
        #[no_mangle]
        pub unsafe extern "C" fn $update(
            estimator: *mut Estimator,
            phi: *const $T,
            n: usize,
            y: $T,
            report: *mut Report<$T>,
        ) -> i32 {
            // SAFETY: as above.
            unsafe {
                match checked(estimator, $number, n, &[phi.is_null()]) {
                    Err(code) => code as i32,
                    Ok(kind) => {
                        let y = (&raw const y).cast();
                        (kind.update)(estimator, phi.cast(), y, report.cast(), null())
                            .map_or_else(|why| why.code, |()| 0)
                    }
                }
            }
        }

        /// Takes a sample after a time, or with a variance of its noise.
        ///
        /// # Safety
        /// Each pointer is null or points to what it says.
        #[no_mangle]
        pub unsafe extern "C" fn $update_after(
            estimator: *mut Estimator,
            elapsed: $T,
            phi: *const $T,
            n: usize,
            y: $T,
            gamma: *const $T,
            report: *mut Report<$T>,
        ) -> i32 {
            // SAFETY: as above.
            unsafe {
                match checked(estimator, $number, n, &[phi.is_null()]) {
                    Err(code) => code as i32,
                    Ok(kind) => {
                        let phi = from_raw_parts(phi, n);
                        update_after((kind, estimator), elapsed, (phi, y), gamma, report)
                            .map_or_else(|why| why.code, |()| 0)
                    }
                }
            }
        }

        /// φθ
        ///
        /// # Safety
        /// Each pointer is null or points to what it says.
        #[no_mangle]
        pub unsafe extern "C" fn $predict(
            estimator: *mut Estimator,
            phi: *const $T,
            n: usize,
            prediction: *mut $T,
        ) -> i32 {
            // SAFETY: as above.
            unsafe {
                let pointers = [phi.is_null(), prediction.is_null()];
                code(checked(estimator, $number, n, &pointers).map(|kind| {
                    (kind.predict)(estimator, phi.cast(), prediction.cast());
                }))
            }
        }

        /// θ
        ///
        /// # Safety
        /// Each pointer is null or points to what it says.
        #[no_mangle]
        pub unsafe extern "C" fn $theta(
            estimator: *mut Estimator,
            theta: *mut $T,
            n: usize,
        ) -> i32 {
            // SAFETY: as above.
            unsafe {
                code(checked(estimator, $number, n, &[theta.is_null()]).map(|kind| {
                    (kind.theta)(estimator, theta.cast());
                }))
            }
        }

        /// Goes on from this θ.
        ///
        /// # Safety
        /// Each pointer is null or points to what it says.
        #[no_mangle]
        pub unsafe extern "C" fn $set_theta(
            estimator: *mut Estimator,
            theta: *const $T,
            n: usize,
        ) -> i32 {
            // SAFETY: as above.
            unsafe {
                match checked(estimator, $number, n, &[theta.is_null()]) {
                    Err(code) => code as i32,
                    Ok(kind) => (kind.set_theta)(estimator, theta.cast())
                        .map_or_else(|why| why.code, |()| 0),
                }
            }
        }

        /// θ within bounds.
        ///
        /// # Safety
        /// Each pointer is null or points to what it says.
        #[no_mangle]
        pub unsafe extern "C" fn $bounded(
            estimator: *mut Estimator,
            lower: *const $T,
            upper: *const $T,
            n: usize,
            theta: *mut $T,
        ) -> i32 {
            // SAFETY: as above.
            unsafe {
                match checked(estimator, $number, n, &[theta.is_null()]) {
                    Err(code) => code as i32,
                    Ok(kind) => {
                        let theta = from_raw_parts_mut(theta, n);
                        bounded(kind, estimator, (lower, upper), theta)
                            .map_or_else(|why| why.code, |()| 0)
                    }
                }
            }
        }

        /// P
        ///
        /// # Safety
        /// Each pointer is null or points to what it says.
        #[no_mangle]
        pub unsafe extern "C" fn $covariance(
            estimator: *mut Estimator,
            covariance: *mut $T,
            n: usize,
        ) -> i32 {
            // SAFETY: as above.
            unsafe {
                code(checked(estimator, $number, n, &[covariance.is_null()]).map(|kind| {
                    (kind.covariance)(estimator, covariance.cast());
                }))
            }
        }

        /// How far each member of a bank is believed.
        ///
        /// # Safety
        /// Each pointer is null or points to what it says.
        #[no_mangle]
        pub unsafe extern "C" fn $weights(
            estimator: *mut Estimator,
            weights: *mut $T,
            members: usize,
        ) -> i32 {
            // SAFETY: as above.
            unsafe {
                code(
                    of_number(estimator, $number, &[weights.is_null()])
                        .and_then(|kind| (kind.weights)(estimator, weights.cast(), members)),
                )
            }
        }
    };
}
typed!(
    f32,
    Number::F32,
    fg_update_f32,
    fg_update_after_f32,
    fg_predict_f32,
    fg_theta_f32,
    fg_set_theta_f32,
    fg_bounded_f32,
    fg_covariance_f32,
    fg_weights_f32
);
typed!(
    f64,
    Number::F64,
    fg_update_f64,
    fg_update_after_f64,
    fg_predict_f64,
    fg_theta_f64,
    fg_set_theta_f64,
    fg_bounded_f64,
    fg_covariance_f64,
    fg_weights_f64
);
