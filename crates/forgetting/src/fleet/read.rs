//! What all streams hold, in the order of the streams.

use super::{Fleet, Line};
use crate::error::Error;
use forgetting_kernels::kernel::lanes::Predict;
use forgetting_kernels::Kernels;

impl<T: Kernels> Fleet<T> {
    /// φθ of each stream, for n numbers `phi` each.
    ///
    /// # Errors
    /// [`Error::Length`] names what does not fit.
    pub fn predict(&self, phi: &[T], prediction: &mut [T]) -> Result<(), Error> {
        let n = self.parameters();
        Error::check_length("phi", phi.len(), self.count * n)?;
        Error::check_length("prediction", prediction.len(), self.count)?;
        let (layout, lines) = (self.layout, &self.lines);
        T::predict_streams(Predict { layout, lines, phi, prediction });
        Ok(())
    }

    /// θ of each stream, n numbers after n numbers.
    ///
    /// # Panics
    /// Unless there is room for as many.
    pub fn theta(&self, theta: &mut [T]) {
        let (n, first) = (self.parameters(), self.layout.theta());
        for (place, block) in self.blocks(theta, n) {
            for (i, line) in block[first..first + n].iter().enumerate() {
                for (lane, theta) in place.chunks_exact_mut(n).enumerate() {
                    theta[i] = line.get(lane);
                }
            }
        }
    }

    /// The diagonal of P of each stream, n numbers after n numbers.
    ///
    /// # Panics
    /// Unless there is room for as many.
    pub fn variances(&self, variances: &mut [T]) {
        let n = self.parameters();
        for (place, block) in self.blocks(variances, n) {
            for (lane, variances) in place.chunks_exact_mut(n).enumerate() {
                for (i, variance) in variances.iter_mut().enumerate() {
                    *variance = self.variance(block, lane, i);
                }
            }
        }
    }

    /// An element of the diagonal of P, summed as [`Factor`](crate::Factor) does.
    fn variance(&self, block: &[Line<T>], lane: usize, i: usize) -> T {
        let d = |k: usize| block[self.layout.diagonal() + k].get(lane);
        (i + 1..self.parameters()).fold(T::ZERO + d(i), |sum, k| {
            let u = block[self.layout.column(k) + i].get(lane);
            sum + u * d(k) * u
        })
    }

    /// The largest and the smallest element of D of each stream.
    ///
    /// # Panics
    /// Unless there is room for as many.
    pub fn extremes(&self, largest: &mut [T], smallest: &mut [T]) {
        let (n, first) = (self.parameters(), self.layout.diagonal());
        for (place, block) in self.blocks(largest, 1) {
            for (lane, largest) in place.iter_mut().enumerate() {
                let d = block[first..first + n].iter().map(|line| line.get(lane));
                *largest = d.fold(T::ZERO, T::max);
            }
        }
        for (place, block) in self.blocks(smallest, 1) {
            for (lane, smallest) in place.iter_mut().enumerate() {
                let d = block[first..first + n].iter().map(|line| line.get(lane));
                *smallest = d.fold(T::CEILING, T::min);
            }
        }
    }

    /// The largest element of D that a stream started with.
    pub fn first_largest(&self, stream: usize) -> T {
        if self.priors.is_common(stream) {
            let first = self.layout.diagonal();
            return self.start[first..first + self.parameters()]
                .iter()
                .copied()
                .fold(T::ZERO, T::max);
        }
        self.priors.get(stream).factor().largest()
    }

    /// The place of `width` numbers for each stream of a block, with the numbers of the block.
    fn blocks<'a>(
        &'a self,
        places: &'a mut [T],
        width: usize,
    ) -> impl Iterator<Item = (&'a mut [T], &'a [Line<T>])> {
        assert!(places.len() == width * self.count, "there is room for each stream");
        let blocks = self.lines.chunks_exact(self.layout.length());
        places.chunks_mut(width * Line::<T>::LANES).zip(blocks)
    }
}
