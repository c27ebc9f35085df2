//! A vector beside U, in chunks of as many numbers as a tile has rows.

use super::{PerColumn, BLOCK};
use crate::number::{copy_first, Real};

/// A vector to be read.
#[derive(Clone, Copy)]
pub struct Long<'a, T: Real> {
    full: &'a [T::Chunk],
    /// the numbers after the last full chunk, and zeros
    tail: T::Chunk,
}

impl<'a, T: Real> Long<'a, T> {
    #[inline(always)]
    pub fn new(numbers: &'a [T]) -> Self {
        let (full, rest) = T::chunks(numbers);
        Self { full, tail: T::chunk(rest) }
    }

    /// The first `tiles` chunks: those within the vector, and the one that reaches beyond it.
    #[inline(always)]
    pub fn first(&self, tiles: usize) -> (&[T::Chunk], Option<&T::Chunk>) {
        let tail = (tiles > self.full.len()).then_some(&self.tail);
        (&self.full[..tiles.min(self.full.len())], tail)
    }
}

/// A vector to be written; [`LongMut::finish`] puts its end back.
pub struct LongMut<'a, T: Real> {
    full: &'a mut [T::Chunk],
    tail: T::Chunk,
    rest: &'a mut [T],
}

impl<'a, T: Real> LongMut<'a, T> {
    #[inline(always)]
    pub fn new(numbers: &'a mut [T]) -> Self {
        let (full, rest) = T::chunks_mut(numbers);
        let tail = T::chunk(rest);
        Self { full, tail, rest }
    }

    /// The first `tiles` chunks, as of [`Long`].
    #[inline(always)]
    pub fn first(&mut self, tiles: usize) -> (&mut [T::Chunk], Option<&mut T::Chunk>) {
        let (count, tail) = (self.full.len(), &mut self.tail);
        let tail = (tiles > count).then_some(tail);
        (&mut self.full[..tiles.min(count)], tail)
    }

    /// The chunk beside the tiles of row `t`.
    #[inline(always)]
    pub fn chunk(&self, t: usize) -> &T::Chunk {
        match self.full.get(t) {
            Some(chunk) => chunk,
            None => &self.tail,
        }
    }

    /// The same, to be written.
    #[inline(always)]
    pub fn chunk_mut(&mut self, t: usize) -> &mut T::Chunk {
        match self.full.get_mut(t) {
            Some(chunk) => chunk,
            None => &mut self.tail,
        }
    }

    /// The numbers of block `b`.
    #[inline(always)]
    pub fn per_column(&mut self, b: usize) -> &mut PerColumn<T> {
        match self.chunk_mut(b * BLOCK / T::ROWS).as_mut()[b * BLOCK % T::ROWS..].first_chunk_mut()
        {
            Some(eight) => eight,
            None => unreachable!("a chunk holds whole blocks"),
        }
    }

    #[inline(always)]
    pub fn finish(self) {
        copy_first(self.rest, self.tail.as_ref());
    }
}
