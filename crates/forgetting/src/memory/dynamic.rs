//! Numbers on the heap, of sizes known when they are made.

use super::Memory;
use crate::error::Error;
use alloc::{vec, vec::Vec};
use core::marker::PhantomData;
use forgetting_kernels::kernel::layout::{capacity, set_identity};
use forgetting_kernels::kernel::scratch;
use forgetting_kernels::{Kernels, Real};

/// Sizes chosen when the estimator is made; its buffers are on the heap.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dynamic<T> {
    parameters: usize,
    rows: usize,
    targets: usize,
    real: PhantomData<T>,
}

impl<T: Real> Dynamic<T> {
    /// The most numbers that a list can hold.
    pub const LONGEST_LIST: usize = 1 << 20;

    /// The sizes allowed, in words.
    pub const SIZES: &'static str = "whole numbers from 1 to 32768";

    /// `parameters` n, `rows` p and `targets` m, each from 1 to 2¹⁵.
    ///
    /// # Errors
    /// [`Error::Value`] names the size that is out of range.
    pub fn new(parameters: usize, rows: usize, targets: usize) -> Result<Self, Error> {
        let sizes = [("parameters", parameters), ("rows", rows), ("targets", targets)];
        for (name, size) in sizes {
            if !(1..=1 << 15).contains(&size) {
                return Err(Error::value(name, size as f64, Self::SIZES));
            }
        }
        Ok(Self { parameters, rows, targets, real: PhantomData })
    }
}

/// Refuses so many numbers if there is no memory for them.
///
/// # Errors
/// [`Error::Memory`].
fn check_room<T: Real>(numbers: u64) -> Result<(), Error> {
    /// Bytes that there always are.
    const SMALL: u64 = 1 << 20;
    let bytes = numbers.saturating_mul(T::BYTES as u64);
    if bytes <= SMALL {
        return Ok(());
    }
    let bytes = usize::try_from(bytes).map_err(|_| Error::Memory)?;
    Vec::<u8>::new().try_reserve_exact(bytes).map_err(|_| Error::Memory)
}

/// So many zeros.
///
/// # Errors
/// [`Error::Memory`] when there is no memory for them.
pub fn zeros<X: Clone + Default>(length: usize) -> Result<Vec<X>, Error> {
    let mut zeros = Vec::new();
    zeros.try_reserve_exact(length).map_err(|_| Error::Memory)?;
    zeros.resize(length, X::default());
    Ok(zeros)
}

/// Numbers on the heap, the first of them at the start of a cache line: a vector that lies
/// across two lines costs twice.
#[derive(Debug)]
pub struct Aligned<T> {
    numbers: Vec<T>,
    first: usize,
    length: usize,
}

impl<T: Real> Aligned<T> {
    const LINE: usize = 64;

    fn zeros(length: usize) -> Self {
        if length == 0 {
            return Self { numbers: Vec::new(), first: 0, length };
        }
        let spare = Self::LINE / T::BYTES;
        let numbers = vec![T::ZERO; length + spare];
        let first = numbers.as_ptr().align_offset(Self::LINE).min(spare);
        Self { numbers, first, length }
    }
}

impl<T: Real> Clone for Aligned<T> {
    fn clone(&self) -> Self {
        let mut copy = Self::zeros(self.length);
        copy.as_mut().copy_from_slice(self.as_ref());
        copy
    }
}

impl<T> AsRef<[T]> for Aligned<T> {
    #[inline(always)]
    fn as_ref(&self) -> &[T] {
        &self.numbers[self.first..self.first + self.length]
    }
}

impl<T> core::ops::Deref for Aligned<T> {
    type Target = [T];
    #[inline(always)]
    fn deref(&self) -> &[T] {
        self.as_ref()
    }
}

impl<T> AsMut<[T]> for Aligned<T> {
    #[inline(always)]
    fn as_mut(&mut self) -> &mut [T] {
        &mut self.numbers[self.first..self.first + self.length]
    }
}

impl<T: Kernels> Memory for Dynamic<T> {
    type Real = T;
    type Vector = Aligned<T>;
    type Packed = Aligned<T>;
    type Square = Aligned<T>;
    type Rows = Aligned<T>;
    type Noise = Aligned<T>;
    type Errors = Aligned<T>;
    type Parameters = Aligned<T>;
    type Scratch = Aligned<T>;
    type List = Aligned<T>;
    type Optional = Aligned<T>;

    #[inline(always)]
    fn parameters(&self) -> usize {
        self.parameters
    }
    #[inline(always)]
    fn rows(&self) -> usize {
        self.rows
    }
    #[inline(always)]
    fn targets(&self) -> usize {
        self.targets
    }
    fn of_sizes(parameters: usize, rows: usize, targets: usize) -> Result<Self, Error> {
        Self::new(parameters, rows, targets)
    }
    fn check_room(&self, squares: usize, count: usize) -> Result<(), Error> {
        let Self { parameters: n, rows: p, targets: m, .. } = *self;
        // each at most 2³⁰
        let of_rows = p * (2 * p + 8 * n + 6 * m);
        let numbers = (squares + 1) as u64 * (n * n) as u64 + (of_rows + 4 * m * n) as u64;
        check_room::<T>(numbers.saturating_mul(count as u64))
    }
    fn vector(&self) -> Aligned<T> {
        Aligned::zeros(self.parameters)
    }
    fn packed(&self) -> Aligned<T> {
        let mut columns = Aligned::zeros(capacity::<T>(self.parameters));
        set_identity(columns.as_mut(), self.parameters);
        columns
    }
    fn square(&self) -> Aligned<T> {
        Aligned::zeros(self.parameters * self.parameters)
    }
    fn regressors(&self) -> Aligned<T> {
        Aligned::zeros(self.rows * self.parameters)
    }
    fn noise(&self) -> Aligned<T> {
        Aligned::zeros(self.rows * self.rows)
    }
    fn errors(&self) -> Aligned<T> {
        Aligned::zeros(self.rows * self.targets)
    }
    fn theta(&self) -> Aligned<T> {
        Aligned::zeros(self.targets * self.parameters)
    }
    fn scratch(&self) -> Aligned<T> {
        Aligned::zeros(scratch(self.parameters))
    }
    fn list(&self, length: usize) -> Aligned<T> {
        Aligned::zeros(length.min(Self::LONGEST_LIST))
    }
    fn optional(&self, length: usize) -> Aligned<T> {
        Aligned::zeros(length)
    }
    fn longest_list(&self) -> usize {
        Self::LONGEST_LIST
    }
}
