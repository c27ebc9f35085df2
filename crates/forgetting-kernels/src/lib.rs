//! The loops over P = U D Uᵀ that an update of recursive least squares consists of.
//!
//! [`number`] says what the loops compute with: a number ([`Real`]), neighbouring numbers in the
//! registers of a machine ([`Vector`](number::vector::Vector)), a number of each of several streams
//! ([`Lane`](number::lane::Lane)). [`kernel`] holds the loops, each written once over those. They
//! see slices and numbers only: no estimator, no rule, no fleet.
//!
//! A number type compiles all of them in the crate that defines it ([`compile_kernels`]), and other
//! crates call them as plain functions ([`Kernels`]). Here that is done for `f64` and `f32` with
//! the instructions of the compiler's target.
//!
//! No standard library, no allocation, no `unsafe`.
#![no_std]
#![forbid(unsafe_code)]
#![allow(
    clippy::needless_range_loop,
    clippy::manual_memcpy,
    reason = "what an iterator or a copy calls may not be compiled for the vectors"
)]

#[cfg(test)]
extern crate std;

#[macro_use]
pub mod kernel;
pub mod number;

pub use kernel::{Dispatch, Kernel, Kernels};
pub use number::Real;

/// The example of the README.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;
