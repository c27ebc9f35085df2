//! One register: of a stream in each lane, or of the same number in all.
//!
//! As everywhere in this folder: only what has checked the machine names these types, so that
//! every intrinsic here has its instructions.

use super::{at, at_mut, columns, Wide};
use crate::fused::Fused;
use core::arch::x86_64::*;
use core::ops::{Add, Div, Mul, Neg, Sub};
use forgetting_kernels::number::lane::{Lane, One};
use forgetting_kernels::number::vector::StreamVector;

/// A register of 256 bits, with a stream in each lane; or of 128, with the same number in all: the
/// compiler would pair single numbers with their neighbours, which costs more steps than it saves
/// where each waits for the one before.
#[derive(Clone, Copy, Debug)]
pub struct Single<R>(pub(super) R);

macro_rules! operator {
    ($($Trait:ident $method:ident: $($register:ident $intrinsic:ident),*;)*) => {$($(
        impl $Trait for Single<$register> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(unsafe { $intrinsic(self.0, other.0) })
            }
        }
    )*)*};
}
operator! {
    Add add: __m128d _mm_add_pd, __m128 _mm_add_ps, __m256d _mm256_add_pd, __m256 _mm256_add_ps;
    Sub sub: __m128d _mm_sub_pd, __m128 _mm_sub_ps, __m256d _mm256_sub_pd, __m256 _mm256_sub_ps;
    Mul mul: __m128d _mm_mul_pd, __m128 _mm_mul_ps, __m256d _mm256_mul_pd, __m256 _mm256_mul_ps;
    Div div: __m128d _mm_div_pd, __m128 _mm_div_ps, __m256d _mm256_div_pd, __m256 _mm256_div_ps;
}

/// The rest of the arithmetic.
macro_rules! single {
    ($float:ident, $register:ty, $full:literal: $set1:ident $fmadd:ident $max:ident $min:ident $sqrt:ident
     $cmp:ident $and:ident $andnot:ident $xor:ident $blendv:ident $movemask:ident) => {
        impl Neg for Single<$register> {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                Self(unsafe { $xor(self.0, $set1(-0.0)) })
            }
        }

        impl Lane<Fused<$float>> for Single<$register> {
            type Mask = Self;

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
                Self(unsafe { $andnot($set1(-0.0), self.0) })
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                Self(unsafe { $sqrt(self.0) })
            }
            #[inline(always)]
            fn at_most(self, limit: Self) -> Self {
                Self(unsafe { $cmp::<_CMP_LE_OQ>(self.0, limit.0) })
            }
            #[inline(always)]
            fn less_than(self, limit: Self) -> Self {
                Self(unsafe { $cmp::<_CMP_LT_OQ>(self.0, limit.0) })
            }
            #[inline(always)]
            fn both(a: Self, b: Self) -> Self {
                Self(unsafe { $and(a.0, b.0) })
            }
            #[inline(always)]
            fn all(mask: Self) -> bool {
                unsafe { $movemask(mask.0) == $full }
            }
            #[inline(always)]
            fn select(mask: Self, yes: Self, no: Self) -> Self {
                Self(unsafe { $blendv(no.0, yes.0, mask.0) })
            }
        }
    };
}

single!(f64, __m128d, 0x3: _mm_set1_pd _mm_fmadd_pd _mm_max_pd _mm_min_pd _mm_sqrt_pd _mm_cmp_pd _mm_and_pd
    _mm_andnot_pd _mm_xor_pd _mm_blendv_pd _mm_movemask_pd);
single!(f32, __m128, 0xF: _mm_set1_ps _mm_fmadd_ps _mm_max_ps _mm_min_ps _mm_sqrt_ps _mm_cmp_ps _mm_and_ps
    _mm_andnot_ps _mm_xor_ps _mm_blendv_ps _mm_movemask_ps);
single!(f64, __m256d, 0xF: _mm256_set1_pd _mm256_fmadd_pd _mm256_max_pd _mm256_min_pd _mm256_sqrt_pd
    _mm256_cmp_pd _mm256_and_pd _mm256_andnot_pd _mm256_xor_pd _mm256_blendv_pd
    _mm256_movemask_pd);
single!(f32, __m256, 0xFF: _mm256_set1_ps _mm256_fmadd_ps _mm256_max_ps _mm256_min_ps _mm256_sqrt_ps
    _mm256_cmp_ps _mm256_and_ps _mm256_andnot_ps _mm256_xor_ps _mm256_blendv_ps
    _mm256_movemask_ps);

/// One number, out of a register.
macro_rules! one {
    ($float:ident, $register:ty: $get:ident) => {
        impl One<Fused<$float>> for Single<$register> {
            #[inline(always)]
            fn get(self) -> Fused<$float> {
                Fused(unsafe { $get(self.0) })
            }
        }
    };
}

one!(f64, __m128d: _mm_cvtsd_f64);
one!(f32, __m128: _mm_cvtss_f32);

/// Numbers of streams, in and out of a register.
macro_rules! stream_vector {
    ($Register:ident<$register:ty>, $float:ident, $count:literal: $load:ident $store:ident
     $(, $columns:ident)?) => {
        impl StreamVector<Fused<$float>> for $Register<$register> {
            const COUNT: usize = $count;

            #[inline(always)]
            fn read(numbers: &[Fused<$float>]) -> Self {
                let numbers = &numbers[..$count];
                // SAFETY: as many numbers as are read
                Self(unsafe { $load(at!(numbers, $float, 0)) })
            }
            #[inline(always)]
            fn write(self, numbers: &mut [Fused<$float>]) {
                let numbers = &mut numbers[..$count];
                // SAFETY: as many numbers as are written
                unsafe { $store(at_mut!(numbers, $float, 0), self.0) }
            }
            #[inline(always)]
            fn at(number: impl Fn(usize) -> Fused<$float>) -> Self {
                let mut numbers = [Fused(0.0); $count];
                for k in 0..$count {
                    numbers[k] = number(k);
                }
                Self::read(&numbers)
            }
            $(#[inline(always)]
            fn columns<const N: usize>(rows: &[[Fused<$float>; N]]) -> [Self; N] {
                match rows.first_chunk() {
                    Some(rows) => columns::$columns(rows),
                    None => unreachable!("there is a row for each lane"),
                }
            })?
            #[inline(always)]
            fn prefetch<L>(line: &L) {
                // SAFETY: an address is all that it takes
                unsafe { _mm_prefetch::<_MM_HINT_T0>(core::ptr::from_ref(line).cast()) }
            }
        }
    };
}

stream_vector!(Single<__m256d>, f64, 4: _mm256_loadu_pd _mm256_storeu_pd);
stream_vector!(Single<__m256>, f32, 8: _mm256_loadu_ps _mm256_storeu_ps);
stream_vector!(Wide<__m512d>, f64, 8: _mm512_loadu_pd _mm512_storeu_pd);
stream_vector!(Wide<__m512>, f32, 16: _mm512_loadu_ps _mm512_storeu_ps, of_sixteen);
