//! Measurements of more than ten parameters: sweeps over the tiles of U.

use super::bounds::{adds, make_room};
use super::{Measure, Place};
use crate::kernel::along::Room;
use crate::kernel::bierman::{self, largest};
use crate::kernel::dispatch::Kernel;
use crate::kernel::form::Form;
use crate::kernel::measured::Measured;
use crate::number::vector::Vector;
use crate::number::Real;

/// In any form.
pub struct Many<'a, T>(pub Measure<'a, T>);

impl<T: Real> Kernel<T> for Many<'_, T> {
    type Output = Option<Measured<T>>;

    #[inline(always)]
    fn size(&self) -> usize {
        self.0.f.len()
    }

    #[inline(always)]
    fn run<V: Vector<T>, const GROUP: usize>(mut self) -> Option<Measured<T>> {
        let Measure { ref mut place, form, f, squares, .. } = self.0;
        let measured = measure::<T, V, GROUP>(place, form, f, squares)?;
        self.0.correct::<V>(&measured);
        Some(measured)
    }
}

/// Forgets and measures, unless there is no room for P.
#[inline(always)]
pub fn measure<T: Real, V: Vector<T>, const GROUP: usize>(
    place: &mut Place<'_, T>,
    form: Form<T>,
    f: &[T],
    squares: T,
) -> Option<Measured<T>> {
    let growth = match form {
        Form::Scale { growth } => growth,
        Form::Along { weight, .. } => match along::<T, V, GROUP>(place, weight, f, squares)? {
            Some(measured) => return Some(measured),
            None => T::ONE,
        },
        // of few parameters only
        Form::Walk { .. } => return None,
    };
    make_room(place.bound, growth, T::ZERO)?;
    Some(scale::<T, V, GROUP>(place, growth, f))
}

/// Forgets along f and measures it; nothing where there is nothing to forget.
#[inline(always)]
fn along<T: Real, V: Vector<T>, const GROUP: usize>(
    place: &mut Place<'_, T>,
    weight: T,
    f: &[T],
    squares: T,
) -> Option<Option<Measured<T>>> {
    let (n, (full, rest)) = (f.len(), T::chunks(f));
    let (gain, scratch) = place.scratch.split_at_mut(n.div_ceil(T::ROWS) * T::ROWS);
    let mut room = Room::<T, 1, 2>::of(scratch, n);
    for (t, [to]) in room.f.iter_mut().enumerate() {
        *to = match full.get(t) {
            Some(chunk) => *chunk,
            None => T::chunk(rest),
        };
    }
    room.look::<V, GROUP>(place.columns, place.diagonal);
    let information = room.information::<V::BlockVector, 0>();
    let c = weight / information;
    if !adds(c) {
        return Some(None);
    }
    make_room(place.bound, T::ONE, c * squares)?;
    let measured = room.add_and_measure::<V::BlockVector, 0>(information / weight, information).0;
    room.carry_out::<V, GROUP>(place.columns, place.diagonal);
    for (t, to) in T::chunks_mut(gain).0.iter_mut().enumerate() {
        *to = *room.gain(0, t);
    }
    Some(Some(measured))
}

#[inline(always)]
fn scale<T: Real, V: Vector<T>, const GROUP: usize>(
    place: &mut Place<'_, T>,
    growth: T,
    f: &[T],
) -> Measured<T> {
    let k = &mut place.scratch[..f.len()];
    let (columns, diagonal) = (&mut *place.columns, &mut *place.diagonal);
    let chain = bierman::scale_and_measure::<T, V, GROUP>(columns, diagonal, growth, f, k);
    chain.measured(largest(place.diagonal), growth > T::ONE)
}
