//! Reading a state. Nothing here trusts the bytes: a length is checked before it is used.

use super::{AnyGate, AnyRate, AnyWeighting, Error, Estimator, Memory, Named, Open, Prior};
use super::{Real, Rule, Value, Values, Visitor, MONITORED, NOISE_ESTIMATED};
use crate::choice::Defaults;

/// Parameters that a choice has at most.
const MOST_PARAMETERS: usize = 8;
const UNKNOWN: &str = "a parameter in it is of an unknown kind";

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
    pub fn skip_old_monitor<T: Real>(&mut self, n: usize) -> Result<(), Error> {
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

    fn word(&mut self) -> Result<&'a str, Error> {
        let length = usize::from(u16::from_le_bytes(self.array()?));
        let text = core::str::from_utf8(self.take(length)?);
        text.map_err(|_| Error::State { reason: "a name in it is not text" })
    }

    /// A name and its parameters, of which one may be a choice in itself.
    pub fn choice(&mut self) -> Result<(&'a str, impl Values + Names + 'a), Error> {
        self.choice_of(|reader| {
            reader.choice_of(|_| Err::<(&str, Defaults), _>(Error::State { reason: UNKNOWN }))
        })
    }

    /// A name and its parameters; `inner` reads one that is a choice in itself.
    fn choice_of<I: Values>(
        &mut self,
        inner: impl Fn(&mut Self) -> Result<(&'a str, I), Error>,
    ) -> Result<Chosen<'a, impl Fn(usize) -> f64 + 'a, I>, Error> {
        let name = self.word()?;
        let count = usize::from(self.byte()?);
        if count > MOST_PARAMETERS {
            return Err(Error::State { reason: "it has more parameters than there are" });
        }
        let mut parameters = Parameters { list: [const { None }; MOST_PARAMETERS], inner: None };
        for (k, place) in parameters.list.iter_mut().enumerate().take(count) {
            let name = self.word()?;
            let value = match self.byte()? {
                0 => SavedValue::Real(f64::from_le_bytes(self.array()?)),
                1 => SavedValue::Word(self.word()?),
                2 => {
                    let (rows, columns) = (self.size()?, self.size()?);
                    let bytes = self.take(rows.saturating_mul(columns).saturating_mul(8))?;
                    SavedValue::Matrix { rows, columns, elements: elements(bytes) }
                }
                3 if parameters.inner.is_none() => {
                    parameters.inner = Some((k, inner(self)?));
                    SavedValue::Inner
                }
                _ => return Err(Error::State { reason: UNKNOWN }),
            };
            *place = Some((name, value));
        }
        Ok((name, parameters))
    }
}

/// The number at each position of `bytes`, eight each.
fn elements(bytes: &[u8]) -> impl Fn(usize) -> f64 + '_ {
    move |k| match bytes.chunks_exact(8).nth(k) {
        Some(bytes) => bytes.try_into().map_or(f64::NAN, f64::from_le_bytes),
        None => f64::NAN,
    }
}

enum SavedValue<'a, E> {
    Real(f64),
    Word(&'a str),
    Matrix {
        rows: usize,
        columns: usize,
        elements: E,
    },
    /// the one that is a choice in itself
    Inner,
}

/// A name and its parameters.
type Chosen<'a, E, I> = (&'a str, Parameters<'a, E, I>);

/// The parameters of a choice, in the bytes that they were saved in.
pub struct Parameters<'a, E, I> {
    list: [Option<(&'a str, SavedValue<'a, E>)>; MOST_PARAMETERS],
    inner: Option<(usize, (&'a str, I))>,
}

impl<E: Fn(usize) -> f64, I: Values> Values for Parameters<'_, E, I> {
    fn get(&self, name: &str) -> Option<Value<'_>> {
        let (_, given) = self.list.iter().flatten().find(|(known, _)| *known == name)?;
        Some(match given {
            SavedValue::Real(x) => Value::Real(*x),
            SavedValue::Word(word) => Value::Word(word),
            SavedValue::Matrix { rows, columns, elements } => {
                Value::Matrix { rows: *rows, columns: *columns, elements }
            }
            SavedValue::Inner => {
                let (_, (name, values)) = self.inner.as_ref()?;
                Value::Choice { name, values }
            }
        })
    }
}

