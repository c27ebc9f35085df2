//! A number for each of eight columns.
//!
//! As everywhere in this folder: only what has checked the machine names these types, so that
//! every intrinsic here has its instructions.

use super::single::Single;
use super::{at, at_mut, Pair, Wide};
use crate::fused::Fused;
use core::arch::x86_64::*;
use forgetting_kernels::number::block_vector::BlockVector;

impl BlockVector<Fused<f64>> for Pair<__m256d> {
    #[inline(always)]
    fn read(numbers: &[Fused<f64>; 8]) -> Self {
        unsafe {
            Self(_mm256_loadu_pd(at!(numbers, f64, 0)), _mm256_loadu_pd(at!(numbers, f64, 4)))
        }
    }
    #[inline(always)]
    fn write(self, numbers: &mut [Fused<f64>; 8]) {
        unsafe {
            _mm256_storeu_pd(at_mut!(numbers, f64, 0), self.0);
            _mm256_storeu_pd(at_mut!(numbers, f64, 4), self.1);
        }
    }
    #[inline(always)]
    fn running_sums(self) -> Self {
        let (low, high) = (Four(self.0).first_and_pair(), Four(self.1).first_and_pair());
        unsafe {
            // the sum of the low half, at the same time as what is within both
            let sum = _mm256_add_pd(low.0, _mm256_permute2f128_pd::<0x01>(low.0, low.0));
            let sum = _mm256_unpackhi_pd(sum, sum);
            Self(low.first_pair_added().0, _mm256_add_pd(sum, high.first_pair_added().0))
        }
    }
    #[inline(always)]
    fn before(self, first: Self) -> Self {
        unsafe {
            // what is two before the odd ones
            let low = _mm256_permute2f128_pd::<0x21>(first.0, self.0);
            let high = _mm256_permute2f128_pd::<0x21>(self.0, self.1);
            Self(_mm256_shuffle_pd::<0x5>(low, self.0), _mm256_shuffle_pd::<0x5>(high, self.1))
        }
    }
    #[inline(always)]
    fn last(self) -> Self {
        let last = unsafe { last(self.1) };
        Self(last, last)
    }
    #[inline(always)]
    fn remaining_sums(self) -> Self {
        let (low, high) = (Four(self.0).pair_and_last(), Four(self.1).pair_and_last());
        unsafe {
            let sum = _mm256_add_pd(high.0, _mm256_permute2f128_pd::<0x01>(high.0, high.0));
            let sum = _mm256_unpacklo_pd(sum, sum);
            Self(_mm256_add_pd(sum, low.last_pair_added().0), high.last_pair_added().0)
        }
    }
    #[inline(always)]
    fn after(self, last: Self) -> Self {
        unsafe {
            // what is two after the even ones
            let low = _mm256_permute2f128_pd::<0x21>(self.0, self.1);
            let high = _mm256_permute2f128_pd::<0x21>(self.1, last.0);
            Self(_mm256_shuffle_pd::<0x5>(self.0, low), _mm256_shuffle_pd::<0x5>(self.1, high))
        }
    }
    #[inline(always)]
    fn first(self) -> Self {
        let first = unsafe { _mm256_broadcastsd_pd(_mm256_castpd256_pd128(self.0)) };
        Self(first, first)
    }
}

/// Half of eight numbers.
// methods, not closures: those would be functions of their own, without the instructions
#[derive(Clone, Copy)]
struct Four(__m256d);

impl Four {
    /// a, a + b, c, c + d
    #[inline(always)]
    fn first_and_pair(self) -> Self {
        let x = self.0;
        Self(unsafe { _mm256_add_pd(x, _mm256_unpacklo_pd(_mm256_setzero_pd(), x)) })
    }
    /// The second of them added to the last two.
    #[inline(always)]
    fn first_pair_added(self) -> Self {
        unsafe {
            let first = _mm256_permute2f128_pd::<0x08>(self.0, self.0);
            Self(_mm256_add_pd(self.0, _mm256_unpackhi_pd(first, first)))
        }
    }
    /// a + b, b, c + d, d
    #[inline(always)]
    fn pair_and_last(self) -> Self {
        let x = self.0;
        Self(unsafe { _mm256_add_pd(x, _mm256_unpackhi_pd(x, _mm256_setzero_pd())) })
    }
    /// The third of them added to the first two.
    #[inline(always)]
    fn last_pair_added(self) -> Self {
        unsafe {
            let last = _mm256_permute2f128_pd::<0x81>(self.0, self.0);
            Self(_mm256_add_pd(self.0, _mm256_unpacklo_pd(last, last)))
        }
    }
}

/// The last number, four times.
///
/// # Safety
/// The machine has AVX.
#[inline(always)]
unsafe fn last(x: __m256d) -> __m256d {
    // SAFETY: the instructions by the caller's promise
    unsafe {
        let high = _mm256_permute2f128_pd::<0x11>(x, x);
        _mm256_unpackhi_pd(high, high)
    }
}

