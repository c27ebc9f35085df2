//! A positive semidefinite matrix that a rule is given, and its root: A = Σ_i r_iᵀ r_i.

use crate::choice::{Parameter, Value, Values};
use crate::covariance::dense::check_symmetric;
use crate::covariance::spectrum::make_orthogonal;
use crate::covariance::Factor;
use crate::error::Error;
use crate::memory::Memory;
use forgetting_kernels::kernel::functions::{add_scaled, dot};
use forgetting_kernels::Kernels;
use forgetting_kernels::Real;

/// How the matrix was given.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Form {
    Scalar,
    Diagonal,
    Dense,
}

/// The matrix as it was given, and as many rows of n numbers as it has rank.
#[derive(Clone, Debug)]
pub struct Root<M: Memory> {
    memory: M,
    form: Form,
    given: M::Square,
    rank: usize,
    rows: M::Square,
}

impl<M: Memory> Root<M> {
    /// The root of the matrix given for `parameter`: a number c (for c·I), n numbers (a
    /// diagonal) or n x n numbers.
    ///
    /// # Errors
    /// [`Error`] names the parameter: a length that does not fit, an element out of range, a
    /// matrix that is not positive semidefinite.
    pub fn configure(parameter: &Parameter, values: &dyn Values, memory: M) -> Result<Self, Error> {
        let n = memory.parameters();
        match parameter.look_up(values)? {
            Value::Real(c) => Self::diagonal(parameter, Form::Scalar, &|_| c, memory),
            Value::Matrix { rows: 1, columns, elements } => {
                Error::check_length(parameter.name, columns, n)?;
                Self::diagonal(parameter, Form::Diagonal, elements, memory)
            }
            Value::Matrix { rows, columns, elements } => {
                Error::check_length(parameter.name, rows * columns, n * n)?;
                Self::dense(parameter.name, elements, memory)
            }
            _ => Err(Error::value(parameter.name, f64::NAN, "numbers")),
        }
    }

    /// The root of c·I.
    ///
    /// # Errors
    /// [`Error::Value`] names `parameter` unless c is in its range.
    pub fn scalar(parameter: &Parameter, c: M::Real, memory: M) -> Result<Self, Error> {
        Self::diagonal(parameter, Form::Scalar, &|_| c.to_f64(), memory)
    }

    fn diagonal(
        parameter: &Parameter,
        form: Form,
        elements: &dyn Fn(usize) -> f64,
        memory: M,
    ) -> Result<Self, Error> {
        let n = memory.parameters();
        let (mut given, mut rows, mut rank) = (memory.square(), memory.square(), 0);
        for i in 0..n {
            let element = parameter.convert(elements(i))?;
            check_size(parameter.name, i, element)?;
            given.as_mut()[i] = element;
            if element > M::Real::ZERO {
                rows.as_mut()[rank * n + i] = element.sqrt();
                rank += 1;
            }
        }
        Ok(Self { memory, form, given, rank, rows })
    }

    /// By Cholesky's factorization with diagonal pivots, which finds the rank.
    fn dense(
        name: &'static str,
        elements: &dyn Fn(usize) -> f64,
        memory: M,
    ) -> Result<Self, Error> {
        let n = memory.parameters();
        let mut given = memory.square();
        for (k, x) in given.as_mut().iter_mut().enumerate() {
            *x = M::Real::from_f64(elements(k));
            check_size(name, k, *x)?;
        }
        check_symmetric(name, given.as_ref(), n)?;
        let (mut rest, mut rows) = (given.clone(), memory.square());
        let rank = pivoted_cholesky(name, rest.as_mut(), rows.as_mut(), n)?;
        Ok(Self { memory, form: Form::Dense, given, rank, rows })
    }

    /// c, if the matrix was given as the number c.
    #[inline]
    pub fn scalar_given(&self) -> Option<M::Real> {
        (self.form == Form::Scalar).then(|| self.given.as_ref()[0])
    }

    /// The sizes it was made for.
    pub fn memory(&self) -> M {
        self.memory
    }

    /// The rows r_i.
    #[inline(always)]
    pub fn rows(&self) -> impl Iterator<Item = &[M::Real]> {
        let n = self.memory.parameters();
        self.rows.as_ref()[..self.rank * n].chunks_exact(n)
    }

    /// Whether it was given as a number or as a diagonal.
    pub fn is_diagonal(&self) -> bool {
        self.form != Form::Dense
    }

    /// n
    pub fn parameters(&self) -> usize {
        self.memory.parameters()
    }

    /// The row r_i, i < rank.
    #[inline(always)]
    pub fn row(&self, i: usize) -> &[M::Real] {
        let n = self.memory.parameters();
        &self.rows.as_ref()[i * n..(i + 1) * n]
    }

