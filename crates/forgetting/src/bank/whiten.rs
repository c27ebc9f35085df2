//! Errors of a sample in standard deviations of its noise.

use crate::sample::{cholesky, Noise};
use forgetting_kernels::kernel::functions::add_scaled;
use forgetting_kernels::Kernels;

/// e ← Γ^(−1/2) e for p x m numbers e; `root` is a buffer of p x p numbers.
#[inline]
pub(super) fn whiten<T: Kernels>(
    errors: &mut [T],
    targets: usize,
    noise: Noise<'_, T>,
    root: &mut [T],
) {
    match noise {
        Noise::Unit => {}
        Noise::Scalar(gamma) => {
            let scale = T::ONE / gamma.sqrt();
            errors.iter_mut().for_each(|e| *e *= scale);
        }
        Noise::Full(gamma) => whiten_rows(errors, targets, gamma, root),
    }
}

/// The same for a matrix Γ.
fn whiten_rows<T: Kernels>(errors: &mut [T], targets: usize, gamma: &[T], root: &mut [T]) {
    let p = errors.len() / targets;
    // not `copy_from_slice`: a program for a microcontroller would hold what is said of other lengths
    root.iter_mut().zip(gamma).for_each(|(own, &given)| *own = given);
    // the members have already taken a sample with this Γ
    if cholesky(root, p, "gamma").is_err() {
        return;
    }
    for i in 0..p {
        let (above, row) = errors.split_at_mut(i * targets);
        let row = &mut row[..targets];
        for (k, solved) in above.chunks_exact(targets).enumerate() {
            add_scaled(row, -root[i * p + k], solved);
        }
        row.iter_mut().for_each(|e| *e /= root[i * p + i]);
    }
}
