//! The arithmetic of a stream in each lane.
//!
//! As everywhere in this folder: only what has checked the machine names these types, so that
//! every intrinsic here has its instructions.

use super::{Pair, Wide};
use crate::fused::Fused;
use core::arch::x86_64::*;
use core::ops::{Add, Div, Mul, Neg, Sub};
use forgetting_kernels::number::lane::Lane;

/// An operator, for a pair of registers and for a wide one.
macro_rules! operator {
    ($($Trait:ident $method:ident: $pair_f64:ident $pair_f32:ident $wide_f64:ident $wide_f32:ident;)*) => {$(
        operator!($Trait $method: __m256d $pair_f64, __m256 $pair_f32;
            __m512d $wide_f64, __m512 $wide_f32);
    )*};
    ($Trait:ident $method:ident: $($pair:ident $of_pair:ident),*; $($wide:ident $of_wide:ident),*) => {
        $(impl $Trait for Pair<$pair> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(unsafe { $of_pair(self.0, other.0) }, unsafe { $of_pair(self.1, other.1) })
            }
        })*
        $(impl $Trait for Wide<$wide> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(unsafe { $of_wide(self.0, other.0) })
            }
        })*
    };
}
operator! {
    Add add: _mm256_add_pd _mm256_add_ps _mm512_add_pd _mm512_add_ps;
    Sub sub: _mm256_sub_pd _mm256_sub_ps _mm512_sub_pd _mm512_sub_ps;
    Mul mul: _mm256_mul_pd _mm256_mul_ps _mm512_mul_pd _mm512_mul_ps;
    Div div: _mm256_div_pd _mm256_div_ps _mm512_div_pd _mm512_div_ps;
}

/// The rest of the arithmetic of a pair of registers.
macro_rules! pair {
    ($float:ident, $register:ty: $set1:ident $fmadd:ident $max:ident $min:ident $sqrt:ident $cmp:ident
     $and:ident $andnot:ident $xor:ident $blendv:ident $movemask:ident $full:literal) => {
        impl Neg for Pair<$register> {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                let sign = unsafe { $set1(-0.0) };
                Self(unsafe { $xor(self.0, sign) }, unsafe { $xor(self.1, sign) })
            }
        }

        impl Lane<Fused<$float>> for Pair<$register> {
            type Mask = Self;

            #[inline(always)]
            fn splat(x: Fused<$float>) -> Self {
                let x = unsafe { $set1(x.0) };
                Self(x, x)
            }
            #[inline(always)]
            fn mul_add(self, factor: Self, term: Self) -> Self {
                Self(unsafe { $fmadd(self.0, factor.0, term.0) }, unsafe {
                    $fmadd(self.1, factor.1, term.1)
                })
            }
            #[inline(always)]
            fn max(self, other: Self) -> Self {
                Self(unsafe { $max(self.0, other.0) }, unsafe { $max(self.1, other.1) })
            }
            #[inline(always)]
            fn min(self, other: Self) -> Self {
                Self(unsafe { $min(self.0, other.0) }, unsafe { $min(self.1, other.1) })
            }
            #[inline(always)]
            fn abs(self) -> Self {
                let sign = unsafe { $set1(-0.0) };
                Self(unsafe { $andnot(sign, self.0) }, unsafe { $andnot(sign, self.1) })
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                Self(unsafe { $sqrt(self.0) }, unsafe { $sqrt(self.1) })
            }
            #[inline(always)]
            fn at_most(self, limit: Self) -> Self {
                Self(unsafe { $cmp::<_CMP_LE_OQ>(self.0, limit.0) }, unsafe {
                    $cmp::<_CMP_LE_OQ>(self.1, limit.1)
                })
            }
            #[inline(always)]
            fn less_than(self, limit: Self) -> Self {
                Self(unsafe { $cmp::<_CMP_LT_OQ>(self.0, limit.0) }, unsafe {
                    $cmp::<_CMP_LT_OQ>(self.1, limit.1)
                })
            }
            #[inline(always)]
            fn both(a: Self, b: Self) -> Self {
                Self(unsafe { $and(a.0, b.0) }, unsafe { $and(a.1, b.1) })
            }
            #[inline(always)]
            fn all(mask: Self) -> bool {
                unsafe { $movemask($and(mask.0, mask.1)) == $full }
            }
            #[inline(always)]
            fn select(mask: Self, yes: Self, no: Self) -> Self {
                Self(unsafe { $blendv(no.0, yes.0, mask.0) }, unsafe {
                    $blendv(no.1, yes.1, mask.1)
                })
            }
        }
    };
}

