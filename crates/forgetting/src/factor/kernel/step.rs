//! A whole sample of one row and one target, when nothing happens between its arrival and its use.

use super::bierman::{blocks, small, Bierman};
use super::block::with_width;
use super::layout::BLOCK;
use super::long::products;
use crate::factor::Measured;
use crate::vector::Vector;
use crate::{Kernel, Real};

/// e = y − φθ, then [`Bierman`] with it: unless it is `refused` already, or e or φ is too large or
/// not a number.
pub struct Step<'a, T> {
    pub columns: &'a mut [T],
    pub diagonal: &'a mut [T],
    pub growth: T,
    pub phi: &'a [T],
    pub y: T,
    pub gain: &'a mut [T],
    pub theta: &'a mut [T],
    pub refused: bool,
}

/// What came of it.
#[derive(Clone, Copy, Debug)]
pub struct Stepped<T> {
    /// e
    pub error: T,
    /// ‖φ‖²
    pub squares: T,
    /// what the measurement brought; None if the sample was refused
    pub measured: Option<Measured<T>>,
}

impl<T: Real> Kernel<T> for Step<'_, T> {
    type Output = Stepped<T>;

    #[inline(always)]
    fn size(&self) -> usize {
        self.phi.len()
    }

    #[inline(always)]
    fn run<V: Vector<T>, const GROUP: usize>(self) -> Stepped<T> {
        let n = self.phi.len();
        if n <= BLOCK {
            return with_width!(n, step::<T>(self));
        }
        let (product, squares) = products::<T, V>(self.phi, self.theta);
        let error = self.y - product;
        let measured =
            self.accepts(error, squares).then(|| blocks::<T, V, GROUP>(self.task(&[error])));
        Stepped { error, squares, measured }
    }
}

impl<'a, T: Real> Step<'a, T> {
    #[inline(always)]
    fn accepts(&self, error: T, squares: T) -> bool {
        // false for NaN
        !self.refused & (error.abs() <= T::CEILING) & (squares <= T::CEILING)
    }

    #[inline(always)]
    fn task<'b>(self, errors: &'b [T]) -> Bierman<'b, T>
    where
        'a: 'b,
    {
        let Self { columns, diagonal, growth, phi: f, gain, theta, .. } = self;
        Bierman { columns, diagonal, growth, f, gain, theta, errors }
    }
}

/// The same for N parameters, at most eight.
#[inline(always)]
fn step<T: Real, const N: usize>(task: Step<'_, T>) -> Stepped<T> {
    let (mut product, mut squares) = (T::ZERO, T::ZERO);
    if let (Some(phi), Some(theta)) = (task.phi.first_chunk::<N>(), task.theta.first_chunk::<N>()) {
        for i in 0..N {
            product = phi[i].mul_add(theta[i], product);
            squares = phi[i].mul_add(phi[i], squares);
        }
    }
    let error = task.y - product;
    let measured =
        if task.accepts(error, squares) { Some(small::<T, N>(task.task(&[error]))) } else { None };
    Stepped { error, squares, measured }
}
