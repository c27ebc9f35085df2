//! The estimate within bounds: the θ of a box that is nearest in the metric of R = P⁻¹.
//!
//! It minimises (x − θ)ᵀ R (x − θ) for lower ≤ x ≤ upper, so that for a true θ* inside the box the error
//! (x − θ*)ᵀ R (x − θ*) is at most that of θ: a projection on a convex set brings nothing in it farther
//! away. Where one bound is active, x = θ − P eᵢ (θᵢ − b)/Pᵢᵢ. Bounds become active and inactive one by
//! one as in Lawson and Hanson 1974, chapter 23, here by their multipliers: R is never formed.

use crate::error::Error;
#[cfg(feature = "alloc")]
use alloc::vec;
use libm::sqrt;

/// How far, in standard deviations of a parameter, a bound may be missed by rounding.
const TOLERANCE: f64 = 1e-10;

/// The numbers that [`bounded_in`] works with, for n parameters.
pub const fn bounded_room(n: usize) -> usize {
    n * n + 5 * n
}

/// Moves `theta` (n,) into the box, in the metric of the inverse of `covariance` (n, n).
///
/// # Errors
/// [`Error`] names what does not fit, a lower bound above the upper one, or a covariance that is not
/// positive definite; `theta` is then as it was.
#[cfg(feature = "alloc")]
pub fn bounded(
    theta: &mut [f64],
    covariance: &[f64],
    lower: &[f64],
    upper: &[f64],
) -> Result<(), Error> {
    let mut room = vec![0.0; bounded_room(theta.len())];
    bounded_in(theta, covariance, (lower, upper), &mut room)
}

/// The same without an allocator: in at least [`bounded_room`] numbers of the caller's.
///
/// ```
/// use forgetting::{bounded_in, bounded_room};
///
/// let (mut theta, covariance) = ([-0.2, 1.0], [1.0, 0.5, 0.5, 1.0]);
/// let (lower, upper) = ([0.0, f64::NEG_INFINITY], [f64::INFINITY; 2]);
/// bounded_in(&mut theta, &covariance, (&lower, &upper), &mut [0.0; bounded_room(2)])?;
/// assert_eq!(theta, [0.0, 1.1]);
/// # Ok::<(), forgetting::Error>(())
/// ```
///
/// # Errors
/// As above.
pub fn bounded_in(
    theta: &mut [f64],
    covariance: &[f64],
    (lower, upper): (&[f64], &[f64]),
    room: &mut [f64],
) -> Result<(), Error> {
    let n = theta.len();
    Error::check_length("covariance", covariance.len(), n * n)?;
    Error::check_length("lower", lower.len(), n)?;
    Error::check_length("upper", upper.len(), n)?;
    for (i, (&own, bounds)) in theta.iter().zip(lower.iter().zip(upper)).enumerate() {
        check(i, own, at(covariance, i * n + i), (*bounds.0, *bounds.1))?;
    }
    let mut active = Active::new(n, covariance, room)?;
    active.follow(theta);
    // every round makes a bound active; that it takes more than one a parameter is rare
    for _ in 0..8 * n {
        if !active.take_most_missed(lower, upper) {
            break;
        }
        active.settle(theta)?;
        active.follow(theta);
    }
    for (i, own) in theta.iter_mut().enumerate() {
        // rounding may leave x a little outside
        *own = within(at(active.x, i), at(lower, i), at(upper, i));
    }
    Ok(())
}

fn check(i: usize, theta: f64, variance: f64, (lower, upper): (f64, f64)) -> Result<(), Error> {
    if !(lower <= upper) {
        return Err(Error::value("lower", lower, "at most the upper bound").at(i));
    }
    if lower == f64::INFINITY || upper == f64::NEG_INFINITY {
        return Err(Error::value("lower", lower, "bounds between which there is a number").at(i));
    }
    if !(variance > 0.0 && variance < f64::INFINITY) {
        return Err(Error::value("covariance", variance, "positive on its diagonal").at(i));
    }
    match theta.is_finite() {
        true => Ok(()),
        false => Err(Error::value("theta", theta, "finite").at(i)),
    }
}

/// The bounds sᵢxᵢ ≤ sᵢbᵢ that are active, with their multipliers. What is read and written by [`at`] and
/// [`put`] cannot panic.
struct Active<'a> {
    n: usize,
    covariance: &'a [f64],
    /// n x n
    system: &'a mut [f64],
    /// s: 1 for an upper bound, −1 for a lower one, 0 where none is active
    sign: &'a mut [f64],
    /// b
    value: &'a mut [f64],
    multiplier: &'a mut [f64],
    /// multipliers for which all active parameters are on their bounds, of whatever sign
    wanted: &'a mut [f64],
    x: &'a mut [f64],
}

impl<'a> Active<'a> {
    /// None, for n parameters.
    fn new(n: usize, covariance: &'a [f64], room: &'a mut [f64]) -> Result<Self, Error> {
        let (length, expected) = (room.len(), bounded_room(n));
        room.fill(0.0);
        Self::parts(n, covariance, room).ok_or(Error::Length {
            parameter: "room",
            length,
            expected,
        })
    }

