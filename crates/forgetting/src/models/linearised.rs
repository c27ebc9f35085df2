//! What a sample is to an estimator.

/// A sample as it is made linear in θ: the estimator takes (scale ψ, scale (y + shift)), of ψ the places
/// that are estimated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Linearised {
    /// φθ: the prediction of y
    pub prediction: f64,
    /// ψ(θ − θ₀) − φθ, where θ₀ is what is known of θ before the first sample: 0 where nothing is
    pub shift: f64,
    /// the root of how far the sample is trusted: small at first, while θ is far from where it ends, then 1
    pub scale: f64,
    /// whether all that stands in φ was measured: if not, the estimator must not take the sample
    pub complete: bool,
}
