//! Sums across the numbers of vectors.

mod pair;
mod wide;
