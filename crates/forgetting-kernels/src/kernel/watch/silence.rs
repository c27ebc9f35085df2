//! How long each parameter has not been excited.

use super::Observed;
use crate::number::lane::Lane;
use crate::number::vector::Vector;
use crate::number::Real;

/// What is kept of each parameter for this, and when it counts as excited.
pub struct Silence<'a, T> {
    /// P_ii
    pub variances: &'a [T],
    /// φ̄_i² P_ii from which on parameter i is excited
    pub least: T,
    /// samples since it was
    pub since: &'a mut [T],
}

impl<T: Real> Silence<'_, T> {
    /// Notes samples, inside a kernel.
    #[inline(always)]
    pub fn note<'s, V: Vector<T>, S: Observed<'s, T>>(self, samples: S) {
        let Self { variances, least, since } = self;
        let n = variances.len();
        let (variances, variances_rest) = T::chunks(variances);
        let (since, since_rest) = T::chunks_mut(since);
        for i in 0..since.len().min(variances.len()) {
            let regressor = |row| V::load(&T::chunks(row).0[i]);
            let limits = (V::load(&variances[i]), V::splat(least));
            renew(samples, (n, regressor), limits, V::load(&since[i])).store(&mut since[i]);
        }
        for i in 0..since_rest.len().min(variances_rest.len()) {
            let regressor = |row| T::chunks(row).1[i];
            let limits = (variances_rest[i], least);
            since_rest[i] = renew(samples, (n, regressor), limits, since_rest[i]);
        }
    }
}

/// Samples since a parameter was excited, or one in each lane: how many came after the last of
/// these that did, which is looked for from the end; if none did, all more than `before`.
#[inline(always)]
fn renew<'s, T: Real, A: Lane<T>, S: Observed<'s, T>>(
    samples: S,
    (n, regressor): (usize, impl Fn(&'s [T]) -> A),
    (variance, least): (A, A),
    before: A,
) -> A {
    let count = A::splat(T::from_f64(samples.count() as f64));
    // as far as a number counts in steps of one, too
    let (most, sum) = (A::splat(T::ONE / T::EPSILON), before + count);
    let (mut since, mut after) = (A::select(sum.at_most(most), sum, most), T::ZERO);
    for k in (0..samples.count()).rev() {
        let now = A::splat(after);
        if A::all(since.less_than(now)) {
            break;
        }
        if let Some(sample) = samples.get(k, n) {
            for k in 0..sample.rows {
                let f = regressor(&sample.regressors[k * n..(k + 1) * n]);
                let excited = A::both(least.at_most(f * f * variance), now.less_than(since));
                since = A::select(excited, now, since);
            }
        }
        after += T::ONE;
    }
    since
}
