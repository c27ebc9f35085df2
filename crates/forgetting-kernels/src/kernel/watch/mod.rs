//! What the monitor notes of each sample: all samples that come between two looks at P in one go.

mod residual;
mod silence;

pub use residual::Residual;
pub use silence::Silence;

use super::dispatch::Kernel;
use super::layout::UNROLLED;
use super::outcome::Outcome;
use super::vectors::{add_scaled_by, dot_of};
use crate::number::vector::Vector;
use crate::number::Real;

/// A sample that was used, as the monitor notes it.
#[derive(Clone, Copy, Debug)]
pub struct Observation<'a, T> {
    /// p
    pub rows: usize,
    /// φ̄, n numbers a row
    pub regressors: &'a [T],
    /// ē, one number a row and target
    pub errors: &'a [T],
    /// ‖ē‖² over rows and targets
    pub squared_error: T,
    /// tr φ̄P̄φ̄ᵀ
    pub leverage: T,
    /// the λ used
    pub forgetting_factor: T,
}

/// Samples of one row and one target, n numbers `phi` each, and what they brought.
#[derive(Clone, Copy, Debug)]
pub struct Observations<'a, T> {
    /// the λ of all of them
    pub forgetting_factor: T,
    /// the regressors, one after the other
    pub phi: &'a [T],
    /// one for each sample
    pub outcomes: &'a [Outcome<T>],
}

/// One sample or several, in order.
pub trait Observed<'a, T>: Copy {
    /// How many there are.
    fn count(self) -> usize;
    /// Sample `k`, of n parameters; None if it was left out.
    fn get(self, k: usize, n: usize) -> Option<Observation<'a, T>>;
}

impl<'a, T: Real> Observed<'a, T> for Observations<'a, T> {
    #[inline(always)]
    fn count(self) -> usize {
        self.outcomes.len()
    }

    #[inline(always)]
    fn get(self, k: usize, n: usize) -> Option<Observation<'a, T>> {
        let outcome = &self.outcomes[k];
        if !outcome.used {
            return None;
        }
        Some(Observation {
            rows: 1,
            regressors: &self.phi[k * n..(k + 1) * n],
            errors: core::slice::from_ref(&outcome.error),
            squared_error: outcome.error * outcome.error,
            leverage: outcome.leverage,
            forgetting_factor: self.forgetting_factor,
        })
    }
}

impl<'a, T: Real> Observed<'a, T> for Option<Observation<'a, T>> {
    #[inline(always)]
    fn count(self) -> usize {
        1
    }

    #[inline(always)]
    fn get(self, _: usize, _: usize) -> Self {
        self
    }
}

/// What the monitor keeps count of.
pub struct Watch<'a, T> {
    /// of the noise
    pub residual: &'a mut Residual<T>,
    /// of the weakest direction
    pub gauge: Gauge<'a, T>,
    /// of each parameter
    pub silence: Silence<'a, T>,
}

/// The information that the weakest direction w gets, and when that is enough.
pub struct Gauge<'a, T> {
    /// σ²
    pub variance: T,
    /// the share of information that ends windup: 0 where there is none
    pub needed: T,
    /// Σ (φ̃ w)² in this block and in the one before
    pub information: &'a mut [T; 2],
    /// S w
    pub axis: &'a [T],
    /// Σ (φ̃ w) φ̄ in this block
    pub products: &'a mut [T],
}

impl<'a, T: Real> Watch<'a, T> {
    /// The kernel that notes these samples.
    #[inline(always)]
    pub fn of<'s, S: Observed<'s, T>>(self, samples: S) -> WatchOf<'a, T, S> {
        WatchOf { watch: self, samples }
    }
}

/// Notes samples; returns how many of them, from the first on, left P wound up.
pub struct WatchOf<'a, T, S> {
    watch: Watch<'a, T>,
    samples: S,
}

impl<'s, T: Real, S: Observed<'s, T>> Kernel<T> for WatchOf<'_, T, S> {
    type Output = usize;

    #[inline(always)]
    fn size(&self) -> usize {
        self.watch.gauge.axis.len()
    }

    #[inline(always)]
    fn run<V: Vector<T>, const GROUP: usize>(self) -> usize {
        let n = self.size();
        // wide vectors are for many: without this they would be compiled for few, too
        if GROUP < 8 && n <= UNROLLED {
            with_few!(n, few::<T, V, S>(self)).unwrap_or(0)
        } else {
            self.watch.silence.note::<V, S>(self.samples);
            self.watch.gauge.note::<V, S>(self.watch.residual, self.samples)
        }
    }
}

/// For at most ten parameters: what changes stays in registers, and constant bounds unroll.
#[inline(always)]
fn few<'s, T: Real, V: Vector<T>, S: Observed<'s, T>, const N: usize>(
    WatchOf { watch, samples }: WatchOf<'_, T, S>,
) -> Option<usize> {
    let Watch { residual, gauge, silence: Silence { variances, least, since } } = watch;
    let (variances, since) = (variances.first_chunk::<N>()?, since.first_chunk_mut::<N>()?);
    Silence { variances, least, since }.note::<V, S>(samples);
    let (axis, products) = (gauge.axis.first_chunk::<N>()?, gauge.products.first_chunk_mut::<N>()?);
    let (axis, mut now) = (*axis, *products);
    let gauge = Gauge { axis: &axis, products: &mut now, ..gauge };
    let wound_up = gauge.note::<V, S>(residual, samples);
    *products = now;
    Some(wound_up)
}

impl<T: Real> Gauge<'_, T> {
    /// Notes all samples, one after the other, here and in the `residual`.
    #[inline(always)]
    fn note<'s, V: Vector<T>, S: Observed<'s, T>>(
        self,
        residual: &mut Residual<T>,
        samples: S,
    ) -> usize {
        let Self { variance, needed, information: [now, before], axis, products } = self;
        let (mut noise, mut sum, mut wound_up) = (*residual, *now, 0);
        for k in 0..samples.count() {
            if let Some(sample) = samples.get(k, axis.len()) {
                sum += note_rows::<T, V>(&sample, axis, products);
                noise.note(&sample);
            }
            // the information along w only grows: once it is enough it stays so
            wound_up += usize::from(!((sum + *before) * variance >= needed));
        }
        (*residual, *now) = (noise, sum);
        wound_up
    }
}

/// Adds (φ̃ w) φ̄ of each row of a sample to `products`; returns Σ (φ̃ w)².
#[inline(always)]
fn note_rows<T: Real, V: Vector<T>>(
    sample: &Observation<'_, T>,
    axis: &[T],
    products: &mut [T],
) -> T {
    let (n, mut sum) = (axis.len(), T::ZERO);
    for k in 0..sample.rows {
        let row = &sample.regressors[k * n..(k + 1) * n];
        let along = dot_of::<T, V>(row, axis);
        add_scaled_by::<T, V>(products, along, row);
        sum = along.mul_add(along, sum);
    }
    sum
}
