//! The diagonal of P.

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
        variances.fill(T::ZERO);
        let (variances, rest) = T::chunks_mut(variances);
        for (k, &d) in diagonal.iter().enumerate() {
            // there are zeros below the diagonal
            let piece = |i: usize| &columns[place::<T>(i * T::ROWS, k)..][..T::ROWS];
            let (whole, scale) = (variances.len().min(k / T::ROWS + 1), V::splat(d));
            for (i, variance) in variances[..whole].iter_mut().enumerate() {
                let u = V::load(&T::chunks(piece(i)).0[0]);
                (V::load(variance) + u * scale * u).store(variance);
            }
            if k / T::ROWS == variances.len() {
                for (variance, &u) in rest.iter_mut().zip(piece(whole)) {
                    *variance += u * d * u;
                }
            }
        }
    }
}
