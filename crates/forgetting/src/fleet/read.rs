//! What all streams hold, in the order of the streams.

use super::{Fleet, Line};
use crate::error::Error;
use alloc::borrow::Cow;
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
        let layout = self.layout;
        let lines: Cow<'_, [Line<T>]> = match &self.units {
            None => Cow::Borrowed(&self.lines),
            Some(units) => {
                let mut lines = self.lines.clone();
                for (b, block) in lines.chunks_exact_mut(layout.length()).enumerate() {
                    for (theta, reciprocal) in
                        block[layout.theta()..].iter_mut().zip(units.block(b))
                    {
                        for lane in 0..Line::<T>::LANES {
                            theta.set(lane, theta.get(lane) * reciprocal.get(lane));
                        }
                    }
                }
                Cow::Owned(lines)
            }
        };
        let lines = &lines;
        T::predict_streams(Predict { layout, lines, phi, prediction });
        Ok(())
    }

    /// θ of each stream, n numbers after n numbers.
    ///
    /// # Panics
    /// Unless there is room for as many.
    pub fn theta(&self, theta: &mut [T]) {
        let (n, first) = (self.parameters(), self.layout.theta());
        for (b, (place, block)) in self.blocks(theta, n).enumerate() {
            for (i, line) in block[first..first + n].iter().enumerate() {
                for (lane, theta) in place.chunks_exact_mut(n).enumerate() {
                    theta[i] = line.get(lane) * self.reciprocal(b, i, lane);
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
        for (b, (place, block)) in self.blocks(variances, n).enumerate() {
            for (lane, variances) in place.chunks_exact_mut(n).enumerate() {
                for (i, variance) in variances.iter_mut().enumerate() {
                    *variance = self.variance(block, b, lane, i);
                }
            }
        }
    }

    /// 1/s of a stream, 1 where there are no units.
    fn reciprocal(&self, block: usize, i: usize, lane: usize) -> T {
        self.units.as_ref().map_or(T::ONE, |units| units.block(block)[i].get(lane))
    }

    /// An element of the diagonal of P, expressed and summed as [`Factor`](crate::Factor) does.
    fn variance(&self, block: &[Line<T>], b: usize, lane: usize, i: usize) -> T {
        let own = self.reciprocal(b, i, lane);
        let d = |k: usize, s: T| block[self.layout.diagonal() + k].get(lane) * s * s;
        (i + 1..self.parameters()).fold(T::ZERO + d(i, own), |sum, k| {
            let s = self.reciprocal(b, k, lane);
            let u = block[self.layout.column(k) + i].get(lane) * own / s;
            sum + u * d(k, s) * u
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
