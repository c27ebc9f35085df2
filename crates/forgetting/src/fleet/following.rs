//! Streams that follow the data: what happens to one of them alone.
//!
//! A stream chooses a unit when a regressor is first other than 0, and renews its units now and
//! then ([`units`](crate::units)). It does either as the estimator that it is; everything else is done
//! in lanes.

use super::part::Part;
use super::{Line, Outputs, Samples, REFUSED};
use crate::estimator::Numbers;
use crate::sample::Skip;
use crate::units::{is_renewal, next_renewal};
use alloc::vec::Vec;
use forgetting_kernels::kernel::lanes::streams::Units;
use forgetting_kernels::Kernels;

impl<T: Kernels> Part<'_, T> {
    /// [`Part::update`] where streams follow the data.
    pub(super) fn update_following(
        &mut self,
        samples: Samples<'_, T>,
        outputs: &mut Outputs<'_, T>,
    ) -> usize {
        let alone = self.alone(samples);
        if alone.is_empty() {
            let used = T::advance_streams(&mut self.streams, samples, outputs);
            self.renew();
            return used;
        }
        let mut mask = match samples.mask {
            Some(mask) => Vec::from(mask),
            None => alloc::vec![true; self.streams.count],
        };
        alone.iter().for_each(|&stream| mask[stream] = false);
        let others = Samples { mask: Some(&mask), ..samples };
        let mut used = T::advance_streams(&mut self.streams, others, outputs);
        for &stream in &alone {
            used += usize::from(self.update_alone(stream, samples, outputs));
        }
        self.settle();
        self.renew();
        used
    }

    /// The streams with a sample for which they have to choose a unit.
    fn alone(&self, samples: Samples<'_, T>) -> Vec<usize> {
        let mut alone = Vec::new();
        let (Some(following), Some(units)) = (&self.following, &self.streams.units) else {
            return alone;
        };
        for block in (0..following.settled.len()).filter(|&block| !following.settled[block]) {
            alone.extend(self.of_block(block).filter(|&stream| {
                samples.mask.is_none_or(|mask| mask[stream])
                    && following.follows(stream)
                    && self.lacks(units, stream, |i| samples.phi[stream * self.streams.n + i])
            }));
        }
        alone
    }

    /// The streams of a block.
    fn of_block(&self, block: usize) -> core::ops::Range<usize> {
        let lanes = Line::<T>::LANES;
        block * lanes..((block + 1) * lanes).min(self.streams.count)
    }

    /// Whether a stream has no unit for one of these regressors, and it is other than 0.
    fn lacks(&self, units: &Units<'_, T>, stream: usize, phi: impl Fn(usize) -> T) -> bool {
        let (n, block) = (self.streams.n, stream / Line::<T>::LANES);
        let counts = &units.lines[(3 * block + 2) * n..3 * (block + 1) * n];
        let lane = stream % Line::<T>::LANES;
        (0..n).any(|i| counts[i].get(lane) == T::ZERO && phi(i) != T::ZERO)
    }

    /// A stream takes its sample as an estimator; whether it used it.
    fn update_alone(
        &mut self,
        stream: usize,
        samples: Samples<'_, T>,
        outputs: &mut Outputs<'_, T>,
    ) -> bool {
        let n = self.streams.n;
        let (phi, y) = (&samples.phi[stream * n..(stream + 1) * n], samples.y[stream]);
        let nan = T::from_f64(f64::NAN);
        let Some(mut estimator) = self.get(stream) else { return false };
        let (error, leverage, code) = if phi.iter().chain([&y]).any(|x| x.to_f64().is_nan()) {
            (nan, nan, Skip::Missing.code())
        } else {
            match estimator.update(phi, &[y]) {
                Ok(update) => {
                    let code = update.skipped.map_or(0, Skip::code);
                    (update.error[0], update.leverage, code)
                }
                Err(_) => (nan, nan, REFUSED),
            }
        };
        put(&mut outputs.error, stream, error);
        put(&mut outputs.leverage, stream, leverage);
        put(&mut outputs.skipped, stream, code);
        self.set(stream, &Numbers::of(&mut estimator));
        code == 0
    }

    /// Takes note of the blocks in which every stream has all its units.
    fn settle(&mut self) {
        let Some(units) = &self.streams.units else { return };
        let blocks = self.following.iter().flat_map(|following| 0..following.settled.len());
        let settled: Vec<_> = blocks
            .map(|block| {
                self.of_block(block).all(|stream| {
                    let follows = self.following.as_ref().is_some_and(|all| all.follows(stream));
                    !follows || !self.lacks(units, stream, |_| T::ONE)
                })
            })
            .collect();
        if let Some(following) = &mut self.following {
            following.settled.copy_from_slice(&settled);
        }
    }

    /// Renews the units of the streams for which that is due.
    fn renew(&mut self) {
        let blocks = self.streams.offered.len();
        for block in 0..blocks {
            let due = self.following.as_ref().map_or(u64::MAX, |following| following.due[block]);
            if self.streams.offered[block] >= due {
                self.renew_block(block);
            }
        }
    }

    #[cold]
    fn renew_block(&mut self, block: usize) {
        let (n, offered) = (self.streams.n as u64, self.streams.offered[block]);
        let mut least = u64::MAX;
        for stream in self.of_block(block) {
            let (Some(following), Some(units)) = (&mut self.following, &self.streams.units) else {
                return;
            };
            if !following.follows(stream) {
                continue;
            }
            let measured = offered.wrapping_sub(units.unmeasured[stream]);
            let renews = is_renewal(n, measured) && following.renewed[stream] != measured;
            least = least.min(next_renewal(n, measured) - measured);
            if renews {
                if let Some(mut estimator) = self.get(stream) {
                    estimator.renew_units();
                    self.set(stream, &Numbers::of(&mut estimator));
                }
            }
        }
        if let Some(following) = &mut self.following {
            following.due[block] = offered.saturating_add(least);
        }
    }
}

fn put<X>(numbers: &mut Option<&mut [X]>, at: usize, number: X) {
    if let Some(numbers) = numbers {
        numbers[at] = number;
    }
}
