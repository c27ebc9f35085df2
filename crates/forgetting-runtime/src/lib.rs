//! The run time under every interface: estimators and fleets whose types are chosen while the
//! program runs.
//!
//! An interface (Python, C, a web page) passes slices of numbers, names and values, and gets back
//! arrays, names and values: no type parameter is left. The number type, the rule, the rate, the
//! weighting and the gate of an [`Estimator`] or a [`Fleet`] are made by name from [`Settings`];
//! records, missing samples, threads and saved states are handled here, and every refusal is an
//! [`Error`] whose text is the same in all languages. Whatever was refused has changed nothing.
//!
//! ```
//! use forgetting_runtime::{Choice, Estimator, Settings};
//!
//! let rule = Choice::named("subspace").with("threshold", 1e-3);
//! let mut estimator = Estimator::new(&Settings { rule: Some(rule), ..Settings::new(2) })?;
//! for k in 0..100 {
//!     let phi = [1.0, f64::from(k % 7)];
//!     let update = estimator.update(phi[..].into(), [3.0 + 0.5 * phi[1]][..].into(), None)?;
//!     assert!(update.skipped.is_none());
//! }
//! let theta = estimator.theta();
//! assert_eq!(theta.shape, [2]);
//! assert!((theta.elements.to_f64()[0] - 3.0).abs() < 1e-3);
//! # Ok::<(), forgetting_runtime::Error>(())
//! ```
#![forbid(unsafe_code)]

mod bank;
mod bounds;
mod choice;
mod configure;
mod error;
mod estimator;
mod fleet;
mod function;
mod missing;
mod model;
mod number;
mod settings;
mod shape;
mod update;
mod window;

pub use bank::{Bank, BankSettings, BankUpdate, Member, BANK_OUTPUTS};
pub use bounds::{covariance_bounds, CovarianceBounds};
pub use choice::{Choice, Description, Value};
pub use error::{check_shape, Error, Kind};
pub use estimator::{Bounds, Estimator, GoOn, Health, Run, RunOptions};
pub use fleet::{Fleet, FleetUpdate, Stream, StreamHealth};
pub use forgetting::choice::function::Argument;
pub use forgetting::models::{Given, InputOrders, Orders, Structure, STRUCTURES};
pub use forgetting::{bounded, Intervals};
pub use forgetting::{Answer, Error as CoreError, Skip};
pub use function::{Evidence, Function};
pub use missing::Missing;
pub use model::{Learner, Model, MODEL_OUTPUTS};
pub use number::{Array, Elements, NumberType, Numbers, View};
pub use settings::{size, threads, ForgettingFactor, Settings};
pub use update::{Innovation, Update, UpdateOptions};
pub use window::InformationWindow;

/// The example of the README.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;