    fn parts(n: usize, covariance: &'a [f64], room: &'a mut [f64]) -> Option<Self> {
        let (system, rest) = room.split_at_mut_checked(n * n)?;
        let (sign, rest) = rest.split_at_mut_checked(n)?;
        let (value, rest) = rest.split_at_mut_checked(n)?;
        let (multiplier, rest) = rest.split_at_mut_checked(n)?;
        let (wanted, rest) = rest.split_at_mut_checked(n)?;
        let (x, _) = rest.split_at_mut_checked(n)?;
        Some(Self { n, covariance, system, sign, value, multiplier, wanted, x })
    }

    /// Makes the bound active that is missed most, in standard deviations; whether there was one.
    fn take_most_missed(&mut self, lower: &[f64], upper: &[f64]) -> bool {
        let (mut most, mut found) = (TOLERANCE, None);
        for i in (0..self.n).filter(|&i| at(self.sign, i) == 0.0) {
            let x = at(self.x, i);
            let value = within(x, at(lower, i), at(upper, i));
            let missed = (x - value) / sqrt(at(self.covariance, i * self.n + i));
            if missed.abs() > most {
                most = missed.abs();
                found = Some((i, if missed > 0.0 { 1.0 } else { -1.0 }, value));
            }
        }
        let Some((i, sign, value)) = found else { return false };
        put(self.sign, i, sign);
        put(self.value, i, value);
        put(self.multiplier, i, 0.0);
        true
    }

    /// Finds the multipliers that put all active parameters on their bounds; a bound that would have
    /// to pull is active no longer.
    fn settle(&mut self, theta: &[f64]) -> Result<(), Error> {
        loop {
            self.find_wanted(theta)?;
            let (mut step, mut leaving) = (1.0, None);
            for i in (0..self.n).filter(|&i| at(self.sign, i) != 0.0) {
                let (own, new) = (at(self.multiplier, i), at(self.wanted, i));
                // how far towards `new` the multiplier stays positive
                let reach = (own / (own - new)).max(0.0);
                if !(new > 0.0 || reach > step) {
                    (step, leaving) = (reach, Some(i));
                }
            }
            for (own, new) in self.multiplier.iter_mut().zip(&*self.wanted) {
                *own += step * (new - *own);
            }
            let Some(i) = leaving else { return Ok(()) };
            put(self.sign, i, 0.0);
            put(self.multiplier, i, 0.0);
        }
    }

    /// Solves for the multipliers; those of bounds that are not active are 0.
    fn find_wanted(&mut self, theta: &[f64]) -> Result<(), Error> {
        let n = self.n;
        for i in 0..n {
            let sign = at(self.sign, i);
            put(self.wanted, i, sign * (at(theta, i) - at(self.value, i)));
            for j in 0..n {
                let both = sign * at(self.sign, j);
                let alone = if i == j { 1.0 } else { 0.0 };
                let element =
                    if both == 0.0 { alone } else { both * at(self.covariance, i * n + j) };
                put(self.system, i * n + j, element);
            }
        }
        solve(self.system, self.wanted)
    }

    /// x = θ − P Cᵀμ
    fn follow(&mut self, theta: &[f64]) {
        for i in 0..self.n {
            let mut x = at(theta, i);
            for j in (0..self.n).filter(|&j| at(self.sign, j) != 0.0) {
                let pull = at(self.sign, j) * at(self.multiplier, j);
                x -= at(self.covariance, j * self.n + i) * pull;
            }
            put(self.x, i, x);
        }
    }
}

/// Overwrites `right` by the solution of a symmetric positive definite system, by elimination.
fn solve(system: &mut [f64], right: &mut [f64]) -> Result<(), Error> {
    let n = right.len();
    for k in 0..n {
        let pivot = at(system, k * n + k);
        if !(pivot > 0.0) {
            let (parameter, allowed) = ("covariance", "positive definite");
            return Err(Error::Indefinite { parameter, pivot, allowed });
        }
        for i in k + 1..n {
            let factor = at(system, i * n + k) / pivot;
            for j in k..n {
                let reduced = at(system, i * n + j) - factor * at(system, k * n + j);
                put(system, i * n + j, reduced);
            }
            put(right, i, at(right, i) - factor * at(right, k));
        }
    }
    for k in (0..n).rev() {
        let known: f64 = (k + 1..n).map(|j| at(system, k * n + j) * at(right, j)).sum();
        put(right, k, (at(right, k) - known) / at(system, k * n + k));
    }
    Ok(())
}

/// x between two bounds, the lower one first.
fn within(x: f64, lower: f64, upper: f64) -> f64 {
    if x < lower {
        lower
    } else if x > upper {
        upper
    } else {
        x
    }
}

fn at(numbers: &[f64], i: usize) -> f64 {
    numbers.get(i).copied().unwrap_or(f64::NAN)
}

fn put(numbers: &mut [f64], i: usize, x: f64) {
    if let Some(place) = numbers.get_mut(i) {
        *place = x;
    }
}
