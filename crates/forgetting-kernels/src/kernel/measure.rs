//! One row of one sample: forgetting in one of the forms of [`Form`], the measurement and the
//! correction of θ, for any number of targets.

use super::along::Room;
use super::bierman::{self, largest};
use super::layout::{COMPACT, FEW};
use super::registers::floor::far_before;
use super::registers::{Gain, InPlace, Small, Unit};
use super::vectors::add_scaled_by;
use crate::kernel::dispatch::Kernel;
use crate::kernel::form::{shrink, Form};
use crate::kernel::measured::Measured;
use crate::number::lane::One;
use crate::number::vector::{StreamVector, Vector};
use crate::number::{copy_some, Real};

/// The factor and what goes with it.
pub struct Place<'a, T> {
    /// U, in tiles
    pub columns: &'a mut [T],
    /// D
    pub diagonal: &'a mut [T],
    /// [`scratch`](super::scratch) numbers; P·fᵀ, with the P just before the measurement, comes first
    pub scratch: &'a mut [T],
    /// at least the trace of P
    pub bound: &'a mut T,
}

/// Forgets, measures f and corrects the n numbers of `theta` for each of `errors`, unless there
/// is no room for P; `f` has the squared length `squares`.
pub struct Measure<'a, T> {
    /// the factor
    pub place: Place<'a, T>,
    /// how to forget
    pub form: Form<T>,
    /// the regressor, n numbers
    pub f: &'a [T],
    /// ‖f‖²
    pub squares: T,
    /// θ
    pub theta: &'a mut [T],
    /// one for each target
    pub errors: &'a [T],
}

impl<T: Real> Kernel<T> for Measure<'_, T> {
    type Output = Option<Measured<T>>;

    #[inline(always)]
    fn size(&self) -> usize {
        self.f.len()
    }

    #[inline(always)]
    fn run<V: Vector<T>, const GROUP: usize>(mut self) -> Option<Measured<T>> {
        let n = self.f.len();
        let Self { ref mut place, form, f, squares, .. } = self;
        // wide vectors are for many: without this they would be compiled for few, too
        let measured = if GROUP < 8 && n <= FEW {
            few::<T, V>(place, form, f, squares)?
        } else {
            many::<T, V, GROUP>(place, form, f, squares)?
        };
        for (target, theta) in self.theta.chunks_exact_mut(n).enumerate() {
            let error = self.errors[target];
            add_scaled_by::<T, V>(theta, error * measured.inverse_variance, &place.scratch[..n]);
        }
        Some(measured)
    }
}

/// Whether P may grow so; if so, the bound of its trace follows.
#[inline(always)]
fn make_room<T: Real>(bound: &mut T, growth: T, added: T) -> Option<()> {
    let grown = *bound * growth + added;
    (grown < T::CEILING).then(|| *bound = grown)
}

/// For at most ten parameters.
#[inline(always)]
fn few<T: Real, V: Vector<T>>(
    place: &mut Place<'_, T>,
    form: Form<T>,
    f: &[T],
    squares: T,
) -> Option<Measured<T>> {
    if COMPACT {
        return of_any::<T, V>(place, form, f, squares);
    }
    with_few!(f.len(), of::<T, V>(place, form, f, squares))
}

/// One kernel for all of them.
#[inline(always)]
fn of_any<T: Real, V: Vector<T>>(
    Place { columns, diagonal, scratch, bound }: &mut Place<'_, T>,
    form: Form<T>,
    f: &[T],
    squares: T,
) -> Option<Measured<T>> {
    let (n, mut padded, mut d) = (f.len(), [T::ZERO; FEW], [T::ONE; FEW]);
    copy_some(&mut padded, f);
    copy_some(&mut d, diagonal);
    let mut small = Small { u: InPlace::of_some(columns, n), d };
    let (gain, forgot) = gain::<T, V, FEW>(&mut small, bound, form, (&padded, squares))?;
    diagonal.copy_from_slice(&small.d[..n]);
    scratch[..n].copy_from_slice(&gain.k[..n]);
    Some(measured(&gain, forgot))
}

#[inline(always)]
fn of<T: Real, V: Vector<T>, const N: usize>(
    Place { columns, diagonal, scratch, bound }: &mut Place<'_, T>,
    form: Form<T>,
    f: &[T],
    squares: T,
) -> Option<Measured<T>> {
    let (f, d) = (f.first_chunk::<N>()?, diagonal.first_chunk_mut::<N>()?);
    let mut small = Small { u: InPlace::of::<N>(columns), d: *d };
    let (gain, forgot) = gain::<T, V, N>(&mut small, bound, form, (f, squares))?;
    *d = small.d;
    let k = &mut scratch[..N];
    for i in 0..N {
        k[i] = gain.k[i];
    }
    Some(measured(&gain, forgot))
}

/// Forgets in this form and measures.
#[inline(always)]
fn gain<T: Real, V: Vector<T>, const N: usize>(
    small: &mut Small<T, N, InPlace<'_, T>>,
    bound: &mut T,
    form: Form<T>,
    sample: (&[T; N], T),
) -> Option<(Gain<T, N>, bool)> {
    let bounds = &mut Bounds { tight: *bound, kept: bound };
    match form {
        Form::Scale { growth } => {
            scale::<T, T, _, N, true>(small, bounds, growth, sample, T::FLOOR)
        }
        Form::Along { weight, .. } => {
            along::<T, T, _, N, true>(small, bounds, weight, sample, T::FLOOR)
        }
        Form::Walk { noise, per_bound } => {
            let noise = (noise, per_bound);
            walk::<T, T, V::StreamVector, _, N, true>(small, bounds, noise, sample, T::FLOOR)
        }
    }
}

