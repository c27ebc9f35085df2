//! Functions of the user's, as values of parameters.

use crate::choice::{Parameter, Value, Values};
use crate::error::Error;
use crate::memory::Memory;
use crate::sample::Evidence;
use alloc::sync::Arc;
use core::any::Any;
use core::fmt::{Debug, Formatter};

/// A matrix among the arguments of a function.
#[derive(Clone, Copy)]
pub struct Argument<'a> {
    /// number of rows
    pub rows: usize,
    /// number of columns
    pub columns: usize,
    /// the number at a position, row by row
    pub elements: &'a dyn Fn(usize) -> f64,
}

/// A function from matrices to a matrix, whatever language it is written in.
///
/// A parameter that takes one has the value [`Value::Function`] with an `Arc<dyn MatrixFunction>`.
pub trait MatrixFunction: Debug + Send + Sync {
    /// Evaluates it: calls `put` with the position, row by row, and the value of each of the
    /// rows x columns elements of the result.
    ///
    /// # Errors
    /// [`Error::Function`] when it failed, or another that says what is wrong with its result.
    fn call(
        &self,
        arguments: &[Argument<'_>],
        shape: (usize, usize),
        put: &mut dyn FnMut(usize, f64),
    ) -> Result<(), Error>;

    /// The concrete type, so that the binding that wrapped a function can get it back.
    fn as_any(&self) -> &dyn Any;
}

type Call<M, A> = dyn for<'a, 'b, 'c> Fn(&'a Evidence<'b, 'c, M>) -> Result<A, Error> + Send + Sync;

/// A function of the evidence of a sample that answers with an `A`.
///
/// A parameter that takes one has the value [`Value::Function`] with the function itself.
pub struct EvidenceFunction<M: Memory, A: 'static> {
    call: Arc<Call<M, A>>,
    origin: Arc<dyn Any + Send + Sync>,
}

impl<M: Memory, A: 'static> Clone for EvidenceFunction<M, A> {
    fn clone(&self) -> Self {
        Self { call: Arc::clone(&self.call), origin: Arc::clone(&self.origin) }
    }
}

impl<M: Memory, A: 'static> Debug for EvidenceFunction<M, A> {
    fn fmt(&self, f: &mut Formatter<'_>) -> core::fmt::Result {
        f.write_str("Function")
    }
}

impl<M: Memory, A: 'static> EvidenceFunction<M, A> {
    /// Of this `function`, which reports a failure of its own as [`Error::Function`].
    pub fn new<F>(function: F) -> Self
    where
        F: for<'a, 'b, 'c> Fn(&'a Evidence<'b, 'c, M>) -> Result<A, Error> + Send + Sync + 'static,
    {
        Self { call: Arc::new(function), origin: Arc::new(()) }
    }

    /// The same, with what the function was made from, for [`EvidenceFunction::origin`] to give
    /// back.
    #[must_use]
    pub fn with_origin(self, origin: impl Any + Send + Sync) -> Self {
        Self { origin: Arc::new(origin), ..self }
    }

    /// What the function was made from.
    pub fn origin(&self) -> &(dyn Any + Send + Sync) {
        &*self.origin
    }

    /// Asks it.
    ///
    /// # Errors
    /// The function's.
    #[inline]
    pub fn ask(&self, evidence: &Evidence<'_, '_, M>) -> Result<A, Error> {
        (self.call)(evidence)
    }

    /// The function given for `parameter` in `values`.
    ///
    /// # Errors
    /// [`Error`] names the parameter when there is none.
    pub(crate) fn from_values(parameter: &Parameter, values: &dyn Values) -> Result<Self, Error> {
        match parameter.look_up(values)? {
            Value::Function(function) => function.downcast_ref::<Self>().cloned(),
            _ => None,
        }
        .ok_or(Error::value(parameter.name, f64::NAN, "a function"))
    }
}
