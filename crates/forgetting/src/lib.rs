//! Recursive least squares with generalized forgetting.
//!
//! An [`Estimator`] follows the parameters θ of y = φθ + noise, sample by sample. It combines
//! four independent choices: *where* to forget (a rule, [`rules`]), *how much* (a rate,
//! [`rates`]), *how far to trust* a sample (a weighting, [`weightings`], and the noise covariance
//! Γ), and *whether* to use it (a gate, [`gates`]). [`AXES`] lists them.
//!
//! The covariance is kept as U D Uᵀ and nothing is ever subtracted from it, so that it stays
//! positive definite for any input, in `f32` too. A sample that cannot be used is refused with
//! an error and leaves every bit of the estimator as it was.
//!
//! No standard library, no `unsafe`, no allocation in an update. Without the feature `alloc`
//! (on by default) there is no allocation at all, and sizes are fixed ([`Fixed`]).
#![no_std]
#![forbid(unsafe_code)]

#[cfg(feature = "alloc")]
extern crate alloc;
#[cfg(test)]
extern crate std;

pub mod bank;
pub mod choice;
pub mod compact;
pub mod covariance;
pub mod defaults;
mod error;
mod estimator;
#[cfg(feature = "alloc")]
pub mod fleet;
pub mod gates;
mod intervals;
pub mod memory;
pub mod mixers;
#[cfg(feature = "alloc")]
pub mod models;
pub mod monitor;
pub mod rates;
pub mod rules;
mod sample;
pub mod saved;

/// The example of the README.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;

#[cfg(test)]
mod testing;
mod units;
pub mod weightings;

pub use compact::Compact;
#[cfg(feature = "alloc")]
pub use covariance::bounded;
pub use covariance::{bounded_in, bounded_room, Factor, Prior, DIFFUSE};
pub use error::Error;
#[cfg(feature = "alloc")]
pub use estimator::AnyEstimator;
pub use estimator::{Estimator, Named};
pub use forgetting_kernels::kernel::outcome::Outcome;
pub use forgetting_kernels::{Kernels, Real};
pub use intervals::Intervals;
#[cfg(feature = "alloc")]
pub use memory::{Aligned, Dynamic};
pub use memory::{Buffer, Fixed, Grid, Memory, Packed, Size, UpTo};
pub use monitor::Health;
#[cfg(feature = "alloc")]
pub use monitor::InformationWindow;
pub use rates::{Constant, Rate};
pub use rules::{Blocks, Exponential, ExponentialResetting, Forgetting, NoForgetting, Subspace};
pub use sample::{Answer, Evidence, Needs, Noise, Sample, Skip, Update, Work};
pub use weightings::{Equal, Weighting};

/// The choices that make an estimator, each with its registry: what an axis adds to every face
/// and to the documentation follows from its line here.
pub const AXES: &[choice::Axis] =
    &[rules::AXIS, rates::AXIS, weightings::AXIS, gates::AXIS, mixers::AXIS];