/// The words among parameters, which may be names of rules.
pub trait Names {
    /// Each of them.
    fn names(&self, each: &mut dyn FnMut(&str));
}

impl<E, I> Names for Parameters<'_, E, I> {
    fn names(&self, each: &mut dyn FnMut(&str)) {
        for (_, value) in self.list.iter().flatten() {
            if let SavedValue::Word(name) = value {
                each(name);
            }
        }
        if let Some((_, (name, _))) = &self.inner {
            each(name);
        }
    }
}

/// The bytes that a state of these sizes takes at least: θ₀, P₀ in this form, U, D, the bound of
/// P's trace and θ.
pub(super) fn least_length<M: Memory>(memory: M, form: u8) -> usize {
    let (n, m) = (memory.parameters(), memory.targets());
    let factor = n * (n + 1) / 2 + 1;
    let prior = match form {
        0 => 1,
        1 => n,
        2 => factor,
        _ => 0,
    };
    (2 * m * n + prior + factor) * M::Real::BYTES
}

/// Refuses more rows than a state of so many bytes can be of: rows take memory, but no place in it.
///
/// # Errors
/// [`Error::State`].
pub(super) fn check_rows<M: Memory>(memory: M, length: usize) -> Result<(), Error> {
    /// Numbers in the buffers for a sample that any state may have.
    const MOST: usize = 1 << 22;
    let (n, p, m) = (memory.parameters(), memory.rows(), memory.targets());
    if p * (p + n + m) <= MOST.max(length) {
        return Ok(());
    }
    Err(Error::State { reason: "it has too many rows to be saved: at most about 2000" })
}

/// Refuses an estimator for which there is no memory.
fn check_memory<M: Memory>(
    memory: M,
    (rule, parameters): (&str, &impl Names),
    form: u8,
) -> Result<(), Error> {
    // P₀ as a matrix is one more
    let mut squares = usize::from(form == 2);
    let mut add = |name: &str| squares += Rule::<M>::entry(name).map_or(0, |about| about.squares);
    parameters.names(&mut add);
    add(rule);
    memory.check_room(squares, 1)
}

/// The estimator described before the numbers, with the prior's numbers but its first state; and
/// whether the monitor of version 1, which held fewer numbers than today's, follows.
pub fn header<M: Memory>(reader: &mut Reader<'_>, version: u8) -> Result<(Named<M>, bool), Error> {
    if usize::from(reader.byte()?) != M::Real::BYTES {
        return Err(Error::State { reason: "it holds numbers of another type" });
    }
    let memory = M::of_sizes(reader.size()?, reader.size()?, reader.size()?)?;
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
    let (name, parameters) = reader.choice()?;
    check_memory(memory, (name, &parameters), form)?;
    let rule = Rule::named(name, &parameters, memory)?;
    let (name, parameters) = reader.choice()?;
    let rate = AnyRate::named(name, &parameters, memory)?;
    let (name, parameters) = reader.choice()?;
    let weighting = AnyWeighting::named(name, &parameters, memory)?;
    let gate = if version == 1 {
        AnyGate::Open(Open::new())
    } else {
        let (name, parameters) = reader.choice()?;
        AnyGate::named(name, &parameters, memory)?
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

#[cfg(test)]
mod tests {
    use super::MOST_PARAMETERS;

    #[test]
    fn every_choice_can_be_read() {
        for about in crate::AXES.iter().flat_map(|axis| axis.entries) {
            assert!(about.parameters.len() <= MOST_PARAMETERS, "{}", about.name);
        }
    }
}