    /// The rank of the matrix.
    pub fn rank(&self) -> usize {
        self.rank
    }

    /// The smallest and the largest eigenvalue of the matrix. O(n³) a sweep for a full one: the
    /// squared lengths of its rows, once rotations have made them orthogonal.
    pub fn extremes(&self) -> (M::Real, M::Real) {
        let n = self.memory.parameters();
        let mut rows = self.rows.clone();
        if self.form == Form::Dense {
            make_orthogonal(rows.as_mut(), self.memory.square().as_mut(), n);
        }
        let squares = rows.as_ref().chunks_exact(n).map(|row| dot(row, row));
        let (least, most) = squares.fold((M::Real::CEILING, M::Real::ZERO), |(least, most), x| {
            (least.min(x), most.max(x))
        });
        (if self.rank < n { M::Real::ZERO } else { least }, most)
    }

    /// A·x, written to `product`.
    pub fn multiply(&self, x: &[M::Real], product: &mut [M::Real]) {
        product.fill(M::Real::ZERO);
        for row in self.rows() {
            add_scaled(product, dot(row, x), row);
        }
    }

    /// The matrix's element at row `i`, column `j`, as it was given.
    pub fn element(&self, i: usize, j: usize) -> M::Real {
        let given = self.given.as_ref();
        match self.form {
            Form::Dense => given[i * self.memory.parameters() + j],
            _ if i == j => given[i],
            _ => M::Real::ZERO,
        }
    }

    /// The matrix as a covariance.
    ///
    /// # Errors
    /// [`Error::Indefinite`] names the matrix `name` unless it is positive definite, [`Error::Range`]
    /// where its trace is too large.
    pub fn factor(&self, name: &'static str) -> Result<Factor<M>, Error> {
        let n = self.memory.parameters();
        let mut factor = Factor::scalar(self.memory, M::Real::ONE)?;
        match self.form {
            Form::Dense => factor.replace(self.given.clone().as_mut(), name)?,
            Form::Scalar | Form::Diagonal => {
                factor.replace_diagonal(&self.given.as_ref()[..n], name)?;
            }
        }
        Ok(factor)
    }

    /// Names the matrix as it was given.
    pub fn describe(&self, name: &'static str, each: &mut dyn FnMut(&'static str, Value<'_>)) {
        let n = self.memory.parameters();
        let elements = |k: usize| self.given.as_ref()[k].to_f64();
        match self.form {
            Form::Scalar => each(name, Value::Real(elements(0))),
            Form::Diagonal => {
                each(name, Value::Matrix { rows: 1, columns: n, elements: &elements });
            }
            Form::Dense => each(name, Value::Matrix { rows: n, columns: n, elements: &elements }),
        }
    }
}

/// Refuses an element that is so large that an update could overflow.
fn check_size<T: Real>(name: &'static str, index: usize, element: T) -> Result<(), Error> {
    if element.abs() <= T::CEILING {
        return Ok(());
    }
    let (value, allowed) = (element.to_f64(), "numbers within the range of the number type");
    Err(Error::Value { parameter: name, index: Some(index), value, allowed })
}

/// Writes the root of the n x n matrix `rest` to `rows` and returns its rank; uses up `rest`.
fn pivoted_cholesky<T: Kernels>(
    name: &'static str,
    rest: &mut [T],
    rows: &mut [T],
    n: usize,
) -> Result<usize, Error> {
    let largest = |rest: &[T]| {
        (0..n).fold(0, |best, i| if rest[i * n + i] > rest[best * n + best] { i } else { best })
    };
    let first = largest(rest);
    let noise = rest[first * n + first].abs() * T::EPSILON * T::from_f64(16.0 * n as f64);
    let mut rank = 0;
    while rank < n {
        let i = largest(rest);
        let pivot = rest[i * n + i];
        if !(pivot > noise) {
            break;
        }
        let row = &mut rows[rank * n..(rank + 1) * n];
        let scale = T::ONE / pivot.sqrt();
        for (r, &x) in row.iter_mut().zip(&rest[i * n..(i + 1) * n]) {
            *r = x * scale;
        }
        for (j, line) in rest.chunks_exact_mut(n).enumerate() {
            add_scaled(line, -row[j], row);
        }
        rank += 1;
    }
    // what is left of a positive semidefinite matrix is rounding; else it was not one
    match rest.iter().find(|x| x.abs() > noise * T::from_f64(4.0)) {
        None => Ok(rank),
        Some(_) => Err(Error::Indefinite {
            parameter: name,
            pivot: (0..n).map(|i| rest[i * n + i].to_f64()).fold(0.0, f64::min),
            allowed: "positive semidefinite",
        }),
    }
}