pair!(f64, __m256d: _mm256_set1_pd _mm256_fmadd_pd _mm256_max_pd _mm256_min_pd _mm256_sqrt_pd _mm256_cmp_pd
    _mm256_and_pd _mm256_andnot_pd _mm256_xor_pd _mm256_blendv_pd
    _mm256_movemask_pd 0xF);
pair!(f32, __m256: _mm256_set1_ps _mm256_fmadd_ps _mm256_max_ps _mm256_min_ps _mm256_sqrt_ps _mm256_cmp_ps
    _mm256_and_ps _mm256_andnot_ps _mm256_xor_ps _mm256_blendv_ps
    _mm256_movemask_ps 0xFF);

/// The rest of the arithmetic of a wide register.
macro_rules! wide {
    ($float:ident, $register:ty, $mask:ty: $set1:ident $fmadd:ident $max:ident $min:ident $sqrt:ident
     $abs:ident $cmp:ident $xor:ident $blend:ident) => {
        impl Neg for Wide<$register> {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                Self(unsafe { $xor(self.0, $set1(-0.0)) })
            }
        }

        impl Lane<Fused<$float>> for Wide<$register> {
            type Mask = $mask;

            #[inline(always)]
            fn splat(x: Fused<$float>) -> Self {
                Self(unsafe { $set1(x.0) })
            }
            #[inline(always)]
            fn mul_add(self, factor: Self, term: Self) -> Self {
                Self(unsafe { $fmadd(self.0, factor.0, term.0) })
            }
            #[inline(always)]
            fn max(self, other: Self) -> Self {
                Self(unsafe { $max(self.0, other.0) })
            }
            #[inline(always)]
            fn min(self, other: Self) -> Self {
                Self(unsafe { $min(self.0, other.0) })
            }
            #[inline(always)]
            fn abs(self) -> Self {
                Self(unsafe { $abs(self.0) })
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                Self(unsafe { $sqrt(self.0) })
            }
            #[inline(always)]
            fn at_most(self, limit: Self) -> $mask {
                unsafe { $cmp::<_CMP_LE_OQ>(self.0, limit.0) }
            }
            #[inline(always)]
            fn less_than(self, limit: Self) -> $mask {
                unsafe { $cmp::<_CMP_LT_OQ>(self.0, limit.0) }
            }
            #[inline(always)]
            fn both(a: $mask, b: $mask) -> $mask {
                a & b
            }
            #[inline(always)]
            fn all(mask: $mask) -> bool {
                mask == <$mask>::MAX
            }
            #[inline(always)]
            fn select(mask: $mask, yes: Self, no: Self) -> Self {
                Self(unsafe { $blend(mask, no.0, yes.0) })
            }
        }
    };
}

wide!(f64, __m512d, __mmask8: _mm512_set1_pd _mm512_fmadd_pd _mm512_max_pd _mm512_min_pd _mm512_sqrt_pd
    _mm512_abs_pd _mm512_cmp_pd_mask _mm512_xor_pd _mm512_mask_blend_pd);
wide!(f32, __m512, __mmask16: _mm512_set1_ps _mm512_fmadd_ps _mm512_max_ps _mm512_min_ps _mm512_sqrt_ps
    _mm512_abs_ps _mm512_cmp_ps_mask _mm512_xor_ps _mm512_mask_blend_ps);
