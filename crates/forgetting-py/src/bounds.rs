//! Bounds of parameters, as Python gives them.

use crate::arrays::Input;
use forgetting_runtime::{Bounds, NumberType};
use pyo3::prelude::*;

/// A pair (lower, upper) of Python's.
pub type Pair<'py> = (Bound<'py, PyAny>, Bound<'py, PyAny>);

/// Both arrays of numbers.
pub struct BoundsInput<'a, 'py>(Input<'a, 'py>, Input<'a, 'py>);

impl<'a, 'py> BoundsInput<'a, 'py> {
    /// Those of the pair, if there is one.
    ///
    /// # Errors
    /// `InvalidInput` names the bound that holds something else than numbers.
    pub fn read(pair: Option<&'a Pair<'py>>) -> PyResult<Option<Self>> {
        let Some((lower, upper)) = pair else { return Ok(None) };
        let read = |name, values| Input::read(name, values, NumberType::F64);
        Ok(Some(Self(read("lower", lower)?, read("upper", upper)?)))
    }

    /// As the run time takes them.
    ///
    /// # Errors
    /// As above.
    pub fn view(&self) -> PyResult<Bounds<'_>> {
        Ok(Bounds { lower: self.0.view("lower")?, upper: self.1.view("upper")? })
    }
}
