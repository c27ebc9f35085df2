//! A stream of a fleet is the estimator: bit for bit up to ten parameters, to rounding above.

mod beside;
mod following;
mod given;
mod parts;
mod range;
mod refused;
mod size;
