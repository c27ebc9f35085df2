//! How large the ellipsoid that θ is known to lie in becomes by a sample of some weight μ, and the
//! weight that makes it smallest; for [`data_dependent`](super::data_dependent).

use crate::covariance::Factor;
use crate::memory::Memory;
use crate::sample::Sample;
use forgetting_kernels::kernel::functions::dot;
use forgetting_kernels::Kernels;

/// The eigenvalues w_i of φ̄ P φ̄ᵀ and the squared errors c_i in its eigenvectors.
pub struct Terms<'a, T> {
    /// w_i at the positions i·stride
    spread: (&'a [T], usize),
    /// c_i at the positions i·stride
    squares: (&'a [T], usize),
    rows: usize,
}

impl<'a, T: Kernels> Terms<'a, T> {
    /// Computed in `spread` (p x n) and `squares` (p x m).
    #[inline]
    pub fn of<M: Memory<Real = T>>(
        factor: &Factor<M>,
        sample: &Sample<'_, M>,
        spread: &'a mut [T],
        squares: &'a mut [T],
    ) -> Self {
        let (n, rows) = (factor.parameters(), sample.rows());
        let m = sample.error(0).len();
        squares.copy_from_slice(sample.errors());
        if rows == 1 {
            spread[0] = factor.leverage(sample.row(0));
        } else {
            spread.copy_from_slice(sample.regressors());
            spread.chunks_exact_mut(n).for_each(|row| factor.apply_root_transposed(row));
            Sample::new(factor.memory(), spread, squares).orthogonalize();
            spread.chunks_exact_mut(n).for_each(|row| row[0] = dot(row, row));
        }
        let targets = T::from_f64(m as f64);
        squares.chunks_exact_mut(m).for_each(|errors| errors[0] = dot(errors, errors) / targets);
        Self { spread: (spread, n), squares: (squares, m), rows }
    }

    /// Σ_i f(c_i, w_i)
    pub fn sum(&self, f: impl Fn(T, T) -> T) -> T {
        let ((spread, n), (squares, m)) = (self.spread, self.squares);
        (0..self.rows).fold(T::ZERO, |sum, i| sum + f(squares[i * m], spread[i * n]))
    }

    /// ‖ē‖², the mean over the targets
    pub fn squared_error(&self) -> T {
        self.sum(|c, _| c)
    }

    /// The μ in [0, a] for which σ²(μ) is smallest, given `margin` = γ² − σ² and
    /// `excess` = ‖ē‖² − `margin` > 0.
    pub fn best_weight(&self, margin: T, excess: T, largest: T) -> T {
        if self.rows > 1 {
            return self.root_of_slope(margin, largest);
        }
        let (c, w) = (self.squares.0[0], self.spread.0[0]);
        let denominator = excess + margin * w;
        if !(denominator > T::ZERO) {
            return largest;
        }
        (excess / (denominator + denominator.sqrt() * w.sqrt() * c.sqrt())).min(largest)
    }

    /// By bisection, to the last bit of μ or nearly.
    fn root_of_slope(&self, margin: T, largest: T) -> T {
        const BISECTIONS: usize = 60;
        if !(self.slope(margin, largest) > T::ZERO) {
            return largest;
        }
        let (mut low, mut high) = (T::ZERO, largest);
        for _ in 0..BISECTIONS {
            let middle = (low + high) * T::from_f64(0.5);
            if self.slope(margin, middle) > T::ZERO {
                high = middle;
            } else {
                low = middle;
            }
        }
        low
    }

    /// dσ²(μ)/dμ, which does not decrease.
    fn slope(&self, margin: T, mu: T) -> T {
        let kept = T::ONE - mu;
        margin
            - self.sum(|c, w| {
                let all = kept + mu * w;
                let (old, new) = (kept / all, mu / all);
                c * (old * old - w * new * new)
            })
    }
}
