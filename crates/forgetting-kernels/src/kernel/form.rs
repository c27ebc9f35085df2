//! What forgetting does to P on the way to a measurement of one row, where the two are one pass.

use crate::number::lane::Lane;
use crate::number::Real;

/// A way to forget that is done together with the measurement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Form<T> {
    /// P̄ = growth·P, growth ≥ 1
    Scale {
        /// what P is multiplied with
        growth: T,
    },
    /// P̄ = P + weight·φ̄ᵀ(φ̄Rφ̄ᵀ)⁻¹φ̄, and nothing at all for a regressor within the dead zone
    Along {
        /// (1 − λ)/λ
        weight: T,
        /// regressors that are left out
        dead_zone: DeadZone<T>,
    },
    /// P̄ = (1 − noise/b)·P + noise·I; of at most [`FEW`](super::layout::FEW) parameters
    Walk {
        /// what each variance grows by; with a bound it is at least the floor of D
        noise: T,
        /// 1/b, below 1/noise: P stays at most b·I; 0 for no bound
        per_bound: T,
    },
}

/// Which form a kernel is for: [`Form::Scale`].
pub const SCALE: u8 = 0;
/// [`Form::Along`]
pub const ALONG: u8 = 1;
/// [`Form::Walk`]
pub const WALK: u8 = 2;

impl<T: Real> Form<T> {
    /// P̄ = P
    pub const NOTHING: Self = Self::Scale { growth: T::ONE };
}

/// 1 − noise/b: what a walk multiplies P with.
#[inline(always)]
pub fn shrink<T: Real, A: Lane<T>>(noise: A, per_bound: A) -> A {
    (-noise).mul_add(per_bound, A::splat(T::ONE))
}

/// Regressors that are too short to count as information.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DeadZone<T> {
    /// shorter than this
    Below(T),
    /// no longer than this
    UpTo(T),
}

impl<T: Real> DeadZone<T> {
    /// Whether a regressor with this ‖φ̄‖² is in it.
    #[inline(always)]
    pub fn holds(self, squares: T) -> bool {
        match self {
            Self::Below(least) => !(squares.sqrt() >= least),
            Self::UpTo(most) => !(squares.sqrt() > most),
        }
    }
}
