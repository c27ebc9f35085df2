//! A model of whose parameters something is known.

use super::super::known::{Given, Known};
use super::super::origin::Origin;
use super::Polynomial;
use crate::error::Error;

impl Polynomial {
    /// The same at rest where something is known of its parameters, in the order of θ: θ begins there. A
    /// constant of which something is known is that of signals measured from zero.
    ///
    /// # Errors
    /// [`Error`] names the value that is not finite, or says that C or F is unstable with these values,
    /// or that nothing is left to estimate.
    pub fn knowing(mut self, given: &[Given]) -> Result<Self, Error> {
        Error::check_length("given", given.len(), self.theta.len())?;
        self.known = Known::new(given)?;
        let theta = self.known.values.clone();
        if !self.keeps_stable(&theta) {
            let reason = "C or F is unstable with the values that are known of its coefficients";
            return Err(Error::Unsupported { reason });
        }
        self.theta = theta;
        let from_zero = given[self.layout.constant.clone()].iter().any(|x| *x != Given::Nothing);
        self.origin = Origin::new(self.orders.inputs.len(), self.orders.constant && !from_zero);
        self.set_filters();
        Ok(self)
    }

    /// What is known of each parameter.
    #[must_use]
    pub fn given(&self) -> &[Given] {
        &self.known.given
    }

    /// Whether anything is known.
    #[must_use]
    pub fn is_informed(&self) -> bool {
        self.known.is_something()
    }

    /// Places of the parameters that are estimated, in ascending order.
    #[must_use]
    pub fn estimated(&self) -> &[usize] {
        &self.known.left
    }

    /// Writes to `theta` all parameters, where an estimator says `found` of those that are estimated.
    pub fn complete(&self, found: impl Iterator<Item = f64>, theta: &mut [f64]) {
        theta.copy_from_slice(&self.known.values);
        for (&place, value) in self.known.left.iter().zip(found) {
            theta[place] += value;
        }
    }
}