#[inline(always)]
fn measured<T: Real, const N: usize>(gain: &Gain<T, N>, forgot: bool) -> Measured<T> {
    let &Gain { s: leverage, a: variance, inverse_a: inverse_variance, largest, .. } = gain;
    Measured { leverage, variance, inverse_variance, largest, forgot }
}

/// Scales P and measures f with the squared length `squares` in registers, unless there is no room;
/// says whether anything was forgotten.
///
/// Unless `NEAR` it does nothing, either, where an element of D may come near its floor; all of them
/// are at least `least`.
#[inline(always)]
pub fn scale<T: Real, A: One<T>, U: Unit<A, N>, const N: usize, const NEAR: bool>(
    small: &mut Small<A, N, U>,
    bounds: &mut Bounds<'_, T>,
    growth: T,
    (f, squares): (&[A; N], T),
    least: T,
) -> Option<(Gain<A, N>, bool)> {
    bounds.grow::<NEAR>((growth, T::ZERO), (least, squares))?;
    let gain = small.scale_and_measure::<T, NEAR>(A::splat(growth), f);
    Some((gain, growth > T::ONE))
}

/// The same with forgetting along f.
#[inline(always)]
pub fn along<T: Real, A: One<T>, U: Unit<A, N>, const N: usize, const NEAR: bool>(
    small: &mut Small<A, N, U>,
    bounds: &mut Bounds<'_, T>,
    weight: T,
    (f, squares): (&[A; N], T),
    least: T,
) -> Option<(Gain<A, N>, bool)> {
    let (one, zero) = (A::splat(T::ONE), A::splat(T::ZERO));
    let mut along = small.along(f);
    let information = along.information.get();
    let c = weight / information;
    if !adds(c) {
        bounds.grow::<NEAR>((T::ONE, T::ZERO), (least, squares))?;
        (along.z, along.q) = ([zero; N], [zero; N]);
        return Some((small.add_and_measure::<T, NEAR>((zero, one), &along, f), false));
    }
    bounds.grow::<NEAR>((T::ONE, c * squares), (least, squares))?;
    let added = (A::splat(c), A::splat(information / weight));
    Some((small.add_and_measure::<T, NEAR>(added, &along, f), true))
}

/// The same with the same variance added to every parameter.
#[inline(always)]
pub fn walk<T, A, L, U, const N: usize, const NEAR: bool>(
    small: &mut Small<A, N, U>,
    bounds: &mut Bounds<'_, T>,
    (noise, per_bound): (T, T),
    (f, squares): (&[A; N], T),
    least: T,
) -> Option<(Gain<A, N>, bool)>
where
    T: Real,
    A: One<T>,
    L: StreamVector<T>,
    U: Unit<A, N>,
{
    let shrink = shrink::<T, T>(noise, per_bound);
    let added = noise * T::from_f64(small.u.count() as f64);
    bounds.grow::<NEAR>((shrink, added), (least * shrink, squares))?;
    small.walk_by_columns::<T, L>(shrink, noise);
    let gain = small.scale_and_measure::<T, NEAR>(A::splat(T::ONE), f);
    Some((gain, noise > T::ZERO))
}

/// Two numbers that are at least the trace of P.
pub struct Bounds<'a, T> {
    /// the one that the factor keeps, by which there is room for P or not
    pub kept: &'a mut T,
    /// one that may be much smaller, by which D stays far from its floor or not
    pub tight: T,
}

impl<T: Real> Bounds<'_, T> {
    /// Both follow P as it grows, if there is room and, unless `NEAR`, no element of D, at least
    /// `least`, may come near its floor when a regressor with this ‖f‖² is measured.
    #[inline(always)]
    fn grow<const NEAR: bool>(
        &mut self,
        (growth, added): (T, T),
        (least, squares): (T, T),
    ) -> Option<()> {
        let (kept, tight) = (*self.kept * growth + added, self.tight * growth + added);
        if !(kept < T::CEILING && (NEAR || far_before(least, tight, squares))) {
            return None;
        }
        (*self.kept, self.tight) = (kept, tight);
        Some(())
    }
}

/// Whether c·fᵀf is to be added: not for λ = 1 or f = 0, nor for more information than the number
/// type can hold.
#[inline(always)]
pub fn adds<T: Real>(c: T) -> bool {
    c > T::ZERO && c.is_finite()
}

/// For more than ten.
#[inline(always)]
pub fn many<T: Real, V: Vector<T>, const GROUP: usize>(
    place: &mut Place<'_, T>,
    form: Form<T>,
    f: &[T],
    squares: T,
) -> Option<Measured<T>> {
    let growth = match form {
        Form::Scale { growth } => growth,
        Form::Along { weight, .. } => match along_many::<T, V, GROUP>(place, weight, f, squares)? {
            Some(measured) => return Some(measured),
            None => T::ONE,
        },
        // of few parameters only
        Form::Walk { .. } => return None,
    };
    make_room(place.bound, growth, T::ZERO)?;
    Some(scale_many::<T, V, GROUP>(place, growth, f))
}

/// Forgets along f and measures it; nothing where there is nothing to forget.
#[inline(always)]
fn along_many<T: Real, V: Vector<T>, const GROUP: usize>(
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
fn scale_many<T: Real, V: Vector<T>, const GROUP: usize>(
    place: &mut Place<'_, T>,
    growth: T,
    f: &[T],
) -> Measured<T> {
    let k = &mut place.scratch[..f.len()];
    let (columns, diagonal) = (&mut *place.columns, &mut *place.diagonal);
    let chain = bierman::scale_and_measure::<T, V, GROUP>(columns, diagonal, growth, f, k);
    chain.measured(largest(place.diagonal), growth > T::ONE)
}
