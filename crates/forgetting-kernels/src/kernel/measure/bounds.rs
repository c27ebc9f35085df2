//! Whether P has room to grow, and D stays away from its floor.

use crate::kernel::registers::floor::far_before;
use crate::number::Real;

/// Whether P may grow so; if so, the bound of its trace follows.
#[inline(always)]
pub(super) fn make_room<T: Real>(bound: &mut T, growth: T, added: T) -> Option<()> {
    let grown = *bound * growth + added;
    (grown < T::CEILING).then(|| *bound = grown)
}

/// Two numbers that are at least the trace of P.
pub struct Bounds<'a, T> {
    /// the one that the factor keeps, by which there is room for P or not
    pub kept: &'a mut T,
    /// one that may be much smaller, by which D stays far from its floor or not
    pub tight: T,
}

impl<T: Real> Bounds<'_, T> {
    /// Both follow P as it grows, if there is room and, unless `NEAR`, no element of D, at least
    /// `least`, may come near its floor when a regressor with this ‖f‖² is measured.
    #[inline(always)]
    pub(super) fn grow<const NEAR: bool>(
        &mut self,
        (growth, added): (T, T),
        (least, squares): (T, T),
    ) -> Option<()> {
        let (kept, tight) = (*self.kept * growth + added, self.tight * growth + added);
        if !(kept < T::CEILING && (NEAR || far_before(least, tight, squares))) {
            return None;
        }
        (*self.kept, self.tight) = (kept, tight);
        Some(())
    }
}

/// Whether c·fᵀf is to be added: not for λ = 1 or f = 0, nor for more information than the number
/// type can hold.
#[inline(always)]
pub fn adds<T: Real>(c: T) -> bool {
    c > T::ZERO && c.is_finite()
}
