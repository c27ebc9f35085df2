//! How many coefficients each polynomial has.

use crate::error::Error;
use alloc::vec::Vec;
use core::ops::Range;

/// The most coefficients of a polynomial, and the longest delay.
const MOST: usize = 4096;

/// The orders of one input.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct InputOrders {
    /// coefficients of B
    pub nb: usize,
    /// coefficients of F
    pub nf: usize,
    /// samples until the input acts
    pub nk: usize,
}

/// The orders of a model.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Orders {
    /// coefficients of A
    pub na: usize,
    /// coefficients of C
    pub nc: usize,
    /// coefficients of D
    pub nd: usize,
    /// of each input
    pub inputs: Vec<InputOrders>,
    /// whether there is a constant
    pub constant: bool,
}

impl Orders {
    /// Refuses orders that are too large, inputs without a coefficient, and a model of no parameter.
    ///
    /// # Errors
    /// [`Error::Value`] names the order.
    pub fn check(&self) -> Result<(), Error> {
        let allowed = "whole numbers from 0 to 4096";
        let within = |name, order: usize| match order <= MOST {
            true => Ok(()),
            false => Err(Error::value(name, order as f64, allowed)),
        };
        within("na", self.na)?;
        within("nc", self.nc)?;
        within("nd", self.nd)?;
        for (i, input) in self.inputs.iter().enumerate() {
            for (name, order) in [("nb", input.nb), ("nf", input.nf), ("nk", input.nk)] {
                within(name, order).map_err(|error| error.at(i))?;
            }
            if input.nb == 0 {
                return Err(Error::value("nb", 0.0, "at least 1 for every input").at(i));
            }
        }
        match self.parameters() {
            0 => Err(Error::Unsupported { reason: "all orders are 0; a model needs a parameter" }),
            _ => Ok(()),
        }
    }

    /// n: a, then b of each input, c, d, f of each input and the constant.
    #[must_use]
    pub fn parameters(&self) -> usize {
        self.layout().constant.end
    }

    /// Samples that must come before one whose lags are all measured.
    #[must_use]
    pub fn reach(&self) -> usize {
        let inputs = self.inputs.iter().map(InputOrders::reach).max();
        self.na.max(inputs.unwrap_or(0))
    }

    /// Whether all regressors are measured values.
    #[must_use]
    pub fn is_linear(&self) -> bool {
        self.nc + self.nd == 0 && self.inputs.iter().all(|input| input.nf == 0)
    }

    /// Where the coefficients of each polynomial stand in θ.
    pub(super) fn layout(&self) -> Layout {
        let mut end = 0;
        let mut next = |count: usize| {
            end += count;
            end - count..end
        };
        let a = next(self.na);
        let b: Vec<_> = self.inputs.iter().map(|input| next(input.nb)).collect();
        let (c, d) = (next(self.nc), next(self.nd));
        let f = self.inputs.iter().map(|input| next(input.nf)).collect();
        let constant = next(usize::from(self.constant));
        Layout { a, b, c, d, f, constant }
    }
}

impl InputOrders {
    /// Samples that must come before one of which all lags of the input are measured.
    fn reach(&self) -> usize {
        (self.nk + self.nb).saturating_sub(1)
    }
}

/// Where coefficients stand in θ.
#[derive(Clone, Debug)]
pub(super) struct Layout {
    pub a: Range<usize>,
    pub b: Vec<Range<usize>>,
    pub c: Range<usize>,
    pub d: Range<usize>,
    pub f: Vec<Range<usize>>,
    pub constant: Range<usize>,
}
