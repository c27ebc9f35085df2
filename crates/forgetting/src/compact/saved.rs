//! A compact estimator as bytes: those of [`crate::saved`], so that it can go on as any other estimator,
//! and one that is made as this one can go on here.

use super::Compact;
use crate::error::Error;
use crate::memory::state::{Visitor, MOST_SAMPLES};
use crate::memory::{Fixed, Packed, Size};
use crate::rates::{Constant, Rate};
use crate::rules::Forgetting;
use crate::saved::{checked, Output, Reader, MARK, VERSION};
use forgetting_kernels::Kernels;

/// P₀ is given as one number, and nothing else is kept.
const SCALAR: u8 = 0;
const NOTHING: u8 = 0;

impl<F, T, const N: usize> Compact<F, T, N>
where
    F: Forgetting<Fixed<T, N>>,
    T: Kernels,
    Size<N>: Packed<T>,
{
    /// Gives the estimator as bytes to `put`, piece by piece; `rule` is the registry name of the rule.
    /// Returns how many bytes they are.
    ///
    /// # Errors
    /// [`Error::Unsupported`] for a rule that is not data.
    pub fn save(&mut self, rule: &str, put: &mut dyn FnMut(&[u8])) -> Result<usize, Error> {
        let mut count = 0;
        let mut counted = |bytes: &[u8]| {
            count += bytes.len();
            put(bytes);
        };
        let mut output = Output::new(&mut counted);
        output.sizes(Fixed::<T, N>::new(), SCALAR, NOTHING);
        output.choice(rule, &|each| self.rule.describe(&mut |name, value| each(name, value)))?;
        let rate = Constant::<Fixed<T, N>>::new(self.forgetting_factor)?;
        output.choice("constant", &|each| rate.describe(&mut |name, value| each(name, value)))?;
        output.choice("equal", &|_| {})?;
        output.choice("open", &|_| {})?;
        self.visit(&mut output);
        output.finish();
        Ok(count)
    }

    /// The estimator that was saved as these bytes, if its rule is the one called `rule` and the rest of
    /// it what is compact.
    ///
    /// # Errors
    /// [`Error::State`] says what is wrong with the bytes, or that they are those of another estimator.
    pub fn from_bytes(rule: &str, bytes: &[u8]) -> Result<Self, Error> {
        let body = checked(bytes)?;
        let mut reader = Reader::new(body.get(MARK.len()..).unwrap_or_default());
        if reader.byte()? != VERSION {
            return Err(Error::State { reason: "it was written by an earlier version" });
        }
        let mut estimator = Self::header(rule, &mut reader)?;
        estimator.visit(&mut reader);
        reader.finish()?;
        if estimator.check_read() {
            Ok(estimator)
        } else {
            Err(Error::State { reason: "its numbers are not those of an estimator" })
        }
    }

    /// The estimator described before the numbers, at its start.
    fn header(rule: &str, reader: &mut Reader<'_>) -> Result<Self, Error> {
        let refuse = |reason| Err(Error::State { reason });
        if usize::from(reader.byte()?) != T::BYTES {
            return refuse("it holds numbers of another type");
        }
        if (reader.size()?, reader.size()?, reader.size()?) != (N, 1, 1) {
            return refuse("it is of other sizes");
        }
        if (reader.byte()?, reader.byte()?) != (SCALAR, NOTHING) {
            return refuse("it has a monitor, or its initial covariance is not one number");
        }
        let (name, values) = reader.choice()?;
        if name != rule {
            return refuse("it is of another rule");
        }
        let rule = F::configure(&values, Fixed::new())?;
        let (name, values) = reader.choice()?;
        if name != "constant" {
            return refuse("its forgetting factor is not constant");
        }
        let rate = Constant::configure(&values, Fixed::new())?;
        for plain in ["equal", "open"] {
            if reader.choice()?.0 != plain {
                return refuse("it has a weighting or a gate");
            }
        }
        Self::of(rule, rate, T::ONE, [T::ZERO; N])
    }

    /// Shows the prior and the state, in the order of [`crate::saved`].
    fn visit(&mut self, visitor: &mut dyn Visitor<T>) {
        visitor.reals(&mut self.initial_theta);
        visitor.reals(core::slice::from_mut(&mut self.initial_covariance));
        visitor.reals(self.triangle.as_mut());
        visitor.reals(&mut self.diagonal);
        visitor.reals(core::slice::from_mut(&mut self.bound));
        visitor.reals(&mut self.theta);
        visitor.whole(&mut self.samples);
    }

    /// Whether these are numbers that samples can have led to; repairs the bound of P's trace if it is
    /// not one.
    fn check_read(&mut self) -> bool {
        let in_range = |x: &T| *x >= T::FLOOR && *x <= T::CEILING;
        let limit = T::from_f64(N as f64) * T::CEILING;
        let trace = self.kernel().trace();
        let sound = in_range(&self.initial_covariance)
            && self.diagonal.iter().all(in_range)
            && self.initial_theta.iter().all(|x| x.abs() <= T::CEILING)
            && self.theta.iter().all(|x| x.is_finite())
            && trace <= limit
            && self.bound.is_finite()
            && self.samples <= MOST_SAMPLES;
        // half of it, for rounding
        if !(self.bound >= T::from_f64(0.5) * trace) {
            self.bound = trace;
        }
        sound
    }
}
