//! The C library of `forgetting`. `include/forgetting.h` says what each function does; this crate
//! converts and adds nothing.
//!
//! No standard library and no allocator: an estimator lives in memory of the caller's. A [kind](kind)
//! is a table of functions for one type of estimator. A program that names one links that one and no
//! other.
#![no_std]
#![cfg_attr(not(feature = "general"), allow(dead_code, reason = "for general kinds"))]

mod api;
mod code;
mod kind;
mod kinds;
mod model;
mod number;
mod report;
mod settings;

pub use api::*;
pub use code::{Code, Text, Why};
pub use kind::Kind;
pub use kinds::*;
pub use number::Number;
pub use report::{Health, Report};
pub use settings::{Choice, Parameter, Settings};

/// No function of a compact estimator can come here: a test looks for it. The code of the general ones
/// holds checks that the compiler could not remove; if one of them ever failed, this would be a
/// mistake in this library, and going on would be worse than to stop.
#[cfg(feature = "library")]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    extern "C" {
        fn abort() -> !;
    }
    // SAFETY: it takes nothing and does not return.
    unsafe { abort() }
}
