//! A model whose regressor needs what it has made of earlier samples, with the estimator behind it.

mod learn;
mod recursion;

pub use learn::{Learner, MODEL_OUTPUTS};

use crate::error::Error;
use crate::estimator::{Bounds, GoOn, Run};
use crate::number::{Array, Elements, View};
use forgetting::models::{Given, Method, Orders, Polynomial};

/// What makes regressors of signals, see [`Polynomial`]; in `f64` whatever the estimator computes in.
#[derive(Clone, Debug)]
pub struct Model {
    polynomial: Polynomial,
}

impl Model {
    /// At rest. `method` is "prediction_error" or "extended_least_squares".
    ///
    /// # Errors
    /// [`Error`] names the order or the method.
    pub fn new(orders: Orders, method: &str) -> Result<Self, Error> {
        let method = match method {
            "prediction_error" => Method::PredictionError,
            "extended_least_squares" => Method::ExtendedLeastSquares,
            _ => {
                let allowed = ["prediction_error", "extended_least_squares"];
                return Err(Error::word("method", method, &allowed));
            }
        };
        Ok(Self { polynomial: Polynomial::new(orders, method)? })
    }

    /// The same at rest where something is known of its parameters, see [`Polynomial::knowing`].
    ///
    /// # Errors
    /// [`Error`] says what is wrong with what is known.
    pub fn knowing(self, given: &[Given]) -> Result<Self, Error> {
        Ok(Self { polynomial: self.polynomial.knowing(given)? })
    }

    /// Parameters that are estimated.
    #[must_use]
    pub fn estimated(&self) -> usize {
        self.polynomial.estimated().len()
    }

    /// The model that [`Model::to_bytes`] saved, bit for bit.
    ///
    /// # Errors
    /// [`Error::Core`] says what is wrong with the bytes.
    pub fn from_bytes(state: &[u8]) -> Result<Self, Error> {
        Ok(Self { polynomial: Polynomial::from_bytes(state)? })
    }

    /// The model, orders and state, as bytes: portable, versioned and checked.
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        self.polynomial.to_bytes()
    }

    /// Takes a record of T samples: `inputs` (T, inputs), `y` (T,), NaN for what is missing, through
    /// `learner`, and returns those of [`MODEL_OUTPUTS`] that are named, and of the outputs of the
    /// learner. Within `bounds` of the parameters that are estimated, as the learner has them, θ is moved
    /// after each sample, as by [`RunOptions`](crate::RunOptions).
    ///
    /// # Errors
    /// [`Error`] names the argument or the sample that does not fit; nothing has changed.
    pub fn learn(
        &mut self,
        learner: Learner<'_>,
        (inputs, y): (View<'_>, View<'_>),
        (outputs, bounds): (&[&str], Option<Bounds<'_>>),
        go_on: GoOn<'_>,
    ) -> Result<Run, Error> {
        let before = self.polynomial.clone();
        let (model, how) = (&mut self.polynomial, (outputs, bounds));
        let learned = learn::learn(model, learner, (inputs, y), how, go_on);
        learned.inspect_err(|_| self.polynomial = before)
    }

    /// Predicts each y of a record one sample ahead, with θ as it is: from rest, or going on from the
    /// last sample. Where y is missing, its prediction stands for it: without any y this is a free run.
    ///
    /// # Errors
    /// [`Error`] names the argument or the sample that does not fit.
    pub fn predict(
        &self,
        (inputs, y): (View<'_>, View<'_>),
        from_rest: bool,
    ) -> Result<Array, Error> {
        let mut model = self.polynomial.clone();
        if from_rest {
            model.rest();
        }
        let prediction = learn::predict(&mut model, (inputs, y))?;
        Ok(Array { shape: vec![prediction.len()], elements: Elements::F64(prediction) })
    }

    /// Its orders.
    #[must_use]
    pub fn orders(&self) -> &Orders {
        self.polynomial.orders()
    }

    /// θ (n,): that of the estimator, or as far on the way there as C and F are stable.
    #[must_use]
    pub fn theta(&self) -> Array {
        let mut theta = self.polynomial.theta().to_vec();
        self.polynomial.express(&mut theta);
        Array { shape: vec![theta.len()], elements: Elements::F64(theta) }
    }

    /// Samples so far.
    #[must_use]
    pub fn samples(&self) -> u64 {
        self.polynomial.samples()
    }
}
