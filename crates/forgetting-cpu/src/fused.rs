//! Numbers whose multiply-add rounds once.

use crate::level::Machine;
use bytemuck::TransparentWrapper;
use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};
use forgetting_kernels::compile_kernels;
use forgetting_kernels::number::vector::Lanes;
use forgetting_kernels::number::{copy_some, Real};

/// An `f64` or `f32` whose `mul_add` is fused: it rounds once.
///
/// For machines with fused multiply-add ([`level`](crate::level) says so); on others the loops
/// panic, unless the feature `portable` is on.
///
/// ```
/// use bytemuck::TransparentWrapper;
/// use forgetting::{Constant, Equal, Estimator, Exponential, Fixed, Prior};
/// use forgetting_cpu::Fused;
///
/// let memory = Fixed::<Fused<f64>, 2>::new();
/// let prior = Prior::scalar(memory, Fused(100.0))?;
/// let mut estimator =
///     Estimator::new(Exponential::new(), Constant::new(Fused(0.98))?, Equal::new(), prior);
/// let (phi, y) = ([1.0, 2.0], [3.0]);
/// estimator.update(Fused::wrap_slice(&phi), Fused::wrap_slice(&y))?;
/// # Ok::<(), forgetting::Error>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd, TransparentWrapper)]
#[repr(transparent)]
pub struct Fused<F>(pub F);

macro_rules! operator {
    ($($Trait:ident $method:ident, $TraitAssign:ident $method_assign:ident;)*) => {$(
        impl<F: $Trait<Output = F>> $Trait for Fused<F> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(self.0.$method(other.0))
            }
        }
        impl<F: $TraitAssign> $TraitAssign for Fused<F> {
            #[inline(always)]
            fn $method_assign(&mut self, other: Self) {
                self.0.$method_assign(other.0);
            }
        }
    )*};
}

operator! {
    Add add, AddAssign add_assign;
    Sub sub, SubAssign sub_assign;
    Mul mul, MulAssign mul_assign;
    Div div, DivAssign div_assign;
}

impl<F: Neg<Output = F>> Neg for Fused<F> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

macro_rules! fused {
    ($float:ident, $lanes:literal) => {
        impl Real for Fused<$float> {
            type Chunk = [Self; $lanes];
            type Lanes = Lanes<Self, $lanes>;
            const ZERO: Self = Self(<$float as Real>::ZERO);
            const ONE: Self = Self(<$float as Real>::ONE);
            const EPSILON: Self = Self(<$float as Real>::EPSILON);
            const CEILING: Self = Self(<$float as Real>::CEILING);
            const FLOOR: Self = Self(<$float as Real>::FLOOR);
            const ROWS: usize = $lanes;
            const BYTES: usize = <$float as Real>::BYTES;

            #[inline(always)]
            fn chunk(numbers: &[Self]) -> Self::Chunk {
                let mut chunk = [Self::ZERO; $lanes];
                copy_some(&mut chunk, numbers);
                chunk
            }
            #[inline(always)]
            fn chunks(numbers: &[Self]) -> (&[Self::Chunk], &[Self]) {
                numbers.as_chunks()
            }
            #[inline(always)]
            fn chunks_mut(numbers: &mut [Self]) -> (&mut [Self::Chunk], &mut [Self]) {
                numbers.as_chunks_mut()
            }
            #[inline(always)]
            fn from_f64(x: f64) -> Self {
                Self(<$float as Real>::from_f64(x))
            }
            #[inline(always)]
            fn to_f64(self) -> f64 {
                self.0.to_f64()
            }
            #[inline(always)]
            fn mul_add(self, factor: Self, term: Self) -> Self {
                Self($float::mul_add(self.0, factor.0, term.0))
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                Self(self.0.sqrt())
            }
            #[inline(always)]
            fn ln(self) -> Self {
                Self(Real::ln(self.0))
            }
            #[inline(always)]
            fn exp(self) -> Self {
                Self(Real::exp(self.0))
            }
            #[inline(always)]
            fn abs(self) -> Self {
                Self(self.0.abs())
            }
            #[inline(always)]
            fn is_finite(self) -> bool {
                self.0.is_finite()
            }
        }
    };
}

fused!(f64, 8);
fused!(f32, 16);

compile_kernels!(Fused<f64>, Machine);
compile_kernels!(Fused<f32>, Machine);
