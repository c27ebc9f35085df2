//! Reading a state. Nothing here trusts the bytes: a length is checked before it is used.

use super::{AnyEstimator, AnyGate, AnyRate, AnyWeighting, Dynamic, Error, Estimator, Memory};
use super::{Box, Open, Prior, Real, Rule, String, Value, Values, Vec, Visitor};
use super::{MONITORED, NOISE_ESTIMATED};
use crate::rules::RULES;
use forgetting_kernels::Kernels;

/// A place in the bytes, and whether they have run out.
pub struct Reader<'a> {
    bytes: &'a [u8],
    truncated: bool,
}

impl<'a> Reader<'a> {
    pub fn new(bytes: &'a [u8]) -> Self {
        Self { bytes, truncated: false }
    }

    /// Nothing may be missing and nothing may be left.
    pub fn finish(&self) -> Result<(), Error> {
        match (self.truncated, self.bytes) {
            (false, []) => Ok(()),
            (true, _) => Err(Error::State { reason: "it is truncated" }),
            (false, _) => Err(Error::State { reason: "it is longer than it should be" }),
        }
    }

    pub fn take(&mut self, count: usize) -> Result<&'a [u8], Error> {
        if count > self.bytes.len() {
            self.truncated = true;
            return Err(Error::State { reason: "it is truncated" });
        }
        let (taken, rest) = self.bytes.split_at(count);
        self.bytes = rest;
        Ok(taken)
    }

    /// Passes over the monitor of version 1: three vectors of n numbers, nine numbers, three counts.
    pub fn skip_old_monitor<T: Kernels>(&mut self, n: usize) -> Result<(), Error> {
        self.take((3 * n + 9) * T::BYTES + 3 * 8).map(|_| ())
    }

    fn array<const N: usize>(&mut self) -> Result<[u8; N], Error> {
        let mut array = [0; N];
        array.copy_from_slice(self.take(N)?);
        Ok(array)
    }

    pub fn byte(&mut self) -> Result<u8, Error> {
        self.array::<1>().map(|[byte]| byte)
    }

    pub fn size(&mut self) -> Result<usize, Error> {
        self.array().map(|bytes| u32::from_le_bytes(bytes) as usize)
    }

    pub fn count(&mut self) -> Result<usize, Error> {
        self.array().map(|bytes| usize::from(u16::from_le_bytes(bytes)))
    }

    fn word(&mut self) -> Result<String, Error> {
        let length = usize::from(u16::from_le_bytes(self.array()?));
        let text = core::str::from_utf8(self.take(length)?);
        text.map(String::from).map_err(|_| Error::State { reason: "a name in it is not text" })
    }

    /// A value; one that is a choice in itself only at the first `level`.
    fn value(&mut self, level: usize) -> Result<SavedValue, Error> {
        match self.byte()? {
            0 => Ok(SavedValue::Real(f64::from_le_bytes(self.array()?))),
            1 => self.word().map(SavedValue::Word),
            2 => {
                let (rows, columns) = (self.size()?, self.size()?);
                let bytes = self.take(rows.saturating_mul(columns).saturating_mul(8))?;
                let number = |b: &[u8]| b.try_into().map_or(f64::NAN, f64::from_le_bytes);
                let elements: Vec<f64> = bytes.chunks(8).map(number).collect();
                let at = move |k: usize| elements.get(k).copied().unwrap_or(f64::NAN);
                Ok(SavedValue::Matrix { rows, columns, elements: Box::new(at) })
            }
            3 if level == 0 => {
                self.choice(1).map(|(name, values)| SavedValue::Choice { name, values })
            }
            _ => Err(Error::State { reason: "a parameter in it is of an unknown kind" }),
        }
    }

    /// A name and its parameters.
    pub fn choice(&mut self, level: usize) -> Result<(String, Parameters), Error> {
        let name = self.word()?;
        let count = self.byte()?;
        let mut parameters = Vec::new();
        for _ in 0..count {
            parameters.push((self.word()?, self.value(level)?));
        }
        Ok((name, Parameters(parameters)))
    }
}

enum SavedValue {
    Real(f64),
    Word(String),
    Matrix { rows: usize, columns: usize, elements: Box<dyn Fn(usize) -> f64> },
    Choice { name: String, values: Parameters },
}

pub struct Parameters(Vec<(String, SavedValue)>);

impl Values for Parameters {
    fn get(&self, name: &str) -> Option<Value<'_>> {
        self.0.iter().find(|(known, _)| known == name).map(|(_, given)| match given {
            SavedValue::Real(x) => Value::Real(*x),
            SavedValue::Word(word) => Value::Word(word),
            SavedValue::Matrix { rows, columns, elements } => {
                Value::Matrix { rows: *rows, columns: *columns, elements }
            }
            SavedValue::Choice { name, values } => Value::Choice { name, values },
        })
    }
}

