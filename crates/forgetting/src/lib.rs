//! Recursive least squares with generalized forgetting.
//!
//! An [`Estimator`] follows the parameters θ of y = φθ + noise, sample by sample. It combines
//! three independent choices: *where* to forget (a rule, [`rules`]), *how much* (a rate,
//! [`rates`]) and *how far to trust* a sample (a [`weighting`] and the noise covariance Γ). A gate
//! ([`gates`]) may be set before them, to say *whether* a sample is used.
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

mod between;
mod blocks;
pub mod covariance;
pub mod criterion;
mod directions;
mod error;
mod estimator;
mod evidence;
#[cfg(feature = "alloc")]
mod excitation;
#[cfg(feature = "alloc")]
pub mod fleet;
#[cfg(feature = "alloc")]
pub mod function;
pub mod gates;
mod innovation;
mod intake;
mod measure;
mod memory;
pub mod monitor;
pub mod parameter;
mod range;
pub mod rates;
pub mod rules;
mod sample;
#[cfg(feature = "alloc")]
pub mod saved;
pub mod state;
#[cfg(test)]
mod testing;
mod update;
pub mod weighting;
mod work;

pub use blocks::Blocks;
pub use covariance::{Factor, Prior};
pub use error::Error;
pub use estimator::Estimator;
pub use evidence::{Evidence, Needs};
#[cfg(feature = "alloc")]
pub use excitation::Excitation;
pub use forgetting_kernels::kernel::outcome::Outcome;
pub use forgetting_kernels::{Kernels, Real};
pub use intake::Noise;
#[cfg(feature = "alloc")]
pub use memory::{Aligned, Dynamic};
pub use memory::{Buffer, Fixed, Grid, Memory, Packed, Size};
pub use monitor::Health;
pub use rates::{Constant, Rate};
pub use rules::{Exponential, ExponentialResetting, Forgetting, NoForgetting, Skip, Subspace};
pub use sample::Sample;
pub use update::Update;
pub use weighting::{Equal, Weighting};
pub use work::Work;
