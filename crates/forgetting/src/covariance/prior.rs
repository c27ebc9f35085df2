//! What is believed before the first sample: θ₀ and P₀.

use crate::covariance::Factor;
use crate::error::Error;
use crate::memory::state::Visitor;
use crate::memory::Memory;
use forgetting_kernels::Real;

/// P₀ of each parameter where nothing is known of it, in units of the typical size of its regressor.
///
/// It weighs a hundred-thousandth of one sample: too little to be seen in an estimate, and enough to
/// keep what is not yet known from ruining the first predictions.
pub const DIFFUSE: f64 = 1e5;

/// P₀ as it was given.
#[derive(Clone, Debug)]
enum Covariance<M: Memory> {
    /// `DIFFUSE`·I, in the units of the data
    OfData,
    Scalar(M::Real),
    Diagonal(M::Vector),
    Dense(Factor<M>),
}

/// θ₀ and P₀.
#[derive(Clone, Debug)]
pub struct Prior<M: Memory> {
    memory: M,
    theta: M::Parameters,
    covariance: Covariance<M>,
}

impl<M: Memory> Prior<M> {
    /// θ₀ = 0 and P₀ that follows the data: [`DIFFUSE`]·I, with each regressor measured in units that
    /// are chosen as it comes.
    ///
    /// No prediction then depends on the units of φ or y, and all that a rule, a rate or a gate is
    /// told of P, R or φ is a pure number.
    pub fn of_data(memory: M) -> Self {
        Self { memory, theta: memory.theta(), covariance: Covariance::OfData }
    }

    /// Whether P₀ follows the data.
    pub fn is_of_data(&self) -> bool {
        matches!(self.covariance, Covariance::OfData)
    }

    /// θ₀ = 0 and P₀ = `variance`·I.
    ///
    /// # Errors
    /// [`Error::Value`] names `initial_covariance` unless it is positive and in range.
    pub fn scalar(memory: M, variance: M::Real) -> Result<Self, Error> {
        Factor::scalar(memory, variance)?;
        Ok(Self { memory, theta: memory.theta(), covariance: Covariance::Scalar(variance) })
    }

    /// θ₀ = 0 and P₀ = diag(`variances`), n numbers.
    ///
    /// # Errors
    /// [`Error`] names `initial_covariance`.
    pub fn diagonal(memory: M, variances: &[M::Real]) -> Result<Self, Error> {
        Factor::diagonal(memory, variances)?;
        let mut diagonal = memory.vector();
        diagonal.as_mut().copy_from_slice(variances);
        Ok(Self { memory, theta: memory.theta(), covariance: Covariance::Diagonal(diagonal) })
    }

    /// θ₀ = 0 and P₀ = `covariance`, n x n numbers.
    ///
    /// # Errors
    /// [`Error`] names `initial_covariance` unless it is symmetric and positive definite.
    pub fn dense(memory: M, covariance: &[M::Real]) -> Result<Self, Error> {
        let covariance = Covariance::Dense(Factor::dense(memory, covariance)?);
        Ok(Self { memory, theta: memory.theta(), covariance })
    }

    /// The same P₀ with θ₀ = `theta`, m x n numbers, one target after the other.
    ///
    /// # Errors
    /// [`Error`] names `initial_theta`: its length, or an element that is not finite.
    pub fn with_theta(mut self, theta: &[M::Real]) -> Result<Self, Error> {
        const NAME: &str = "initial_theta";
        Error::check_length(NAME, theta.len(), self.theta.as_ref().len())?;
        if let Some(index) = theta.iter().position(|x| !(x.abs() <= M::Real::CEILING)) {
            return Err(Error::Value {
                parameter: NAME,
                index: Some(index),
                value: theta[index].to_f64(),
                allowed: "finite numbers",
            });
        }
        self.theta.as_mut().copy_from_slice(theta);
        Ok(self)
    }

    /// The sizes it was made for.
    pub fn memory(&self) -> M {
        self.memory
    }

    /// θ₀, m x n numbers.
    pub fn theta(&self) -> &M::Parameters {
        &self.theta
    }

    /// P₀.
    pub fn factor(&self) -> Factor<M> {
        match &self.covariance {
            Covariance::OfData => Factor::of(self.memory, |_| M::Real::from_f64(DIFFUSE)),
            Covariance::Scalar(variance) => Factor::of(self.memory, |_| *variance),
            Covariance::Diagonal(variances) => Factor::of(self.memory, |i| variances.as_ref()[i]),
            Covariance::Dense(factor) => factor.clone(),
        }
    }

    /// Whether every number is one that could have been given.
    pub(crate) fn is_sound(&self) -> bool {
        let theta = self.theta.as_ref();
        theta.iter().all(|x| x.abs() <= M::Real::CEILING) && self.factor().is_sound()
    }

    /// How P₀ was given: 0 a scalar, 1 a diagonal, 2 a matrix, 3 not at all.
    pub(crate) fn form(&self) -> u8 {
        match self.covariance {
            Covariance::Scalar(_) => 0,
            Covariance::Diagonal(_) => 1,
            Covariance::Dense(_) => 2,
            Covariance::OfData => 3,
        }
    }

    /// A prior of this form, its numbers to be restored by [`Prior::visit`].
    pub(crate) fn of_form(memory: M, form: u8) -> Result<Self, Error> {
        let covariance = match form {
            0 => Covariance::Scalar(M::Real::ONE),
            1 => Covariance::Diagonal(memory.vector()),
            2 => Covariance::Dense(Factor::scalar(memory, M::Real::ONE)?),
            3 => Covariance::OfData,
            _ => return Err(Error::State { reason: "an unknown form of the initial covariance" }),
        };
        Ok(Self { memory, theta: memory.theta(), covariance })
    }

    /// Visits every number, to save or restore it.
    pub(crate) fn visit(&mut self, visitor: &mut dyn Visitor<M::Real>) {
        visitor.reals(self.theta.as_mut());
        match &mut self.covariance {
            Covariance::OfData => {}
            Covariance::Scalar(variance) => visitor.reals(core::slice::from_mut(variance)),
            Covariance::Diagonal(variances) => visitor.reals(variances.as_mut()),
            Covariance::Dense(factor) => factor.visit(visitor),
        }
    }
}
