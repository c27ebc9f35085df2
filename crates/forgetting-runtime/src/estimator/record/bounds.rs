//! Bounds that the recursion itself keeps to: θ is moved inside after a sample, and goes on from there.

use crate::error::Error;
use crate::number::{Number, View};
use crate::shape;
use forgetting::{bounded, bounded_in, bounded_room, AnyEstimator, Memory};

/// The smallest and the largest value of each parameter, (n,) each; infinite where there is none.
#[derive(Clone, Copy, Debug)]
pub struct Bounds<'a> {
    /// the smallest
    pub lower: View<'a>,
    /// the largest
    pub upper: View<'a>,
}

/// The same, checked, with room to work in.
pub(crate) struct RecordBounds {
    lower: Vec<f64>,
    upper: Vec<f64>,
    theta: Vec<f64>,
    covariance: Vec<f64>,
    room: Vec<f64>,
}

impl RecordBounds {
    /// Those of `bounds` for an estimator of one target.
    ///
    /// # Errors
    /// [`Error`] names the bound that does not fit, or says that there are several targets.
    pub fn read<T: Number>(
        bounds: &Bounds<'_>,
        estimator: &AnyEstimator<T>,
    ) -> Result<Self, Error> {
        let memory = estimator.prior().memory();
        let n = memory.parameters();
        if memory.targets() > 1 {
            return Err(Error::unsupported("bounds go with one target"));
        }
        shape::check("lower", bounds.lower.shape(), &[n], &[])?;
        shape::check("upper", bounds.upper.shape(), &[n], &[])?;
        // as the estimator can hold them
        let read = |view: View<'_>| T::read(view.numbers()).iter().map(|x| x.to_f64()).collect();
        let (lower, upper): (Vec<f64>, Vec<f64>) = (read(bounds.lower), read(bounds.upper));
        let mut unit = vec![0.0; n * n];
        unit.iter_mut().step_by(n + 1).for_each(|own| *own = 1.0);
        bounded(&mut vec![0.0; n], &unit, &lower, &upper)?;
        let room = vec![0.0; bounded_room(n)];
        Ok(Self { lower, upper, theta: vec![0.0; n], covariance: unit, room })
    }

    /// Moves θ of the estimator inside, nearest in the metric of P⁻¹; every parameter by itself where P
    /// is not positive definite as it was rounded.
    ///
    /// # Errors
    /// Those of `AnyEstimator::set_theta`.
    pub fn hold<T: Number>(
        &mut self,
        estimator: &mut AnyEstimator<T>,
    ) -> Result<(), forgetting::Error> {
        let bounds = || self.lower.iter().zip(&self.upper);
        let mut inside = estimator.theta().iter().zip(bounds());
        if inside.all(|(x, (&lower, &upper))| (lower..=upper).contains(&x.to_f64())) {
            return Ok(());
        }
        self.theta.iter_mut().zip(estimator.theta()).for_each(|(own, x)| *own = x.to_f64());
        let factor = estimator.express(estimator.factor());
        let mut dense = vec![T::ZERO; self.covariance.len()];
        factor.reconstruct(&mut dense);
        self.covariance.iter_mut().zip(&dense).for_each(|(own, x)| *own = x.to_f64());
        let box_ = (&self.lower[..], &self.upper[..]);
        if bounded_in(&mut self.theta, &self.covariance, box_, &mut self.room).is_err() {
            let each = self.theta.iter_mut().zip(self.lower.iter().zip(&self.upper));
            each.for_each(|(own, (&lower, &upper))| *own = own.clamp(lower, upper));
        }
        let theta: Vec<T> = self.theta.iter().map(|&x| T::from_f64(x)).collect();
        estimator.set_theta(&theta)
    }
}
