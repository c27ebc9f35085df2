//! A compact estimator as bytes: those of [`crate::saved`], so that it can go on as any other estimator,
//! and one that is made as this one can go on here.
//!
//! Reading and writing are compiled once for a number type, whatever the rule and the size: they know an
//! estimator as [`Saved`].

use super::Compact;
use crate::choice::{Value, Values};
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

/// What is saved of a compact estimator.
pub trait Saved<T: Kernels> {
    /// n
    fn parameters(&self) -> usize;
    /// Names each parameter of the rule with its value.
    fn describe(&self, each: &mut dyn FnMut(&str, Value<'_>));
    /// λ
    fn forgetting_factor(&self) -> T;
    /// Shows the prior and the state, in the order of [`crate::saved`].
    fn visit(&mut self, visitor: &mut dyn Visitor<T>);
    /// Whether these are numbers that samples can have led to; repairs the bound of P's trace if it is
    /// not one.
    fn check_read(&mut self) -> bool;
}

/// Gives `estimator` as bytes to `put`, piece by piece; `rule` is the registry name of its rule. Returns
/// how many bytes they are.
///
/// # Errors
/// [`Error::Unsupported`] for a rule that is not data.
pub fn save<T: Kernels>(
    estimator: &mut dyn Saved<T>,
    rule: &str,
    put: &mut dyn FnMut(&[u8]),
) -> Result<usize, Error> {
    let mut count = 0;
    let mut counted = |bytes: &[u8]| {
        count += bytes.len();
        put(bytes);
    };
    let mut output = Output::new(&mut counted);
    output.sizes::<T>([estimator.parameters(), 1, 1], SCALAR, NOTHING);
    output.choice(rule, &|each| estimator.describe(each))?;
    let rate = Constant::<Fixed<T, 1>>::new(estimator.forgetting_factor())?;
    output.choice("constant", &|each| rate.describe(&mut |name, value| each(name, value)))?;
    output.choice("equal", &|_| {})?;
    output.choice("open", &|_| {})?;
    estimator.visit(&mut output);
    output.finish();
    Ok(count)
}

/// The estimator of n parameters that was saved as these bytes, if its rule is the one called `rule` and
/// the rest of it what is compact. `make` makes it with these parameters of the rule and this λ.
///
/// # Errors
/// [`Error::State`] says what is wrong with the bytes, or that they are those of another estimator; what
/// was made is then of no use.
pub fn load<'a, T: Kernels>(
    (rule, parameters): (&str, usize),
    bytes: &[u8],
    make: impl FnOnce(&dyn Values, T) -> Result<&'a mut dyn Saved<T>, Error>,
) -> Result<(), Error> {
    let body = checked(bytes)?;
    let mut reader = Reader::new(body.get(MARK.len()..).unwrap_or_default());
    if reader.byte()? != VERSION {
        return Err(Error::State { reason: "it was written by an earlier version" });
    }
    check_sizes::<T>(parameters, &mut reader)?;
    let (name, values) = reader.choice()?;
    if name != rule {
        return Err(Error::State { reason: "it is of another rule" });
    }
    let estimator = make(&values, rate(&mut reader)?)?;
    estimator.visit(&mut reader);
    reader.finish()?;
    if estimator.check_read() {
        Ok(())
    } else {
        Err(Error::State { reason: "its numbers are not those of an estimator" })
    }
}

fn check_sizes<T: Kernels>(parameters: usize, reader: &mut Reader<'_>) -> Result<(), Error> {
    let refuse = |reason| Err(Error::State { reason });
    if usize::from(reader.byte()?) != T::BYTES {
        return refuse("it holds numbers of another type");
    }
    if (reader.size()?, reader.size()?, reader.size()?) != (parameters, 1, 1) {
        return refuse("it is of other sizes");
    }
    if (reader.byte()?, reader.byte()?) != (SCALAR, NOTHING) {
        return refuse("it has a monitor, or its initial covariance is not one number");
    }
    Ok(())
}

/// λ; neither a weighting nor a gate may follow.
fn rate<T: Kernels>(reader: &mut Reader<'_>) -> Result<T, Error> {
    let (name, values) = reader.choice()?;
    if name != "constant" {
        return Err(Error::State { reason: "its forgetting factor is not constant" });
    }
    let rate = Constant::<Fixed<T, 1>>::configure(&values, Fixed::new())?;
    for plain in ["equal", "open"] {
        if reader.choice()?.0 != plain {
            return Err(Error::State { reason: "it has a weighting or a gate" });
        }
    }
    Ok(rate.constant().unwrap_or(T::ONE))
}

impl<F, T, const N: usize> Saved<T> for Compact<F, T, N>
where
    F: Forgetting<Fixed<T, N>>,
    T: Kernels,
    Size<N>: Packed<T>,
{
    fn parameters(&self) -> usize {
        N
    }

    fn describe(&self, each: &mut dyn FnMut(&str, Value<'_>)) {
        self.rule.describe(&mut |name, value| each(name, value));
    }

    fn forgetting_factor(&self) -> T {
        self.forgetting_factor
    }

    fn visit(&mut self, visitor: &mut dyn Visitor<T>) {
        visitor.reals(&mut self.initial_theta);
        visitor.reals(core::slice::from_mut(&mut self.initial_covariance));
        self.visit_state(visitor);
    }

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

impl<F, T, const N: usize> Compact<F, T, N>
where
    F: Forgetting<Fixed<T, N>>,
    T: Kernels,
    Size<N>: Packed<T>,
{
    /// Shows every number of the state to `visitor`.
    pub(super) fn visit_state(&mut self, visitor: &mut dyn Visitor<T>) {
        visitor.reals(self.triangle.as_mut());
        visitor.reals(&mut self.diagonal);
        visitor.reals(core::slice::from_mut(&mut self.bound));
        visitor.reals(&mut self.theta);
        visitor.whole(&mut self.samples);
    }

    /// [`save`]
    ///
    /// # Errors
    /// Those of [`save`].
    pub fn save(&mut self, rule: &str, put: &mut dyn FnMut(&[u8])) -> Result<usize, Error> {
        save(self, rule, put)
    }

    /// The estimator that was saved as these bytes; see [`load`].
    ///
    /// # Errors
    /// Those of [`load`].
    pub fn from_bytes(rule: &str, bytes: &[u8]) -> Result<Self, Error> {
        let mut made = None;
        load((rule, N), bytes, |values, lambda| {
            let start = Self::new(values, lambda, T::ONE, &[T::ZERO; N])?;
            Ok(made.insert(start) as &mut dyn Saved<T>)
        })?;
        made.ok_or(Error::State { reason: "it is truncated" })
    }
}
