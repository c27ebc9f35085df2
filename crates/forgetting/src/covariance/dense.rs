//! From a dense symmetric matrix to the factor.

use super::Factor;
use crate::error::Error;
use crate::memory::Memory;
use forgetting_kernels::kernel::{functions, layout};
use forgetting_kernels::Real;

impl<M: Memory> Factor<M> {
    /// The factor of the n x n matrix `covariance`, of which it reads the upper triangle.
    ///
    /// # Errors
    /// [`Error::Length`], [`Error::Value`] for an element that is not finite, and
    /// [`Error::Indefinite`] unless the matrix is symmetric and positive definite.
    pub fn dense(memory: M, covariance: &[M::Real]) -> Result<Self, Error> {
        const NAME: &str = "initial_covariance";
        let n = memory.parameters();
        Error::check_length(NAME, covariance.len(), n * n)?;
        check_symmetric(NAME, covariance, n)?;
        let mut factor = Self::scalar(memory, M::Real::ONE)?;
        let mut work = memory.square();
        work.as_mut().copy_from_slice(covariance);
        factor.replace(work.as_mut(), NAME)?;
        Ok(factor)
    }

    /// P ← that of `other`, of the same sizes.
    pub fn copy_from(&mut self, other: &Self) {
        self.columns.as_mut().copy_from_slice(other.columns.as_ref());
        self.diagonal.as_mut().copy_from_slice(other.diagonal.as_ref());
        self.trace_bound = other.trace_bound;
        self.deferred.copy_from(&other.deferred);
    }

    /// P ← the n x n matrix `covariance`, of which it reads the upper triangle and which it uses
    /// up. O(n³/6).
    ///
    /// # Errors
    /// [`Error::Indefinite`] unless the matrix is positive definite, [`Error::Range`] when it
    /// is too large; P is as it was.
    pub fn replace(&mut self, covariance: &mut [M::Real], name: &'static str) -> Result<(), Error> {
        let n = self.parameters();
        let mut trace = M::Real::ZERO;
        for j in 0..n {
            trace += covariance[j * n + j];
        }
        decompose(covariance, n, name)?;
        if !(trace < M::Real::CEILING) {
            let limit = M::Real::CEILING.to_f64();
            return Err(Error::Range { parameter: name, value: trace.to_f64(), limit });
        }
        for j in 0..n {
            for i in 0..j {
                self.columns.as_mut()[layout::place::<M::Real>(i, j)] = covariance[i * n + j];
            }
            self.put_diagonal(j, covariance[j * n + j]);
        }
        self.trace_bound = trace;
        Ok(())
    }

    /// P ← diag(`variances`), n numbers. O(n²).
    ///
    /// # Errors
    /// [`Error::Indefinite`] unless each is positive, [`Error::Range`] when their sum is too large;
    /// P is as it was.
    pub fn replace_diagonal(
        &mut self,
        variances: &[M::Real],
        name: &'static str,
    ) -> Result<(), Error> {
        if let Some(x) = variances.iter().find(|&&x| !(x > M::Real::ZERO)) {
            let pivot = x.to_f64();
            return Err(Error::Indefinite { parameter: name, pivot, allowed: "positive definite" });
        }
        let trace = variances.iter().fold(M::Real::ZERO, |sum, &x| sum + x);
        if !(trace < M::Real::CEILING) {
            let limit = M::Real::CEILING.to_f64();
            return Err(Error::Range { parameter: name, value: trace.to_f64(), limit });
        }
        self.clear_columns();
        for (j, &x) in variances.iter().enumerate() {
            self.put_diagonal(j, x);
        }
        self.trace_bound = trace;
        Ok(())
    }

