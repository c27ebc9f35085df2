//! How long each parameter has not been excited.

use super::Seen;
use crate::vector::Vector;
use crate::{Lane, Real};

/// What is kept of each parameter for this, and when it counts as excited.
pub(super) struct Silence<'a, T> {
    /// P_ii
    pub variances: &'a [T],
    /// φ̄_i² P_ii from which on parameter i is excited
    pub least: T,
    /// samples since it was
    pub since: &'a mut [T],
}

impl<T: Real> Silence<'_, T> {
    /// Takes note of samples, inside a kernel.
    #[inline(always)]
    pub fn note<'s, V, I>(self, samples: &I)
    where
        V: Vector<T>,
        I: Clone + ExactSizeIterator<Item = Option<Seen<'s, T>>> + DoubleEndedIterator,
    {
        let Self { variances, least, since } = self;
        let (n, count) = (variances.len(), T::from_f64(samples.len() as f64));
        let (variances, variances_rest) = T::chunks(variances);
        let (since, since_rest) = T::chunks_mut(since);
        for (i, (since, variance)) in since.iter_mut().zip(variances).enumerate() {
            let regressor = |row| V::load(&T::chunks(row).0[i]);
            let limits = (V::load(variance), V::splat(least));
            renew(samples.clone(), (n, regressor), limits, (V::load(since), count)).store(since);
        }
        for (i, (since, &variance)) in since_rest.iter_mut().zip(variances_rest).enumerate() {
            let regressor = |row| T::chunks(row).1[i];
            *since = renew(samples.clone(), (n, regressor), (variance, least), (*since, count));
        }
    }
}

/// Samples since a parameter was excited, or one in each lane: how many came after the last of
/// these `count` that did, which is looked for from the end; if none did, all more than `before`.
#[inline(always)]
fn renew<'s, T: Real, A: Lane<T>>(
    samples: impl DoubleEndedIterator<Item = Option<Seen<'s, T>>>,
    (n, regressor): (usize, impl Fn(&'s [T]) -> A),
    (variance, least): (A, A),
    (before, count): (A, T),
) -> A {
    // as far as a number counts in steps of one, too
    let (most, sum) = (A::splat(T::ONE / T::EPSILON), before + A::splat(count));
    let (mut since, mut after) = (A::select(sum.at_most(most), sum, most), T::ZERO);
    for seen in samples.rev() {
        let now = A::splat(after);
        if A::all(since.less_than(now)) {
            break;
        }
        if let Some(seen) = seen {
            for k in 0..seen.rows {
                let f = regressor(&seen.regressors[k * n..(k + 1) * n]);
                let excited = A::both(least.at_most(f * f * variance), now.less_than(since));
                since = A::select(excited, now, since);
            }
        }
        after += T::ONE;
    }
    since
}
