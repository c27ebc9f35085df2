//! Functions of the user's, as values of parameters.

use crate::Error;
use core::any::Any;
use core::fmt::Debug;

/// A matrix that a function is given.
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
/// A parameter that takes one has the value [`Value::Function`](crate::parameter::Value::Function)
/// with an `Arc<dyn MatrixFunction>`.
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

    /// The function itself, for the one who made it.
    fn as_any(&self) -> &dyn Any;
}
