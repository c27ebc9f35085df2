//! Recursive least squares with generalized forgetting, for JavaScript: the module `forgetting`.
//!
//! Conversion only: JavaScript's numbers, arrays and objects become what `forgetting-runtime`
//! takes, and its answers become numbers, typed arrays and objects. Names are those of Python,
//! in settings, outputs and errors alike.
#![forbid(unsafe_code)]

mod array;
mod bank;
mod choice;
mod error;
mod health;
mod object;
mod record;
mod registry;
mod rls;
mod settings;
mod types;
mod update;
