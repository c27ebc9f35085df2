//! Numbers whose multiply-add rounds once.

use crate::level::Machine;

/// Defines a type of numbers whose multiply-add rounds once, and compiles its kernels.
#[doc(hidden)]
#[macro_export]
macro_rules! fused_numbers {
    ($(#[$doc:meta])* pub $Fused:ident, with $Dispatch:ty) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
        #[repr(transparent)]
        pub struct $Fused<F>(pub F);

        // SAFETY: it is transparent
        unsafe impl<F> $crate::TransparentWrapper<F> for $Fused<F> {}

        $crate::fused_operators! { $Fused:
            Add add, AddAssign add_assign;
            Sub sub, SubAssign sub_assign;
            Mul mul, MulAssign mul_assign;
            Div div, DivAssign div_assign;
        }

        impl<F: core::ops::Neg<Output = F>> core::ops::Neg for $Fused<F> {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                Self(-self.0)
            }
        }

        $crate::fused_real! { $Fused<f64>, 8 }
        $crate::fused_real! { $Fused<f32>, 16 }
        $crate::compile_kernels!($Fused<f64>, $Dispatch);
        $crate::compile_kernels!($Fused<f32>, $Dispatch);
    };
}

/// The arithmetic of the numbers inside.
#[doc(hidden)]
#[macro_export]
macro_rules! fused_operators {
    ($Fused:ident: $($Trait:ident $method:ident, $TraitAssign:ident $method_assign:ident;)*) => {$(
        impl<F: core::ops::$Trait<Output = F>> core::ops::$Trait for $Fused<F> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(self.0.$method(other.0))
            }
        }
        impl<F: core::ops::$TraitAssign> core::ops::$TraitAssign for $Fused<F> {
            #[inline(always)]
            fn $method_assign(&mut self, other: Self) {
                self.0.$method_assign(other.0);
            }
        }
    )*};
}

/// A real number with that multiply-add.
#[doc(hidden)]
#[macro_export]
macro_rules! fused_real {
    ($Fused:ident<$float:ident>, $lanes:literal) => {
        impl $crate::Real for $Fused<$float> {
            type Chunk = [Self; $lanes];
            type Lanes = $crate::Lanes<Self, $lanes>;
            const ZERO: Self = Self(<$float as $crate::Real>::ZERO);
            const ONE: Self = Self(<$float as $crate::Real>::ONE);
            const EPSILON: Self = Self(<$float as $crate::Real>::EPSILON);
            const CEILING: Self = Self(<$float as $crate::Real>::CEILING);
            const FLOOR: Self = Self(<$float as $crate::Real>::FLOOR);
            const ROWS: usize = $lanes;
            const BYTES: usize = <$float as $crate::Real>::BYTES;

            #[inline(always)]
            fn chunk(numbers: &[Self]) -> Self::Chunk {
                let mut chunk = [Self::ZERO; $lanes];
                $crate::copy_some(&mut chunk, numbers);
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
                Self(<$float as $crate::Real>::from_f64(x))
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
                Self($crate::Real::ln(self.0))
            }
            #[inline(always)]
            fn exp(self) -> Self {
                Self($crate::Real::exp(self.0))
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

fused_numbers! {
    /// An `f64` or `f32` whose `mul_add` is fused: it rounds once.
    ///
    /// For machines with fused multiply-add ([`level`](crate::level) says so); on others the loops
    /// panic.
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
    pub Fused, with Machine
}
