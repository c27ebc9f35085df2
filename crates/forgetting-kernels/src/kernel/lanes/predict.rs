//! φθ of each stream.

use crate::kernel::dispatch::Kernel;
use crate::kernel::lanes::storage::{Layout, Line};
use crate::number::lane::Lane;
use crate::number::vector::{StreamVector, Vector};
use crate::number::{copy_first, Real};

/// Writes φθ of each stream to `prediction`.
pub struct Predict<'a, T: Real> {
    /// where the numbers of a stream are
    pub layout: Layout,
    /// the numbers of the streams
    pub lines: &'a [Line<T>],
    /// n numbers a stream
    pub phi: &'a [T],
    /// one for each stream
    pub prediction: &'a mut [T],
}

impl<T: Real> Kernel<T> for Predict<'_, T> {
    type Output = ();

    #[inline(always)]
    fn size(&self) -> usize {
        self.phi.len()
    }

    #[inline(always)]
    fn run<V: Vector<T>, const GROUP: usize>(self) {
        let Self { layout, lines, phi, prediction } = self;
        let (lanes, length, first) = (Line::<T>::LANES, layout.length(), layout.theta());
        let n = length - first;
        for (b, prediction) in prediction.chunks_mut(lanes).enumerate() {
            let block = &lines[b * length..(b + 1) * length];
            let phi = &phi[b * n * lanes..];
            let mut products = Line::splat(T::ZERO);
            for lane in (0..lanes).step_by(V::StreamVector::COUNT) {
                let mut product = V::StreamVector::splat(T::ZERO);
                for (i, theta) in block[first..].iter().enumerate() {
                    let phi = V::StreamVector::at(|k| match phi.get((lane + k) * n + i) {
                        Some(&phi) => phi,
                        None => T::ZERO,
                    });
                    product =
                        phi.mul_add(V::StreamVector::read(&theta.0.as_ref()[lane..]), product);
                }
                product.write(&mut products.0.as_mut()[lane..]);
            }
            copy_first(prediction, products.0.as_ref());
        }
    }
}
