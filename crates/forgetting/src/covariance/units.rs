//! P in other units, wherever U is kept.

use super::Factor;
use crate::error::Error;
use crate::memory::Memory;
use forgetting_kernels::kernel::layout;
use forgetting_kernels::Real;

/// U above its diagonal.
pub(crate) trait Above<T> {
    /// The element at row i and column j, i < j.
    fn above(&mut self, i: usize, j: usize) -> Option<&mut T>;
}

/// The columns of U in tiles; see [`layout::place`].
pub(super) struct Tiles<'a, T>(pub &'a mut [T]);

impl<T: Real> Above<T> for Tiles<'_, T> {
    #[inline(always)]
    fn above(&mut self, i: usize, j: usize) -> Option<&mut T> {
        self.0.get_mut(layout::place::<T>(i, j))
    }
}

/// P ← S·P·S with S = diag(`scale`), each > 0: U ← S U S⁻¹, D ← S D S. O(n²).
pub(crate) fn scale_each<T: Real>(u: &mut impl Above<T>, diagonal: &mut [T], scale: &[T]) {
    for (j, (&s, place)) in scale.iter().zip(diagonal).enumerate() {
        for (i, &t) in scale.iter().enumerate().take(j) {
            if let Some(u) = u.above(i, j) {
                *u = *u * t / s;
            }
        }
        let d = *place * s * s;
        put_diagonal(u, place, j, d);
    }
}

/// D_j ← `d`, or the floor where that is below it.
///
/// A column of U may be as long as D is small. At the floor it becomes √(d/floor) of what it was,
/// so that it adds to P no more than it did: lifting D alone would add the floor times the
/// square of its length.
pub(super) fn put_diagonal<T: Real>(u: &mut impl Above<T>, place: &mut T, j: usize, d: T) {
    let floor = T::FLOOR;
    *place = d.max(floor);
    if d < floor {
        let share = (d / floor).sqrt();
        for i in 0..j {
            if let Some(u) = u.above(i, j) {
                *u *= share;
            }
        }
    }
}

impl<M: Memory> Factor<M> {
    /// P ← S·P·S with S = diag(`scale`), each > 0. O(n²).
    ///
    /// Call [`Factor::reserve`] with the largest squared scale first.
    pub fn scale_each(&mut self, scale: &[M::Real]) {
        scale_each(&mut Tiles(self.columns.as_mut()), self.diagonal.as_mut(), scale);
        self.deferred.scale_each(scale);
    }

    /// P ← S·P·S with S = diag(`ratios`), each > 0. O(n²).
    ///
    /// # Errors
    /// [`Error::Range`] when P would leave the range of the number type; P is as it was.
    pub(crate) fn change_units(&mut self, ratios: &[M::Real]) -> Result<(), Error> {
        let largest = ratios.iter().fold(M::Real::ZERO, |largest, &r| largest.max(r));
        self.tighten();
        self.reserve((largest * largest).max(M::Real::ONE), M::Real::ZERO)?;
        self.scale_each(ratios);
        self.tighten();
        Ok(())
    }

    /// P ← S·P·S with S = diag(`scale`), to be read and not to be gone on with: it may leave the range.
    pub(crate) fn express(&mut self, scale: &[M::Real]) {
        for (j, &s) in scale.iter().enumerate() {
            for (i, &t) in scale[..j].iter().enumerate() {
                let u = &mut self.columns.as_mut()[layout::place::<M::Real>(i, j)];
                *u = *u * t / s;
            }
            let d = &mut self.diagonal.as_mut()[j];
            *d = *d * s * s;
        }
        self.deferred.scale_each(scale);
    }
}
