//! What a measurement does to D that would fall below its floor.
//!
//! A column of U may be as long as D is small: lifting D alone would add to P whatever the floor
//! is times the square of that length. So the column becomes √(D/floor) of what it is.

use crate::number::lane::Lane;
use crate::number::Real;

/// Whether a measurement leaves D above its floor, and the largest product within it a number, whatever
/// the regressor with the squared length `squares`: D becomes no less than D / (1 + tr P ‖f‖²).
#[inline(always)]
pub fn far_before<T: Real>(least: T, trace: T, squares: T) -> bool {
    let leverage = trace * squares;
    // with room for rounding
    leverage < T::CEILING && T::FLOOR * (T::from_f64(4.0) * (T::ONE + leverage)) <= least
}

/// Where a measurement left D, of which the least is `least`, at its floor or above, and its products
/// numbers.
#[inline(always)]
pub fn far_after<T: Real, A: Lane<T>>(least: A, a: A) -> A::Mask {
    A::both(A::splat(T::FLOOR).at_most(least), a.at_most(A::splat(T::CEILING)))
}

/// A column as Bierman's update found it: D of after, w = Uᵀf, v = D w with the D of before, and 1/a
/// before it; its change is then (−w k)/a.
#[derive(Clone, Copy)]
pub struct Column<A> {
    pub d: A,
    pub w: A,
    pub v: A,
    pub inverse: A,
}

impl<A: Copy> Column<A> {
    /// D at the floor where it is below, and what to multiply the column with after its change; and w
    /// divided by a where w k could be too large for a number. Else the reciprocals come last, when the
    /// products wait for them.
    #[inline(always)]
    pub fn lift<T: Real>(self, inverse_after: A, a_of_all: A) -> (Self, A)
    where
        A: Lane<T>,
    {
        let (one, floor) = (A::splat(T::ONE), A::splat(T::FLOOR));
        let Self { d, w, v, inverse } = self;
        let small = a_of_all.at_most(A::splat(T::CEILING));
        // from D as it was before: what is below the floor may be too small for a number
        let share = (v / w / floor) * (inverse_after / inverse);
        // where w is 0, D is below the floor by no more than rounding, and there is no share
        let lifted = A::both(d.less_than(floor), share.less_than(one));
        let column = Self {
            d: d.max(floor),
            w: A::select(small, w, w * inverse),
            v,
            inverse: A::select(small, inverse, one),
        };
        (column, A::select(lifted, share.sqrt(), one))
    }
}
