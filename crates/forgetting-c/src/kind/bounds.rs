//! The estimate within bounds, with numbers on the stack.

use super::{Head, Kind, Outcome};
use crate::code::Code;
use crate::model::Float;
use forgetting::{bounded_in, bounded_room};

/// The numbers of one size.
macro_rules! of_size {
    ($n:literal, $kind:expr, $head:expr, $bounds:expr, $theta:expr) => {
        of::<_, $n, { $n * $n }, { bounded_room($n) }>($kind, $head, $bounds, $theta)
    };
}

/// Writes to `theta` (n,) the θ of the estimator at `head` within these bounds; null for none.
///
/// # Safety
/// It is one of this kind, of this type of number and of as many parameters, and bounds are as many.
pub(crate) unsafe fn bounded<T: Float>(
    kind: &Kind,
    head: *mut Head,
    bounds: (*const T, *const T),
    theta: &mut [T],
) -> Outcome {
    // SAFETY: as above.
    unsafe {
        match theta.len() {
            ..=8 => of_size!(8, kind, head, bounds, theta),
            // the most that any kind has
            #[cfg(feature = "general")]
            ..=32 => of_size!(32, kind, head, bounds, theta),
            _ => Err(Code::Length.into()),
        }
    }
}

unsafe fn of<T: Float, const N: usize, const SQUARE: usize, const ROOM: usize>(
    kind: &Kind,
    head: *mut Head,
    (lower, upper): (*const T, *const T),
    theta: &mut [T],
) -> Outcome {
    let n = theta.len();
    let (mut p, mut own) = ([T::ZERO; SQUARE], [T::ZERO; N]);
    // SAFETY: the caller says so, and n is at most N.
    let (lower, upper) = unsafe {
        (kind.theta)(head, own.as_mut_ptr().cast());
        (kind.covariance)(head, p.as_mut_ptr().cast());
        (read::<T, N>(lower, n, f64::NEG_INFINITY), read::<T, N>(upper, n, f64::INFINITY))
    };
    let (p, mut moved) = (p.map(T::to_f64), own.map(T::to_f64));
    let (Some(moved), Some(p)) = (moved.get_mut(..n), p.get(..n * n)) else {
        return Err(Code::Length.into());
    };
    let bounds = (lower.get(..n).unwrap_or_default(), upper.get(..n).unwrap_or_default());
    bounded_in(moved, p, bounds, &mut [0.0; ROOM])?;
    for (place, &x) in theta.iter_mut().zip(&*moved) {
        *place = T::from_f64(x);
    }
    Ok(())
}

/// n numbers, or `without` where there are none.
///
/// # Safety
/// `numbers` is null or there are n.
unsafe fn read<T: Float, const N: usize>(numbers: *const T, n: usize, without: f64) -> [f64; N] {
    let mut all = [without; N];
    if !numbers.is_null() {
        for (i, place) in all.iter_mut().take(n).enumerate() {
            // SAFETY: as above.
            *place = unsafe { numbers.add(i).read() }.to_f64();
        }
    }
    all
}
