//! Writing a state.

use super::{crc32_of, Error, Forgetting, Gate, Memory, Named, Rate, Real, Visitor, Weighting};
use super::{MARK, MONITORED, NOISE_ESTIMATED, VERSION};
use crate::choice::bytes::{write as choice, Each, Put};

/// Bytes on their way to where they are kept, and their check so far.
pub struct Output<'a> {
    put: &'a mut Put<'a>,
    check: u32,
}

impl<'a> Output<'a> {
    /// Nothing yet; `put` keeps what comes.
    pub fn new(put: &'a mut Put<'a>) -> Self {
        Self { put, check: u32::MAX }
    }

    /// The next bytes.
    pub fn bytes(&mut self, bytes: &[u8]) {
        self.check = crc32_of(self.check, bytes);
        (self.put)(bytes);
    }

    /// A name and its parameters.
    ///
    /// # Errors
    /// [`Error::Unsupported`] for a function, which is not data.
    pub fn choice(&mut self, name: &str, each: &Each<'_>) -> Result<(), Error> {
        choice(&mut |bytes| self.bytes(bytes), name, each)
    }

    /// Mark, version, number type, sizes n, p and m, the form of P₀ and what else is kept.
    pub fn sizes<T: Real>(&mut self, sizes: [usize; 3], form: u8, kept: u8) {
        self.bytes(MARK);
        self.bytes(&[VERSION, T::BYTES as u8]);
        for size in sizes {
            self.bytes(&(size as u32).to_le_bytes());
        }
        self.bytes(&[form, kept]);
    }

    /// The check comes last.
    pub fn finish(self) {
        (self.put)(&(!self.check).to_le_bytes());
    }
}

/// Everything before the numbers.
///
/// # Errors
/// [`Error::Unsupported`] for a function, which is not data.
pub fn header<M: Memory>(output: &mut Output<'_>, estimator: &Named<M>) -> Result<(), Error> {
    let (monitored, noise) = (estimator.health().is_some(), estimator.estimates_noise());
    let kept = u8::from(monitored) * MONITORED + u8::from(noise) * NOISE_ESTIMATED;
    let memory = estimator.prior().memory();
    let sizes = [memory.parameters(), memory.rows(), memory.targets()];
    output.sizes::<M::Real>(sizes, estimator.prior().form(), kept);
    let (rule, rate) = (estimator.rule(), estimator.rate());
    output.choice(rule.name(), &|each| rule.describe(&mut |name, value| each(name, value)))?;
    output.choice(rate.called(), &|each| rate.describe(&mut |name, value| each(name, value)))?;
    let (weighting, gate) = (estimator.weighting(), estimator.gate());
    output.choice(weighting.called(), &|each| {
        weighting.describe(&mut |name, value| each(name, value));
    })?;
    output.choice(gate.called(), &|each| gate.describe(&mut |name, value| each(name, value)))
}

/// Counts the bytes of the numbers of a state.
pub struct Length(pub usize);

impl<T: Real> Visitor<T> for Length {
    fn reals(&mut self, values: &mut [T]) {
        self.0 += values.len() * T::BYTES;
    }

    fn whole(&mut self, _: &mut u64) {
        self.0 += 8;
    }
}

/// The numbers of a state. `f32` numbers go through `f64` exactly.
impl<T: Real> Visitor<T> for Output<'_> {
    fn reals(&mut self, values: &mut [T]) {
        for value in values {
            match T::BYTES {
                4 => self.bytes(&(value.to_f64() as f32).to_le_bytes()),
                _ => self.bytes(&value.to_f64().to_le_bytes()),
            }
        }
    }

    fn whole(&mut self, value: &mut u64) {
        self.bytes(&value.to_le_bytes());
    }
}
