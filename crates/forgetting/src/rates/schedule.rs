//! Takes the factors from a list, one a sample.
//!
//! ```text
//! λ_k = l_(min(k, N − 1))     end = "hold": the last one for ever
//! λ_k = l_(k mod N)           end = "repeat": from the first one again
//! ```
//!
//! | symbol | name | range | default |
//! |---|---|---|---|
//! | l | factors | a number in (0, 1], or N of them | 0.99 |
//! | | end | "hold" or "repeat" | "hold" |
//!
//! - k counts the samples used; one that is skipped takes no factor from the list.
//! - λ is within the smallest and the largest of the list.
//! - Cost: O(1). State: none, the list is configuration.
//! - Use it to forget the start fast, or when it is known when parameters change.
//! - Not where it is the record that has to tell when parameters change.

use super::{Evidence, Rate};
use crate::choice::{About, Kind, Parameter, Range, Value, Values};
use crate::error::Error;
use crate::memory::Memory;
use forgetting_kernels::Real;

const FACTORS: Parameter = Parameter::elements(
    "factors",
    Kind::List,
    0.99,
    Range::FRACTION,
    "forgetting factors, one a sample used",
);
const END: Parameter =
    Parameter::word("end", &["hold", "repeat"], "what follows the last factor of the list");

/// The registry entry.
pub const ABOUT: About = About::new(&[FACTORS, END]);

/// What follows the last factor of a list.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// the last one for ever
    Hold,
    /// the first one again
    Repeat,
}

/// λ from a list; see [`self`](crate::rates::schedule).
#[derive(Clone, Debug)]
pub struct Schedule<M: Memory> {
    factors: M::List,
    count: usize,
    end: End,
    /// whether it was given as a number, not as a list
    number: bool,
}

impl<M: Memory> Schedule<M> {
    /// With these factors, in a list of this `memory`.
    ///
    /// # Errors
    /// [`Error::Length`] for no factors or more than a list can hold, [`Error::Value`] for one
    /// that is not in (0, 1].
    pub fn new(memory: M, factors: &[M::Real], end: End) -> Result<Self, Error> {
        Self::of(memory, factors.len(), &|k| factors[k].to_f64(), end)
    }

    fn of(memory: M, count: usize, factor: &dyn Fn(usize) -> f64, end: End) -> Result<Self, Error> {
        let longest = memory.longest_list();
        if count == 0 || count > longest {
            let expected = count.clamp(1, longest.max(1));
            return Err(Error::Length { parameter: FACTORS.name, length: count, expected });
        }
        let mut factors = memory.list(count);
        for (index, place) in factors.as_mut().iter_mut().enumerate().take(count) {
            // also after rounding to the number type
            let factor = FACTORS.check(M::Real::from_f64(factor(index)));
            *place = factor.map_err(|error| error.at(index))?;
        }
        Ok(Self { factors, count, end, number: false })
    }
}

impl<M: Memory> Rate<M> for Schedule<M> {
    type State = ();

    fn configure(values: &dyn Values, memory: M) -> Result<Self, Error> {
        let end = [End::Hold, End::Repeat][END.choice(values)?];
        match FACTORS.look_up(values)? {
            Value::Real(factor) => {
                Ok(Self { number: true, ..Self::of(memory, 1, &|_| factor, end)? })
            }
            Value::Matrix { rows: 1, columns, elements } => {
                Self::of(memory, columns, elements, end)
            }
            _ => Err(Error::value(FACTORS.name, f64::NAN, "a list of numbers in (0, 1]")),
        }
    }

    fn describe(&self, each: &mut dyn FnMut(&'static str, Value<'_>)) {
        let factors = self.factors.as_ref();
        let elements = |k: usize| factors[k].to_f64();
        each(
            FACTORS.name,
            match self.number {
                true => Value::Real(elements(0)),
                false => Value::Matrix { rows: 1, columns: self.count, elements: &elements },
            },
        );
        let word = match self.end {
            End::Hold => "hold",
            End::Repeat => "repeat",
        };
        each(END.name, Value::Word(word));
    }

    fn start(&self, _: M) {}

    #[inline]
    fn forgetting_factor(&self, (): &(), evidence: &Evidence<'_, '_, M>) -> Result<M::Real, Error> {
        let (k, count) = (evidence.samples, self.count as u64);
        let place = match self.end {
            End::Hold => k.min(count - 1),
            End::Repeat => k % count,
        };
        Ok(self.factors.as_ref()[place as usize])
    }
}

#[cfg(test)]
mod tests {
    use super::{End, Schedule};
    use crate::covariance::Prior;
    use crate::error::Error;
    use crate::estimator::Estimator;
    use crate::memory::{Fixed, Memory};
    use crate::rates::{Constant, Rate};
    use crate::rules::Exponential;
    use crate::weightings::Equal;

    type Three = Fixed<f64, 1, 1, 1, 3>;

    fn factors<R: Rate<Three>>(rate: R) -> [f64; 5] {
        let prior = Prior::scalar(Three::new(), 1.0).unwrap();
        let mut estimator = Estimator::new(Exponential::new(), rate, Equal::new(), prior);
        [(); 5].map(|()| estimator.update(&[1.0], &[1.0]).unwrap().forgetting_factor)
    }

    #[test]
    fn holds_or_repeats() {
        let schedule = |end| Schedule::new(Three::new(), &[0.5, 0.6, 0.7], end).unwrap();
        assert_eq!(factors(schedule(End::Hold)), [0.5, 0.6, 0.7, 0.7, 0.7]);
        assert_eq!(factors(schedule(End::Repeat)), [0.5, 0.6, 0.7, 0.5, 0.6]);
        let one = Schedule::new(Three::new(), &[0.8], End::Repeat).unwrap();
        assert_eq!(factors(one), factors(Constant::new(0.8).unwrap()));
    }

    #[test]
    fn refuses_what_is_no_factor_and_what_does_not_fit() {
        let memory = Three::new();
        let bad = Schedule::new(memory, &[0.9, 1.5], End::Hold);
        assert!(matches!(bad, Err(Error::Value { parameter: "factors", index: Some(1), .. })));
        for count in [0, 4] {
            let bad = Schedule::new(memory, &[0.9; 4][..count], End::Hold);
            assert!(matches!(bad, Err(Error::Length { parameter: "factors", .. })));
        }
        let none = Schedule::new(Fixed::<f64, 1>::new(), &[0.9], End::Hold);
        assert!(none.is_err());
        assert_eq!(memory.longest_list(), 3);
    }
}