impl BlockVector<Fused<f64>> for Wide<__m512d> {
    #[inline(always)]
    fn read(numbers: &[Fused<f64>; 8]) -> Self {
        Self(unsafe { _mm512_loadu_pd(at!(numbers, f64, 0)) })
    }
    #[inline(always)]
    fn write(self, numbers: &mut [Fused<f64>; 8]) {
        unsafe { _mm512_storeu_pd(at_mut!(numbers, f64, 0), self.0) }
    }
    #[inline(always)]
    fn running_sums(self) -> Self {
        unsafe {
            let x = self.0;
            let pairs = _mm512_add_pd(x, _mm512_unpacklo_pd(_mm512_setzero_pd(), x));
            let first = _mm512_maskz_permutex_pd::<0x55>(0b1100_1100, pairs);
            let halves = _mm512_add_pd(pairs, first);
            let last = _mm512_maskz_permutexvar_pd(0b1111_0000, _mm512_set1_epi64(3), halves);
            Self(_mm512_add_pd(last, halves))
        }
    }
    #[inline(always)]
    fn before(self, first: Self) -> Self {
        unsafe {
            let (first, x) = (_mm512_castpd_si512(first.0), _mm512_castpd_si512(self.0));
            Self(_mm512_castsi512_pd(_mm512_alignr_epi64::<7>(x, first)))
        }
    }
    #[inline(always)]
    fn last(self) -> Self {
        Self(unsafe { _mm512_permutexvar_pd(_mm512_set1_epi64(7), self.0) })
    }
    #[inline(always)]
    fn remaining_sums(self) -> Self {
        unsafe {
            let x = self.0;
            let pairs = _mm512_add_pd(x, _mm512_unpackhi_pd(x, _mm512_setzero_pd()));
            let last = _mm512_maskz_permutex_pd::<0xAA>(0b0011_0011, pairs);
            let halves = _mm512_add_pd(pairs, last);
            let first = _mm512_maskz_permutexvar_pd(0b0000_1111, _mm512_set1_epi64(4), halves);
            Self(_mm512_add_pd(first, halves))
        }
    }
    #[inline(always)]
    fn after(self, last: Self) -> Self {
        unsafe {
            let (x, last) = (_mm512_castpd_si512(self.0), _mm512_castpd_si512(last.0));
            Self(_mm512_castsi512_pd(_mm512_alignr_epi64::<1>(last, x)))
        }
    }
    #[inline(always)]
    fn first(self) -> Self {
        Self(unsafe { _mm512_broadcastsd_pd(_mm512_castpd512_pd128(self.0)) })
    }
}

impl BlockVector<Fused<f32>> for Single<__m256> {
    #[inline(always)]
    fn read(numbers: &[Fused<f32>; 8]) -> Self {
        Self(unsafe { _mm256_loadu_ps(at!(numbers, f32, 0)) })
    }
    #[inline(always)]
    fn write(self, numbers: &mut [Fused<f32>; 8]) {
        unsafe { _mm256_storeu_ps(at_mut!(numbers, f32, 0), self.0) }
    }
    #[inline(always)]
    fn running_sums(self) -> Self {
        unsafe {
            let (x, zero) = (self.0, _mm256_setzero_ps());
            let before = _mm256_blend_ps::<0xAA>(zero, _mm256_moveldup_ps(x));
            let pairs = _mm256_add_ps(x, before);
            let first = _mm256_blend_ps::<0xCC>(zero, _mm256_permute_ps::<0x55>(pairs));
            let halves = _mm256_add_ps(pairs, first);
            let low = _mm256_permute2f128_ps::<0x08>(halves, halves);
            Self(_mm256_add_ps(_mm256_permute_ps::<0xFF>(low), halves))
        }
    }
    #[inline(always)]
    fn before(self, first: Self) -> Self {
        unsafe {
            let order = _mm256_setr_epi32(0, 0, 1, 2, 3, 4, 5, 6);
            let x = _mm256_permutevar8x32_ps(self.0, order);
            Self(_mm256_blend_ps::<0x01>(x, first.0))
        }
    }
    #[inline(always)]
    fn last(self) -> Self {
        Self(unsafe { _mm256_permutevar8x32_ps(self.0, _mm256_set1_epi32(7)) })
    }
    #[inline(always)]
    fn remaining_sums(self) -> Self {
        unsafe {
            let (x, zero) = (self.0, _mm256_setzero_ps());
            let after = _mm256_blend_ps::<0x55>(zero, _mm256_movehdup_ps(x));
            let pairs = _mm256_add_ps(x, after);
            let last = _mm256_blend_ps::<0x33>(zero, _mm256_permute_ps::<0xAA>(pairs));
            let halves = _mm256_add_ps(pairs, last);
            let high = _mm256_permute2f128_ps::<0x81>(halves, halves);
            Self(_mm256_add_ps(_mm256_permute_ps::<0x00>(high), halves))
        }
    }
    #[inline(always)]
    fn after(self, last: Self) -> Self {
        unsafe {
            let order = _mm256_setr_epi32(1, 2, 3, 4, 5, 6, 7, 7);
            let x = _mm256_permutevar8x32_ps(self.0, order);
            Self(_mm256_blend_ps::<0x80>(x, last.0))
        }
    }
    #[inline(always)]
    fn first(self) -> Self {
        Self(unsafe { _mm256_broadcastss_ps(_mm256_castps256_ps128(self.0)) })
    }
}
