//! Number types that let the crate `forgetting` use the vector instructions of the machine.
//!
//! [`Fused<f64>`] and [`Fused<f32>`] are `f64` and `f32` whose `mul_add` rounds once, as the
//! fused multiply-add of the hardware does. The loops over many numbers run with AVX-512, or
//! AVX2 and FMA, or NEON, found out once at the start: [`level`]. Their results are the same bits
//! on all of these. A machine without fused multiply-add cannot run them: use plain `f64` and `f32`
//! there.

mod fused;
mod level;
#[cfg(target_arch = "x86_64")]
mod x86;

pub use fused::Fused;
// for the macros
#[doc(hidden)]
pub use bytemuck::TransparentWrapper;
#[doc(hidden)]
pub use forgetting_kernels::compile_kernels;
#[doc(hidden)]
pub use forgetting_kernels::number::lanes::Lanes;
#[doc(hidden)]
pub use forgetting_kernels::number::{copy_some, Real};
pub use level::{level, Level, VARIABLE};

/// The example of the README.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;