    /// P⁻¹ ← the n x n matrix `information`, of which it reads the lower triangle and which it
    /// uses up. O(n³/3).
    ///
    /// # Errors
    /// [`Error::Indefinite`] unless each pivot is above `pivot`, the rounding that the matrix is
    /// known to, [`Error::Range`] when P would be too large; P is as it was.
    pub fn replace_information(
        &mut self,
        information: &mut [M::Real],
        pivot: impl Fn(usize) -> M::Real,
        name: &'static str,
    ) -> Result<(), Error> {
        let n = self.parameters();
        decompose_information(information, n, pivot, name)?;
        invert_unit_lower(information, n);
        // P = L⁻ᵀ D L⁻¹: row i of L⁻¹ is column i of U
        let trace = (0..n).fold(M::Real::ZERO, |trace, i| {
            let row = &information[i * n..i * n + i];
            trace + (M::Real::ONE + functions::dot(row, row)) / information[i * n + i]
        });
        if !(trace < M::Real::CEILING) {
            let limit = M::Real::CEILING.to_f64();
            return Err(Error::Range { parameter: name, value: trace.to_f64(), limit });
        }
        for i in 0..n {
            layout::put_column(self.columns.as_mut(), i, &information[i * n..]);
            self.put_diagonal(i, M::Real::ONE / information[i * n + i]);
        }
        self.trace_bound = trace;
        Ok(())
    }
}

/// A = L D Lᵀ in place, D on the diagonal and L below it.
fn decompose_information<T: Real>(
    a: &mut [T],
    n: usize,
    least: impl Fn(usize) -> T,
    name: &'static str,
) -> Result<(), Error> {
    for i in 0..n {
        for j in 0..=i {
            // a_ij − Σ_k<j L_ik D_k L_jk, the row i still holding L_ik D_k
            let mut sum = a[i * n + j];
            for k in 0..j {
                let other = if j == i { a[i * n + k] / a[k * n + k] } else { a[j * n + k] };
                sum -= a[i * n + k] * other;
            }
            a[i * n + j] = sum;
        }
        let d = a[i * n + i];
        if !(d > least(i) && d.is_finite()) {
            let pivot = d.to_f64();
            return Err(Error::Indefinite { parameter: name, pivot, allowed: "positive definite" });
        }
        for k in 0..i {
            let d = a[k * n + k];
            a[i * n + k] /= d;
        }
    }
    Ok(())
}

/// L ← L⁻¹ below the diagonal, L unit lower triangular.
fn invert_unit_lower<T: Real>(a: &mut [T], n: usize) {
    for i in 0..n {
        for j in 0..i {
            // −(L_ij + Σ_j<k<i L_ik (L⁻¹)_kj): rows above i are inverted already
            let mut sum = a[i * n + j];
            for k in j + 1..i {
                sum += a[i * n + k] * a[k * n + j];
            }
            a[i * n + j] = -sum;
        }
    }
}

/// A = U D Uᵀ in place, D on the diagonal and U above it, from the last column to the first.
fn decompose<T: Real>(a: &mut [T], n: usize, name: &'static str) -> Result<(), Error> {
    for j in (0..n).rev() {
        let d = a[j * n + j];
        if !(d > T::ZERO && d.is_finite()) {
            let pivot = d.to_f64();
            return Err(Error::Indefinite { parameter: name, pivot, allowed: "positive definite" });
        }
        for i in 0..j {
            a[i * n + j] /= d;
        }
        for k in 0..j {
            let weight = a[k * n + j] * d;
            for i in 0..=k {
                let u = a[i * n + j];
                a[i * n + k] -= u * weight;
            }
        }
    }
    Ok(())
}

/// Refuses a matrix with an element that is not finite or a pair that is not symmetric.
pub(crate) fn check_symmetric<T: Real>(
    name: &'static str,
    matrix: &[T],
    n: usize,
) -> Result<(), Error> {
    let refuse = |index: usize, allowed| {
        let value = matrix[index].to_f64();
        Err(Error::Value { parameter: name, index: Some(index), value, allowed })
    };
    if let Some(index) = matrix.iter().position(|x| !x.is_finite()) {
        return refuse(index, "finite numbers");
    }
    let tolerance = T::from_f64(1e3) * T::EPSILON;
    for i in 0..n {
        for j in i + 1..n {
            let (x, y) = (matrix[i * n + j], matrix[j * n + i]);
            let scale = (matrix[i * n + i] * matrix[j * n + j]).abs().sqrt();
            if (x - y).abs() > tolerance * scale.max(x.abs()) {
                return refuse(j * n + i, "a symmetric matrix");
            }
        }
    }
    Ok(())
}
