//! Models whose regressor needs what the model itself has made of earlier samples: of noise that is not
//! white, or of an output without its noise.
//!
//! All of them are one form (Ljung 1999, System Identification, equation (4.33)),
//!
//! A(q) y(k) = Σᵢ Bᵢ(q)/Fᵢ(q) uᵢ(k) + C(q)/D(q) e(k) + constant,
//!
//! and differ in which polynomials they have, see [`STRUCTURES`]. [`Polynomial`] makes of each sample
//! a regressor ψ and a number z = y − φθ + ψθ; the pair (ψ, z) is what any estimator takes, so that
//! all rules, rates, weightings, gates and banks serve.

mod history;
mod known;
mod linearised;
mod orders;
mod origin;
mod polynomial;
mod regressor;
mod signals;
mod stable;
mod structure;

pub use known::Given;
pub use linearised::Linearised;
pub use orders::{InputOrders, Orders};
pub use polynomial::{Method, Polynomial};
pub use structure::{Structure, STRUCTURES};
