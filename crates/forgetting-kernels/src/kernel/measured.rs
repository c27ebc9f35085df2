//! What one scalar measurement with unit variance brings.

/// What one scalar measurement with unit variance brings.
#[derive(Clone, Copy, Debug, Default)]
pub struct Measured<T> {
    /// s = f·P·fᵀ, with the P of before
    pub leverage: T,
    /// a = 1 + s
    pub variance: T,
    /// 1 / a
    pub inverse_variance: T,
    /// the largest element of D after it
    pub largest: T,
    /// whether anything was forgotten on the way
    pub forgot: bool,
}
