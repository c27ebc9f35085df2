//! The diagonal of P.

use super::copies::put_first;
use super::layout::place;
use crate::kernel::dispatch::Kernel;
use crate::number::vector::Vector;
use crate::number::Real;

/// Writes P_ii = Σ_k U_ik D_k U_ik to `variances`, column by column, rounded as single elements
/// of P are.
pub struct Variances<'a, T> {
    /// U, in tiles
    pub columns: &'a [T],
    /// D
    pub diagonal: &'a [T],
    /// become P_ii
    pub variances: &'a mut [T],
}

impl<T: Real> Kernel<T> for Variances<'_, T> {
    type Output = ();

    #[inline(always)]
    fn size(&self) -> usize {
        self.diagonal.len()
    }

    #[inline(always)]
    fn run<V: Vector<T>, const GROUP: usize>(self) {
        let Self { columns, diagonal, variances } = self;
        for (t, variances) in variances.chunks_mut(T::ROWS).enumerate() {
            let (first, mut sum) = (t * T::ROWS, V::splat(T::ZERO));
            // there are zeros below the diagonal
            for (k, &d) in diagonal.iter().enumerate().skip(first) {
                let u = V::load(&T::chunks(&columns[place::<T>(first, k)..]).0[0]);
                sum = sum + u * V::splat(d) * u;
            }
            put_first(variances, sum);
        }
    }
}
