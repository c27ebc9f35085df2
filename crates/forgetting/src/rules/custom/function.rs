//! The function that says F: a closure of Rust's, or one that is chosen at run time.

use super::FORGETTING_MATRIX;
#[cfg(feature = "alloc")]
use crate::choice::function::{Argument, MatrixFunction};
use crate::choice::{Value, Values};
use crate::error::Error;
#[cfg(feature = "alloc")]
use alloc::sync::Arc;
#[cfg(feature = "alloc")]
use core::marker::PhantomData;
use forgetting_kernels::Real;

/// What says F: in Rust, any closure of this form.
///
/// It is given R (n x n), φ̄ (p x n) and ē (p x m), all row by row, and writes F (n x n).
pub trait ForgettingMatrix<T: Real>: Clone + Send + Sync {
    /// Writes F to `matrix`, which holds zeros.
    ///
    /// # Errors
    /// Whatever is wrong; the sample is refused with it.
    fn forgetting_matrix(
        &self,
        information: &[T],
        phi: &[T],
        error: &[T],
        matrix: &mut [T],
    ) -> Result<(), Error>;

    /// The function as the value of a parameter, if it can be one.
    fn value(&self) -> Option<Value<'_>> {
        None
    }

    /// The function that is the value of the parameter.
    ///
    /// # Errors
    /// [`Error::Missing`] where a function cannot be one.
    fn from_values(values: &dyn Values) -> Result<Self, Error> {
        let _ = values;
        Err(Error::Missing { parameter: FORGETTING_MATRIX.name })
    }
}

impl<T, C> ForgettingMatrix<T> for C
where
    T: Real,
    C: Fn(&[T], &[T], &[T], &mut [T]) -> Result<(), Error> + Clone + Send + Sync,
{
    fn forgetting_matrix(&self, r: &[T], phi: &[T], e: &[T], f: &mut [T]) -> Result<(), Error> {
        self(r, phi, e, f)
    }
}

/// A function chosen at run time, shared by the clones of the rule.
#[cfg(feature = "alloc")]
#[derive(Clone, Debug)]
pub struct SharedFunction<T>(Arc<dyn MatrixFunction>, PhantomData<T>);

#[cfg(feature = "alloc")]
impl<T: Real> ForgettingMatrix<T> for SharedFunction<T> {
    fn forgetting_matrix(&self, r: &[T], phi: &[T], e: &[T], f: &mut [T]) -> Result<(), Error> {
        let n = (0..=r.len()).find(|n| n * n >= r.len()).unwrap_or(1);
        let rows = phi.len() / n;
        let at = |x: &'_ [T], k: usize| x.get(k).map_or(f64::NAN, |x| x.to_f64());
        let arguments = [
            Argument { rows: n, columns: n, elements: &|k| at(r, k) },
            Argument { rows, columns: n, elements: &|k| at(phi, k) },
            Argument { rows, columns: e.len() / rows.max(1), elements: &|k| at(e, k) },
        ];
        self.0.call(&arguments, (n, n), &mut |k, x| {
            if let Some(f) = f.get_mut(k) {
                *f = T::from_f64(x);
            }
        })
    }

    fn value(&self) -> Option<Value<'_>> {
        Some(Value::Function(&self.0))
    }

    fn from_values(values: &dyn Values) -> Result<Self, Error> {
        let function = match FORGETTING_MATRIX.look_up(values)? {
            Value::Function(function) => function.downcast_ref::<Arc<dyn MatrixFunction>>(),
            _ => None,
        };
        let refusal = Error::value(FORGETTING_MATRIX.name, f64::NAN, "a function");
        function.map(|function| Self(function.clone(), PhantomData)).ok_or(refusal)
    }
}

/// The function of a rule that is made by name.
#[cfg(feature = "alloc")]
pub type Named<T> = SharedFunction<T>;
/// The function of a rule that is made by name; without `alloc` none can be.
#[cfg(not(feature = "alloc"))]
pub type Named<T> = fn(&[T], &[T], &[T], &mut [T]) -> Result<(), Error>;
