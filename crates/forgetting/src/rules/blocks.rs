//! Consecutive blocks of parameters, for the rules that treat them apart.

use crate::choice::{Parameter, Value, Values};
use crate::error::Error;
use crate::memory::Memory;
use core::ops::Range;
use forgetting_kernels::Real;

/// Blocks of consecutive parameters, in their order and without gaps.
#[derive(Clone, Debug)]
pub struct Blocks<M: Memory> {
    /// their sizes, as numbers, the first `count` elements
    sizes: M::Vector,
    count: usize,
    /// whether one number stands for all sizes
    alike: bool,
}

impl<M: Memory> Blocks<M> {
    /// The blocks of these sizes.
    ///
    /// # Errors
    /// [`Error::Value`] names `blocks` unless they are positive and sum to the number of
    /// parameters.
    pub fn new(memory: M, sizes: &[usize]) -> Result<Self, Error> {
        Self::of("blocks", memory, sizes.len(), false, &|b| sizes[b] as f64)
    }

    /// The blocks given for `parameter`: their sizes, or one size for all.
    ///
    /// # Errors
    /// [`Error::Value`] names it unless they are positive and sum to the number of parameters.
    pub fn configure(parameter: &Parameter, values: &dyn Values, memory: M) -> Result<Self, Error> {
        let n = memory.parameters();
        match parameter.look_up(values)? {
            Value::Real(size) => {
                let count = n as f64 / parameter.check(size)?;
                Self::of(parameter.name, memory, count as usize, true, &|_| size)
            }
            Value::Matrix { rows, columns, elements } => {
                Self::of(parameter.name, memory, rows.saturating_mul(columns), false, elements)
            }
            _ => Err(Error::value(parameter.name, f64::NAN, "numbers")),
        }
    }

    fn of(
        name: &'static str,
        memory: M,
        count: usize,
        alike: bool,
        size: &dyn Fn(usize) -> f64,
    ) -> Result<Self, Error> {
        const ALLOWED: &str = "whole numbers from 1 that sum to the number of parameters";
        let n = memory.parameters();
        let (mut sizes, mut sum) = (memory.vector(), 0.0);
        for b in 0..count {
            let size = size(b);
            sum += size;
            if !(size >= 1.0 && libm::trunc(size) == size && sum <= n as f64) {
                let index = (!alike).then_some(b);
                return Err(Error::Value { parameter: name, index, value: size, allowed: ALLOWED });
            }
            sizes.as_mut()[b] = M::Real::from_f64(size);
        }
        if sum == n as f64 {
            Ok(Self { sizes, count, alike })
        } else {
            Err(Error::value(name, sum, ALLOWED))
        }
    }

    /// How many blocks there are.
    #[inline]
    pub fn count(&self) -> usize {
        self.count
    }

    /// The size of block `b`, as a number.
    pub fn size(&self, b: usize) -> f64 {
        self.sizes.as_ref()[..self.count][b].to_f64()
    }

    /// The places of each block's parameters.
    #[inline]
    pub fn ranges(&self) -> impl Iterator<Item = Range<usize>> + '_ {
        self.sizes.as_ref()[..self.count].iter().scan(0, |start, size| {
            let range = *start..*start + size.to_f64() as usize;
            *start = range.end;
            Some(range)
        })
    }

    /// Names the sizes as they were given.
    pub fn describe(&self, name: &'static str, each: &mut dyn FnMut(&'static str, Value<'_>)) {
        let elements = |b: usize| self.size(b);
        if self.alike {
            each(name, Value::Real(elements(0)));
        } else {
            each(name, Value::Matrix { rows: 1, columns: self.count, elements: &elements });
        }
    }
}
