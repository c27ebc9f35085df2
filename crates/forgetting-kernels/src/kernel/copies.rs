//! Copies of numbers without a call: chunk by chunk, and what is left over number by number.

use crate::number::vector::Vector;
use crate::number::{copy_first, Real};

/// Copies as many numbers as both have.
// not `copy_from_slice`: that is a call, for which all registers are put away
#[inline(always)]
pub fn copy<T: Real, V: Vector<T>>(from: &[T], to: &mut [T]) {
    let ((from, from_rest), (to, to_rest)) = (T::chunks(from), T::chunks_mut(to));
    for i in 0..from.len().min(to.len()) {
        V::load(&from[i]).store(&mut to[i]);
    }
    copy_first(to_rest, from_rest);
}

/// As many numbers as a vector has, or fewer and zeros.
#[inline(always)]
pub fn first_of<T: Real, V: Vector<T>>(numbers: &[T]) -> V {
    match T::chunks(numbers).0.first() {
        Some(chunk) => V::load(chunk),
        None => V::load(&T::chunk(numbers)),
    }
}

/// Writes a vector where there is room for as many numbers, or the first of them.
#[inline(always)]
pub fn put_first<T: Real, V: Vector<T>>(to: &mut [T], vector: V) {
    match T::chunks_mut(to).0.first_mut() {
        Some(chunk) => vector.store(chunk),
        None => {
            let mut chunk = T::chunk(&[]);
            vector.store(&mut chunk);
            copy_first(to, chunk.as_ref());
        }
    }
}
