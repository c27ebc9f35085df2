//! The estimate within bounds: the θ of a box that is nearest in the metric of R = P⁻¹.
//!
//! It minimises (x − θ)ᵀ R (x − θ) for lower ≤ x ≤ upper, so that for a true θ* inside the box the error
//! (x − θ*)ᵀ R (x − θ*) is at most that of θ: a projection on a convex set brings nothing in it farther
//! away. Where one bound is active, x = θ − P eᵢ (θᵢ − b)/Pᵢᵢ. Bounds become active and inactive one by
//! one as in Lawson and Hanson 1974, chapter 23, here by their multipliers: R is never formed.

use crate::error::Error;
use alloc::vec;
use alloc::vec::Vec;
use libm::sqrt;

/// How far, in standard deviations of a parameter, a bound may be missed by rounding.
const TOLERANCE: f64 = 1e-10;

/// Moves `theta` (n,) into the box, in the metric of the inverse of `covariance` (n, n).
///
/// # Errors
/// [`Error`] names what does not fit, a lower bound above the upper one, or a covariance that is not
/// positive definite; `theta` is then as it was.
pub fn bounded(
    theta: &mut [f64],
    covariance: &[f64],
    lower: &[f64],
    upper: &[f64],
) -> Result<(), Error> {
    let n = theta.len();
    Error::check_length("covariance", covariance.len(), n * n)?;
    Error::check_length("lower", lower.len(), n)?;
    Error::check_length("upper", upper.len(), n)?;
    for i in 0..n {
        check(i, theta[i], covariance[i * n + i], (lower[i], upper[i]))?;
    }
    let mut active = Active { covariance, n, bounds: Vec::new() };
    let mut x = theta.to_vec();
    // every round makes a bound active; that it takes more than one a parameter is rare
    for _ in 0..8 * n {
        let Some(bound) = active.most_missed(&x, lower, upper) else { break };
        active.bounds.push(bound);
        active.settle(theta)?;
        x = active.moved(theta);
    }
    for (i, own) in theta.iter_mut().enumerate() {
        // rounding may leave x a little outside
        *own = x[i].clamp(lower[i], upper[i]);
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

/// A bound sᵢxᵢ ≤ sᵢb that is active, with its multiplier.
#[derive(Clone, Copy)]
struct Bound {
    parameter: usize,
    /// 1 for an upper bound, −1 for a lower one
    sign: f64,
    value: f64,
    multiplier: f64,
}

struct Active<'a> {
    covariance: &'a [f64],
    n: usize,
    bounds: Vec<Bound>,
}

impl Active<'_> {
    /// The bound that is missed most, in standard deviations.
    fn most_missed(&self, x: &[f64], lower: &[f64], upper: &[f64]) -> Option<Bound> {
        let (mut most, mut found) = (TOLERANCE, None);
        for i in (0..self.n).filter(|&i| !self.bounds.iter().any(|bound| bound.parameter == i)) {
            let value = x[i].clamp(lower[i], upper[i]);
            let missed = (x[i] - value) / sqrt(self.covariance[i * self.n + i]);
            if missed.abs() > most {
                let sign = if missed > 0.0 { 1.0 } else { -1.0 };
                most = missed.abs();
                found = Some(Bound { parameter: i, sign, value, multiplier: 0.0 });
            }
        }
        found
    }

    /// Finds the multipliers that put all active parameters on their bounds; a bound that would have
    /// to pull is active no longer.
    fn settle(&mut self, theta: &[f64]) -> Result<(), Error> {
        while !self.bounds.is_empty() {
            let wanted = self.multipliers(theta)?;
            let (mut step, mut leaving) = (1.0, None);
            for (k, (bound, &new)) in self.bounds.iter().zip(&wanted).enumerate() {
                // how far towards `new` the multiplier stays positive
                let reach = (bound.multiplier / (bound.multiplier - new)).max(0.0);
                if !(new > 0.0 || reach > step) {
                    (step, leaving) = (reach, Some(k));
                }
            }
            for (bound, new) in self.bounds.iter_mut().zip(&wanted) {
                bound.multiplier += step * (new - bound.multiplier);
            }
            match leaving {
                None => return Ok(()),
                Some(k) => self.bounds.remove(k),
            };
        }
        Ok(())
    }

    /// Those for which all active parameters are on their bounds, of whatever sign.
    fn multipliers(&self, theta: &[f64]) -> Result<Vec<f64>, Error> {
        let count = self.bounds.len();
        let mut system = vec![0.0; count * count];
        let mut right = vec![0.0; count];
        for (j, one) in self.bounds.iter().enumerate() {
            right[j] = one.sign * (theta[one.parameter] - one.value);
            for (k, other) in self.bounds.iter().enumerate() {
                let element = self.covariance[one.parameter * self.n + other.parameter];
                system[j * count + k] = one.sign * other.sign * element;
            }
        }
        solve(&mut system, &mut right)?;
        Ok(right)
    }

    /// θ − P Cᵀμ
    fn moved(&self, theta: &[f64]) -> Vec<f64> {
        let mut x = theta.to_vec();
        for bound in &self.bounds {
            let pull = bound.sign * bound.multiplier;
            let column = &self.covariance[bound.parameter * self.n..(bound.parameter + 1) * self.n];
            x.iter_mut().zip(column).for_each(|(own, element)| *own -= element * pull);
        }
        x
    }
}

/// Overwrites `right` by the solution of a symmetric positive definite system, by elimination.
fn solve(system: &mut [f64], right: &mut [f64]) -> Result<(), Error> {
    let n = right.len();
    for k in 0..n {
        let pivot = system[k * n + k];
        if !(pivot > 0.0) {
            let (parameter, allowed) = ("covariance", "positive definite");
            return Err(Error::Indefinite { parameter, pivot, allowed });
        }
        for i in k + 1..n {
            let factor = system[i * n + k] / pivot;
            for j in k..n {
                system[i * n + j] -= factor * system[k * n + j];
            }
            right[i] -= factor * right[k];
        }
    }
    for k in (0..n).rev() {
        let known: f64 = (k + 1..n).map(|j| system[k * n + j] * right[j]).sum();
        right[k] = (right[k] - known) / system[k * n + k];
    }
    Ok(())
}
