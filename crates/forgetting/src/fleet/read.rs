//! What all streams hold, in the order of the streams.

use super::{Fleet, Line};
use crate::error::Error;
use alloc::borrow::Cow;
use alloc::vec::Vec;
use forgetting_kernels::kernel::lanes::Predict;
use forgetting_kernels::Kernels;

impl<T: Kernels> Fleet<T> {
    /// φθ of the streams from `first` on, one for each place in `prediction`, for n numbers `phi` each.
    ///
    /// # Errors
    /// [`Error::Length`] names what does not fit.
    ///
    /// # Panics
    /// Unless `first` is a multiple of 64.
    pub fn predict(&self, first: usize, phi: &[T], prediction: &mut [T]) -> Result<(), Error> {
        assert!(first.is_multiple_of(64), "the first stream is that of a block");
        let (n, layout) = (self.parameters(), self.layout);
        Error::check_length("phi", phi.len(), prediction.len() * n)?;
        if prediction.len() > self.count.saturating_sub(first) {
            Error::check_length("prediction", prediction.len(), self.count.saturating_sub(first))?;
        }
        let first = first / Line::<T>::LANES;
        let blocks = first..first + prediction.len().div_ceil(Line::<T>::LANES);
        let lines = &self.lines[blocks.start * layout.length()..blocks.end * layout.length()];
        let lines: Cow<'_, [Line<T>]> = match &self.units {
            None => Cow::Borrowed(lines),
            Some(units) => {
                let mut lines = Vec::from(lines);
                for (b, block) in blocks.zip(lines.chunks_exact_mut(layout.length())) {
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

    /// θ of the streams from `first` on, n numbers after n numbers, as many as there is room for.
    ///
    /// # Panics
    /// If there are not so many streams.
    pub fn theta(&self, first: usize, theta: &mut [T]) {
        let (n, start) = (self.parameters(), self.layout.theta());
        for (place, (b, block, lane)) in theta.chunks_exact_mut(n).zip(self.lanes(first)) {
            for (i, theta) in place.iter_mut().enumerate() {
                *theta = block[start + i].get(lane) * self.reciprocal(b, i, lane);
            }
        }
    }

    /// The diagonal of P of the streams from `first` on, n numbers after n numbers, as many as there is room for.
    ///
    /// # Panics
    /// If there are not so many streams.
    pub fn variances(&self, first: usize, variances: &mut [T]) {
        let n = self.parameters();
        for (place, (b, block, lane)) in variances.chunks_exact_mut(n).zip(self.lanes(first)) {
            for (i, variance) in place.iter_mut().enumerate() {
                *variance = self.variance(block, b, lane, i);
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

    /// The largest and the smallest element of D of a stream.
    ///
    /// # Panics
    /// If there is no such stream.
    pub fn extremes(&self, stream: usize) -> (T, T) {
        let first = self.layout.diagonal();
        let (block, lane) = (stream / Line::<T>::LANES, stream % Line::<T>::LANES);
        let start = block * self.layout.length() + first;
        let d = self.lines[start..start + self.parameters()].iter().map(|line| line.get(lane));
        d.fold((T::ZERO, T::CEILING), |(most, least), d| (most.max(d), least.min(d)))
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

    /// The block of each stream from `first` on: its number, its lines and which lane is the stream's.
    fn lanes(&self, first: usize) -> impl Iterator<Item = (usize, &[Line<T>], usize)> {
        let length = self.layout.length();
        (first..).map(move |stream| {
            assert!(stream < self.count, "there is a stream for each place");
            let (b, lane) = (stream / Line::<T>::LANES, stream % Line::<T>::LANES);
            (b, &self.lines[b * length..(b + 1) * length], lane)
        })
    }
}
