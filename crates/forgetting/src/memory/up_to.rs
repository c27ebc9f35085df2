//! Numbers on the stack, of sizes known when the estimator is made and at most those known to the
//! compiler.

use super::{Buffer, Grid, Memory, Packed, Size};
use crate::error::Error;
use core::marker::PhantomData;
use forgetting_kernels::kernel::layout::{capacity, set_identity};
use forgetting_kernels::kernel::scratch;
use forgetting_kernels::Kernels;

/// 1 to `N` parameters (at most 32), one row, one target; no heap. It takes the room of `N`.
///
/// `L` is the room for lists: a rate that looks back over a window needs as many numbers.
#[derive(Clone, Copy, Debug)]
pub struct UpTo<T, const N: usize, const L: usize = 0> {
    parameters: usize,
    real: PhantomData<T>,
}

impl<T, const N: usize, const L: usize> UpTo<T, N, L> {
    /// For n = `parameters`.
    ///
    /// # Errors
    /// [`Error::Value`] unless n is from 1 to `N`.
    pub fn new(parameters: usize) -> Result<Self, Error> {
        if (1..=N).contains(&parameters) {
            return Ok(Self { parameters, real: PhantomData });
        }
        let allowed = "whole numbers from 1 to the most that this memory is for";
        Err(Error::value("parameters", parameters as f64, allowed))
    }
}

/// The first numbers of a buffer.
#[derive(Clone, Copy, Debug)]
pub struct Part<B> {
    buffer: B,
    length: usize,
}

impl<T, B: AsRef<[T]>> AsRef<[T]> for Part<B> {
    #[inline(always)]
    fn as_ref(&self) -> &[T] {
        let all = self.buffer.as_ref();
        &all[..self.length.min(all.len())]
    }
}

impl<T, B: AsMut<[T]>> AsMut<[T]> for Part<B> {
    #[inline(always)]
    fn as_mut(&mut self) -> &mut [T] {
        let all = self.buffer.as_mut();
        let length = self.length.min(all.len());
        &mut all[..length]
    }
}

impl<B> Part<B> {
    /// Of `buffer`, as many as the `length` that the sizes ask for.
    pub(super) fn new<T>(buffer: B, length: usize) -> Self
    where
        B: Buffer<T>,
    {
        Self { buffer, length }
    }
}

impl<T: Kernels, const N: usize, const L: usize> Memory for UpTo<T, N, L>
where
    Size<N>: Packed<T>,
{
    type Real = T;
    type Vector = Part<[T; N]>;
    type Packed = Part<<Size<N> as Packed<T>>::Triangle>;
    type Square = Part<Grid<T, N, N>>;
    type Rows = Part<[T; N]>;
    type Noise = [T; 1];
    type Errors = [T; 1];
    type Parameters = Part<[T; N]>;
    type Scratch = Part<<Size<N> as Packed<T>>::Scratch>;
    type List = Part<[T; L]>;
    type Optional = Part<<Size<N> as Packed<T>>::Symmetric>;

    #[inline(always)]
    fn parameters(&self) -> usize {
        self.parameters
    }
    #[inline(always)]
    fn rows(&self) -> usize {
        1
    }
    #[inline(always)]
    fn targets(&self) -> usize {
        1
    }
    fn of_sizes(parameters: usize, rows: usize, targets: usize) -> Result<Self, Error> {
        Error::check_length("rows", rows, 1)?;
        Error::check_length("targets", targets, 1)?;
        Self::new(parameters)
    }
    fn vector(&self) -> Self::Vector {
        Part::new([T::ZERO; N], self.parameters)
    }
    fn packed(&self) -> Self::Packed {
        let mut columns = Part::new(Size::<N>::triangle(), capacity::<T>(self.parameters));
        set_identity(columns.as_mut(), self.parameters);
        columns
    }
    fn square(&self) -> Self::Square {
        Part::new(Grid::zeros(), self.parameters * self.parameters)
    }
    fn regressors(&self) -> Self::Rows {
        self.vector()
    }
    fn noise(&self) -> [T; 1] {
        [T::ZERO]
    }
    fn errors(&self) -> [T; 1] {
        [T::ZERO]
    }
    fn theta(&self) -> Self::Parameters {
        self.vector()
    }
    fn scratch(&self) -> Self::Scratch {
        Part::new(<Size<N> as Packed<T>>::scratch(), scratch(self.parameters))
    }
    fn list(&self, length: usize) -> Self::List {
        Part::new([T::ZERO; L], length.min(L))
    }
    fn optional(&self, length: usize) -> Self::Optional {
        Part::new(Size::<N>::symmetric(), length)
    }
    fn longest_list(&self) -> usize {
        L
    }
}
