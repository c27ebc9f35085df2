//! The functions that C calls. Each checks its pointers and asks the kind of the estimator.

mod typed;

use crate::code::{Code, Why};
use crate::kind::{Head, Kind};
use crate::report::Health;
use crate::settings::Settings;
use core::ffi::c_char;
use core::slice::from_raw_parts;
pub use typed::*;

/// The version of the interface: it changes when a program must be compiled again.
const ABI_VERSION: u32 = 1;

/// An estimator: the memory that [`fg_init`] was given.
pub type Estimator = Head;

fn code(outcome: Result<(), Code>) -> i32 {
    outcome.err().unwrap_or(Code::Ok) as i32
}

/// Returns the code, and tells `why`, if that is asked for.
///
/// # Safety
/// `why` is null or can be written to.
unsafe fn told(outcome: Result<(), Why>, why: *mut Why) -> i32 {
    let told = outcome.err().unwrap_or(Code::Ok.into());
    if !why.is_null() {
        // SAFETY: as above.
        unsafe { why.write(told) };
    }
    told.code
}

/// The version of the interface.
#[no_mangle]
pub extern "C" fn fg_abi_version() -> u32 {
    ABI_VERSION
}

/// A code in words.
#[no_mangle]
pub extern "C" fn fg_strerror(code: i32) -> *const c_char {
    Code::words(code).as_ptr()
}

/// The bytes that an estimator of this kind takes; 0 for null.
///
/// # Safety
/// `kind` is null or one of the library's.
#[no_mangle]
pub unsafe extern "C" fn fg_size(kind: *const Kind) -> usize {
    // SAFETY: as above.
    unsafe { kind.as_ref() }.map_or(0, |kind| kind.size)
}

/// What the address of its memory is a multiple of; 0 for null.
///
/// # Safety
/// `kind` is null or one of the library's.
#[no_mangle]
pub unsafe extern "C" fn fg_alignment(kind: *const Kind) -> usize {
    // SAFETY: as above.
    unsafe { kind.as_ref() }.map_or(0, |kind| kind.alignment)
}

/// Makes an estimator in `memory`.
///
/// # Safety
/// Each pointer is null or points to what it says.
#[no_mangle]
pub unsafe extern "C" fn fg_init(
    memory: *mut u8,
    size: usize,
    kind: *const Kind,
    settings: *const Settings,
    estimator: *mut *mut Estimator,
    why: *mut Why,
) -> i32 {
    // SAFETY: as above.
    unsafe {
        let make = || {
            let kind = kind.as_ref().ok_or(Code::Null)?;
            let settings = settings.as_ref().ok_or(Code::Null)?;
            kind.check_memory(memory, size)?;
            let (least, most) = kind.parameters;
            if !(least..=most).contains(&settings.parameters) {
                let allowed = "as many as the kind is for";
                let value = settings.parameters as f64;
                return Err(forgetting::Error::value("parameters", value, allowed).into());
            }
            (kind.init)(memory.cast(), kind, settings)?;
            give(memory, estimator);
            Ok(())
        };
        told(make(), why)
    }
}

/// Makes the estimator in `memory` that was saved as `length` bytes.
///
/// # Safety
/// Each pointer is null or points to what it says.
#[no_mangle]
pub unsafe extern "C" fn fg_load(
    memory: *mut u8,
    size: usize,
    kind: *const Kind,
    bytes: *const u8,
    length: usize,
    estimator: *mut *mut Estimator,
    why: *mut Why,
) -> i32 {
    // SAFETY: as above.
    unsafe {
        let make = || {
            let kind = kind.as_ref().ok_or(Code::Null)?;
            if bytes.is_null() {
                return Err(Code::Null.into());
            }
            kind.check_memory(memory, size)?;
            let bytes = from_raw_parts(bytes, length);
            kind.saving.load(memory.cast(), kind, bytes)?;
            give(memory, estimator);
            Ok(())
        };
        told(make(), why)
    }
}

/// # Safety
/// `estimator` is null or can be written to.
unsafe fn give(memory: *mut u8, estimator: *mut *mut Estimator) {
    if !estimator.is_null() {
        // SAFETY: as above.
        unsafe { estimator.write(memory.cast()) };
    }
}

/// Saves an estimator.
///
/// # Safety
/// Each pointer is null or points to what it says.
#[no_mangle]
pub unsafe extern "C" fn fg_save(
    estimator: *mut Estimator,
    bytes: *mut u8,
    capacity: usize,
    length: *mut usize,
) -> i32 {
    // SAFETY: as above.
    unsafe {
        let kind = match Head::kind(estimator) {
            Ok(kind) => kind,
            Err(code) => return code as i32,
        };
        if length.is_null() {
            return Code::Null as i32;
        }
        let mut needed = 0;
        if let Err(why) = kind.saving.save(estimator, &mut |piece| needed += piece.len()) {
            return why.code;
        }
        length.write(needed);
        if bytes.is_null() {
            return Code::Ok as i32;
        }
        if capacity < needed {
            return Code::Memory as i32;
        }
        let mut place = bytes;
        let saved = kind.saving.save(estimator, &mut |piece| {
            place.copy_from_nonoverlapping(piece.as_ptr(), piece.len());
            place = place.add(piece.len());
        });
        saved.map_or_else(|why| why.code, |()| Code::Ok as i32)
    }
}

/// Back to the prior.
///
/// # Safety
/// `estimator` is null or points to memory for one.
#[no_mangle]
pub unsafe extern "C" fn fg_reset(estimator: *mut Estimator) -> i32 {
    // SAFETY: as above.
    unsafe { code(Head::kind(estimator).map(|kind| (kind.reset)(estimator))) }
}

/// Samples used so far; 0 if there is no estimator.
///
/// # Safety
/// `estimator` is null or points to memory for one.
#[no_mangle]
pub unsafe extern "C" fn fg_samples(estimator: *mut Estimator) -> u64 {
    // SAFETY: as above.
    unsafe { Head::kind(estimator).map_or(0, |kind| (kind.samples)(estimator)) }
}

/// What the monitor has found.
///
/// # Safety
/// Each pointer is null or points to what it says.
#[no_mangle]
pub unsafe extern "C" fn fg_health(estimator: *mut Estimator, health: *mut Health) -> i32 {
    // SAFETY: as above.
    unsafe {
        let kind = match Head::kind(estimator) {
            Ok(kind) if !health.is_null() => kind,
            Ok(_) => return Code::Null as i32,
            Err(code) => return code as i32,
        };
        match (kind.health)(estimator) {
            Some(found) => {
                health.write(found);
                Code::Ok as i32
            }
            None => Code::Unsupported as i32,
        }
    }
}
