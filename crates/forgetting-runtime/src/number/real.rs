//! How an interface's numbers become those that are computed with.

use super::array::{Array, Elements, Numbers};
#[cfg(not(target_arch = "wasm32"))]
use bytemuck::{TransparentWrapper, TransparentWrapperAlloc};
use forgetting::{Kernels, Real};
#[cfg(not(target_arch = "wasm32"))]
use forgetting_cpu::Fused;
use std::borrow::Cow;

/// A number type to compute with: one of [`NumberType`] in the arithmetic of a machine.
pub(crate) trait Number: Kernels {
    /// An interface's numbers as numbers of this type, converted only if they are of another.
    fn read(numbers: Numbers<'_>) -> Cow<'_, [Self]>;

    /// Numbers of this type as an interface's.
    fn elements(numbers: Vec<Self>) -> Elements;

    /// The same in this shape.
    fn array(numbers: Vec<Self>, shape: &[usize]) -> Array {
        Array { shape: shape.to_vec(), elements: Self::elements(numbers) }
    }
}

#[cold]
fn convert<T: Real, X: Real>(numbers: &[X]) -> Cow<'static, [T]> {
    numbers.iter().map(|x| T::from_f64(x.to_f64())).collect()
}

macro_rules! number {
    ($Type:ident, $float:ident; $Other:ident) => {
        impl Number for $float {
            #[inline(always)]
            fn read(numbers: Numbers<'_>) -> Cow<'_, [Self]> {
                match numbers {
                    Numbers::$Type(numbers) => Cow::Borrowed(numbers),
                    Numbers::$Other(numbers) => convert(numbers),
                }
            }

            fn elements(numbers: Vec<Self>) -> Elements {
                Elements::$Type(numbers)
            }
        }

        #[cfg(not(target_arch = "wasm32"))]
        impl Number for Fused<$float> {
            #[inline(always)]
            fn read(numbers: Numbers<'_>) -> Cow<'_, [Self]> {
                match numbers {
                    Numbers::$Type(numbers) => Cow::Borrowed(Self::wrap_slice(numbers)),
                    Numbers::$Other(numbers) => convert(numbers),
                }
            }

            fn elements(numbers: Vec<Self>) -> Elements {
                Elements::$Type(Self::peel_vec(numbers))
            }
        }
    };
}
number!(F64, f64; F32);
number!(F32, f32; F64);
