//! How much the kernels need to work with.

use super::along::each;
use super::layout::{BLOCK, FEW};

/// How many numbers the kernels need to work with, for n parameters and any number type.
pub const fn scratch(n: usize) -> usize {
    if n <= FEW {
        n
    } else {
        each(2) * n.div_ceil(2 * BLOCK) * 2 * BLOCK
    }
}