/// The bytes that a state of these sizes takes at least: θ₀, P₀ in this form, U, D, the bound of
/// P's trace and θ.
pub(super) fn least_length<T: Kernels>(memory: Dynamic<T>, form: u8) -> usize {
    let (n, m) = (memory.parameters(), memory.targets());
    let factor = n * (n + 1) / 2 + 1;
    let prior = match form {
        0 => 1,
        1 => n,
        2 => factor,
        _ => 0,
    };
    (2 * m * n + prior + factor) * T::BYTES
}

/// Refuses more rows than a state of so many bytes can be of: rows take memory, but no place in it.
///
/// # Errors
/// [`Error::State`].
pub(super) fn check_rows<T: Kernels>(memory: Dynamic<T>, length: usize) -> Result<(), Error> {
    /// Numbers in the buffers for a sample that any state may have.
    const MOST: usize = 1 << 22;
    let (n, p, m) = (memory.parameters(), memory.rows(), memory.targets());
    if p * (p + n + m) <= MOST.max(length) {
        return Ok(());
    }
    Err(Error::State { reason: "it has too many rows to be saved: at most about 2000" })
}

/// Refuses an estimator for which there is no memory.
fn check_memory<T: Kernels>(
    memory: Dynamic<T>,
    (rule, parameters): (&str, &Parameters),
    form: u8,
) -> Result<(), Error> {
    let inner = parameters.0.iter().filter_map(|(_, value)| match value {
        SavedValue::Word(name) | SavedValue::Choice { name, .. } => Some(name.as_str()),
        _ => None,
    });
    let squares = inner.chain([rule]).filter_map(|name| RULES.iter().find(|a| a.name == name));
    // P₀ as a matrix is one more
    let prior = usize::from(form == 2);
    memory.check_room(squares.map(|about| about.squares).sum::<usize>() + prior, 1)
}

/// The estimator described before the numbers, with the prior's numbers but its first state; and
/// whether the monitor of version 1, which held fewer numbers than today's, follows.
pub fn header<T: Kernels>(
    reader: &mut Reader<'_>,
    version: u8,
) -> Result<(AnyEstimator<T>, bool), Error> {
    if usize::from(reader.byte()?) != T::BYTES {
        return Err(Error::State { reason: "it holds numbers of another type" });
    }
    let memory = Dynamic::new(reader.size()?, reader.size()?, reader.size()?)?;
    let form = reader.byte()?;
    let kept = reader.byte()?;
    if kept > MONITORED + NOISE_ESTIMATED {
        return Err(Error::State { reason: "it holds something unknown" });
    }
    let monitored = kept & MONITORED != 0;
    // before anything is made of these sizes
    if reader.bytes.len() < least_length(memory, form) {
        return Err(Error::State { reason: "it is truncated" });
    }
    check_rows(memory, reader.bytes.len())?;
    let (name, parameters) = reader.choice(0)?;
    check_memory(memory, (&name, &parameters), form)?;
    let rule = Rule::named(&name, &parameters, memory)?;
    let (name, parameters) = reader.choice(0)?;
    let rate = AnyRate::named(&name, &parameters, memory)?;
    let (name, parameters) = reader.choice(0)?;
    let weighting = AnyWeighting::named(&name, &parameters, memory)?;
    let gate = if version == 1 {
        AnyGate::Open(Open::new())
    } else {
        let (name, parameters) = reader.choice(0)?;
        AnyGate::named(&name, &parameters, memory)?
    };
    let mut prior = Prior::of_form(memory, form)?;
    prior.visit(reader);
    if !prior.is_sound() {
        return Err(Error::State { reason: "its numbers are not those of a prior" });
    }
    let mut estimator = Estimator::new(rule, rate, weighting, prior).with_gate(gate);
    estimator.estimate_noise(kept & NOISE_ESTIMATED != 0);
    let old_monitor = monitored && version == 1;
    if monitored && !old_monitor {
        estimator.enable_monitor();
    }
    Ok((estimator, old_monitor))
}

impl<T: Real> Visitor<T> for Reader<'_> {
    fn reals(&mut self, values: &mut [T]) {
        for value in values {
            let number = match T::BYTES {
                4 => self.array().map(|bytes| f64::from(f32::from_le_bytes(bytes))),
                _ => self.array().map(f64::from_le_bytes),
            };
            *value = T::from_f64(number.unwrap_or(f64::NAN));
        }
    }

    fn whole(&mut self, value: &mut u64) {
        *value = self.array().map_or(0, u64::from_le_bytes);
    }
}
