//! What became of a sample of one row and one target.

use crate::kernel::measured::Measured;
use crate::number::Real;

/// What became of a sample of one row and one target.
#[derive(Clone, Copy, Debug, Default)]
pub struct Outcome<T> {
    /// y − φθ with the θ of before
    pub error: T,
    /// φP̄φᵀ
    pub leverage: T,
    /// the largest element of D after it
    pub largest: T,
    /// whether anything was forgotten
    pub forgot: bool,
    /// whether it was learned from; if not, it was in the dead zone
    pub used: bool,
    /// whether the monitor, if there is one, says that P has wound up
    pub windup: bool,
}

impl<T: Real> Outcome<T> {
    /// A sample that was used.
    #[inline(always)]
    pub fn used(error: T, measured: &Measured<T>) -> Self {
        let &Measured { leverage, largest, forgot, .. } = measured;
        Self { error, leverage, largest, forgot, used: true, windup: false }
    }
}
