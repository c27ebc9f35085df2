//! Eigenvalues and eigenvectors after a rank-one change: the secular equation, then new vectors as
//! combinations of the old ones. O(n³), all of it in [`combine`].

mod combine;
mod secular;

pub use combine::Rows;

use super::dispatch::Kernel;
use crate::number::vector::Vector;
use crate::number::Real;
use combine::combine;

/// The rank-one update of the eigenvalues and eigenvectors that it changes.
pub struct RankOneUpdate<'a, T> {
    /// the eigenvalues, ascending
    pub poles: &'a [T],
    /// the components of the update along the eigenvectors
    pub weights: &'a [T],
    /// the eigenvectors
    pub rows: Rows<'a, T>,
    /// as many numbers as the square of that of the poles: a buffer
    pub turn: &'a mut [T],
    /// the new eigenvalues
    pub roots: &'a mut [T],
    /// the new eigenvectors
    pub product: &'a mut [T],
}

impl<T: Real> Kernel<T> for RankOneUpdate<'_, T> {
    type Output = bool;

    #[inline(always)]
    fn size(&self) -> usize {
        self.poles.len()
    }

    #[inline(always)]
    fn run<V: Vector<T>, const GROUP: usize>(self) -> bool {
        let Self { poles, weights, rows, turn, roots, product } = self;
        let active = poles.len();
        // the product is free until the vectors are combined
        let buffer = &mut product[..active];
        for i in 0..active {
            buffer[i] = weights[i] * weights[i];
        }
        secular::roots(poles, buffer, turn, roots);
        let sound = secular::vectors(poles, weights, turn, buffer);
        if sound {
            combine::<T, V, GROUP>(turn, active, rows, product);
        }
        sound
    }
}
