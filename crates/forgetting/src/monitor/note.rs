//! Samples, as the watch takes note of them: all that come between two looks at P in one go.

use super::residual::Residual;
use super::silence::Silence;
use super::Seen;
use crate::factor::kernel::{add_scaled_by, dot_of, FEW};
use crate::vector::Vector;
use crate::{Kernel, Real};

/// Takes note of samples, none where one was left out; gives how many of them, from the first on,
/// left P wound up.
pub(super) struct Note<'a, T, I> {
    pub samples: I,
    pub residual: &'a mut Residual<T>,
    pub gauge: Gauge<'a, T>,
    pub silence: Silence<'a, T>,
}

/// What the weakest direction is told, and when that is enough.
pub(super) struct Gauge<'a, T> {
    /// σ²
    pub variance: T,
    /// the share that w must be told of to end windup: 0 where there is none
    pub needed: T,
    /// Σ (φ̃ w)² in this block and in the one before
    pub information: &'a mut [T; 2],
    /// S w
    pub axis: &'a [T],
    /// Σ (φ̃ w) φ̄ in this block
    pub told: &'a mut [T],
}

impl<'s, T, I> Kernel<T> for Note<'_, T, I>
where
    T: Real,
    I: Clone + ExactSizeIterator<Item = Option<Seen<'s, T>>> + DoubleEndedIterator,
{
    type Output = usize;

    #[inline(always)]
    fn size(&self) -> usize {
        self.gauge.axis.len()
    }

    #[inline(always)]
    fn run<V: Vector<T>, const GROUP: usize>(self) -> usize {
        let n = self.size();
        // wide vectors are for many: without this they would be compiled for few, too
        if GROUP < 8 && n <= FEW {
            with_few!(n, few::<T, V, I>(self)).unwrap_or(0)
        } else {
            self.silence.note::<V, I>(&self.samples);
            self.gauge.note::<V>(self.residual, self.samples)
        }
    }
}

/// For at most ten parameters: what changes stays in registers, and constant bounds unroll.
#[inline(always)]
fn few<'s, T, V, I, const N: usize>(task: Note<'_, T, I>) -> Option<usize>
where
    T: Real,
    V: Vector<T>,
    I: Clone + ExactSizeIterator<Item = Option<Seen<'s, T>>> + DoubleEndedIterator,
{
    let Note { samples, residual, gauge, silence: Silence { variances, least, since } } = task;
    let (variances, since) = (variances.first_chunk::<N>()?, since.first_chunk_mut::<N>()?);
    Silence { variances, least, since }.note::<V, I>(&samples);
    let (axis, told) = (gauge.axis.first_chunk::<N>()?, gauge.told.first_chunk_mut::<N>()?);
    let (axis, mut now) = (*axis, *told);
    let wound_up = Gauge { axis: &axis, told: &mut now, ..gauge }.note::<V>(residual, samples);
    *told = now;
    Some(wound_up)
}

impl<T: Real> Gauge<'_, T> {
    /// Takes note of all samples, one after the other, here and in the `residual`.
    #[inline(always)]
    fn note<'s, V: Vector<T>>(
        self,
        residual: &mut Residual<T>,
        samples: impl Iterator<Item = Option<Seen<'s, T>>>,
    ) -> usize {
        let Self { variance, needed, information: [now, before], axis, told } = self;
        let (mut noise, mut sum, mut wound_up) = (*residual, *now, 0);
        for seen in samples {
            if let Some(seen) = seen {
                sum += note_rows::<T, V>(&seen, axis, told);
                noise.note(&seen);
            }
            // what w is told only grows: once it is enough it stays so
            wound_up += usize::from(!((sum + *before) * variance >= needed));
        }
        (*residual, *now) = (noise, sum);
        wound_up
    }
}

/// Adds (φ̃ w) φ̄ of each row of a sample to `told`; gives Σ (φ̃ w)².
#[inline(always)]
fn note_rows<T: Real, V: Vector<T>>(seen: &Seen<'_, T>, axis: &[T], told: &mut [T]) -> T {
    let (n, mut sum) = (axis.len(), T::ZERO);
    for k in 0..seen.rows {
        let row = &seen.regressors[k * n..(k + 1) * n];
        let along = dot_of::<T, V>(row, axis);
        add_scaled_by::<T, V>(told, along, row);
        sum = along.mul_add(along, sum);
    }
    sum
}
