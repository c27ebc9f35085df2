//! What a measurement does to D that would fall below its floor.
//!
//! A column of U may be as long as D is small: lifting D alone would add to P whatever the floor
//! is times the square of that length. So the column becomes √(D/floor) of what it is.

use crate::{Lane, Real};

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

#[cfg(test)]
mod tests {
    use crate::factor::kernel::place;
    use crate::{Dynamic, Factor, Real};

    /// P with these columns above the diagonal and this D.
    fn factor<const N: usize>(columns: &[&[f64]], diagonal: [f64; N]) -> Factor<Dynamic<f64>> {
        let mut factor = Factor::scalar(Dynamic::new(N, 1, 1).unwrap(), 1.0).unwrap();
        factor.diagonal.as_mut().copy_from_slice(&diagonal);
        for (j, column) in columns.iter().enumerate() {
            for (i, &u) in column.iter().enumerate() {
                factor.columns.as_mut()[place::<f64>(i, j)] = u;
            }
        }
        factor
    }

    #[test]
    fn a_measurement_adds_nothing_where_d_is_at_its_floor() {
        let diagonal = [1.4058341593762096e-138, 0.008440921232922291, 4.440109184476592e-149];
        let columns: [&[f64]; 3] = [&[], &[0.0], &[4.3556142965880123e40, 1.7335898988465585e73]];
        let mut p = factor(&columns, diagonal);
        p.add_information(&[1.5369708694062383e67, 7.561495892025367e19, 0.0], &mut [0.0; 3]);
        // in exact arithmetic; the last D is then 1e-178, and its column 9e87 long
        assert!((p.trace() / 0.008440921232922258 - 1.0).abs() < 1e-12, "{p:?}");
        assert!(p.is_sound());
    }

    #[test]
    fn d_at_its_floor_may_stay_where_nothing_is_measured() {
        let floor = f64::FLOOR;
        for size in [3.0, 7.0, 1e10, 3e60] {
            let mut p = factor(&[&[], &[2.0], &[-2.0, 3.0]], [1.0, floor, floor]);
            p.add_information(&[size, 0.0, 0.0], &mut [0.0; 3]);
            assert!(p.is_sound() && p.trace() < 1.0, "{p:?}");
        }
    }

    #[test]
    fn products_within_a_measurement_are_finite() {
        let mut p = factor(&[&[], &[0.0]], [f64::CEILING / 4.0; 2]);
        for row in [[1e-75, 1e75], [1e75, 0.0], [0.0, 1e75]] {
            p.add_information(&row, &mut [0.0; 2]);
            assert!(p.is_sound(), "{p:?}");
        }
    }
}
