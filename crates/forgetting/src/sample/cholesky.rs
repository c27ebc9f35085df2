//! The Cholesky factorization of a small dense matrix.

use crate::error::Error;
use forgetting_kernels::kernel::functions::dot;
use forgetting_kernels::Kernels;

/// A = L Lᵀ of the p x p matrix `a`, L in its lower triangle.
///
/// # Errors
/// [`Error::Indefinite`] names `parameter`.
pub(crate) fn cholesky<T: Kernels>(
    a: &mut [T],
    p: usize,
    parameter: &'static str,
) -> Result<(), Error> {
    for j in 0..p {
        let (done, _) = a[j * p..].split_at(j);
        let pivot = a[j * p + j] - dot(done, done);
        if !(pivot > T::ZERO && pivot.is_finite()) {
            let pivot = pivot.to_f64();
            return Err(Error::Indefinite { parameter, pivot, allowed: "positive definite" });
        }
        let diagonal = pivot.sqrt();
        a[j * p + j] = diagonal;
        for i in j + 1..p {
            let sum = dot(&a[i * p..i * p + j], &a[j * p..j * p + j]);
            a[i * p + j] = (a[i * p + j] - sum) / diagonal;
        }
    }
    Ok(())
}
