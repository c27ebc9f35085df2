//! Sums across a register of 512 bits.
//!
//! As everywhere in this folder: only what has checked the machine names these types, so that
//! every intrinsic here has its instructions.

use crate::fused::Fused;
use crate::x86::single::Single;
use crate::x86::{Pair, Wide};
use core::arch::x86_64::*;
use forgetting_kernels::number::sums::Sums;

impl Sums<Fused<f64>> for Wide<__m512d> {
    type Four = __m256d;
    type BlockVector = Self;

    #[inline(always)]
    fn sum(self) -> Fused<f64> {
        self.halves().sum()
    }
    #[inline(always)]
    fn four_sums([a, b, c, d]: [Self; 4]) -> __m256d {
        Pair::four_sums([a.halves(), b.halves(), c.halves(), d.halves()])
    }
    #[inline(always)]
    fn numbers(four: __m256d) -> [Fused<f64>; 4] {
        Pair::numbers(four)
    }
    #[inline(always)]
    fn join(first: __m256d, second: __m256d) -> Self {
        Self(unsafe { _mm512_insertf64x4::<1>(_mm512_castpd256_pd512(first), second) })
    }
    #[inline(always)]
    fn eight_sums([a, b, c, d, e, f, g, h]: [Self; 8]) -> Self {
        let abcd = Self::fours(a, c).pairs(Self::fours(b, d)).0;
        let efgh = Self::fours(e, g).pairs(Self::fours(f, h)).0;
        unsafe {
            let first = _mm512_shuffle_f64x2::<0x88>(abcd, efgh);
            Self(_mm512_add_pd(first, _mm512_shuffle_f64x2::<0xDD>(abcd, efgh)))
        }
    }
}

impl Sums<Fused<f32>> for Wide<__m512> {
    type Four = __m128;
    type BlockVector = Single<__m256>;

    #[inline(always)]
    fn sum(self) -> Fused<f32> {
        self.halves().sum()
    }
    #[inline(always)]
    fn four_sums([a, b, c, d]: [Self; 4]) -> __m128 {
        Pair::four_sums([a.halves(), b.halves(), c.halves(), d.halves()])
    }
    #[inline(always)]
    fn numbers(four: __m128) -> [Fused<f32>; 4] {
        Pair::numbers(four)
    }
    #[inline(always)]
    fn join(first: __m128, second: __m128) -> Single<__m256> {
        Pair::<__m256>::join(first, second)
    }
    #[inline(always)]
    fn eight_sums([a, b, c, d, e, f, g, h]: [Self; 8]) -> Single<__m256> {
        let aceg = Self::eights(a, c).fours(Self::eights(e, g)).0;
        let bdfh = Self::eights(b, d).fours(Self::eights(f, h)).0;
        unsafe {
            let first = _mm512_shuffle_ps::<0x88>(aceg, bdfh);
            // the sums of both pairs of a, of b, …
            let pairs = _mm512_add_ps(first, _mm512_shuffle_ps::<0xDD>(aceg, bdfh));
            let sums = _mm512_add_ps(pairs, _mm512_shuffle_ps::<0xB1>(pairs, pairs));
            let order = _mm512_setr_epi32(0, 2, 4, 6, 8, 10, 12, 14, 0, 0, 0, 0, 0, 0, 0, 0);
            Single(_mm512_castps512_ps256(_mm512_permutexvar_ps(order, sums)))
        }
    }
}

impl Wide<__m512d> {
    #[inline(always)]
    fn halves(self) -> Pair<__m256d> {
        Pair(unsafe { _mm512_castpd512_pd256(self.0) }, unsafe {
            _mm512_extractf64x4_pd::<1>(self.0)
        })
    }

    /// Halves added to halves: four numbers of `x`, then four of `y`.
    #[inline(always)]
    fn fours(x: Self, y: Self) -> Self {
        unsafe {
            let low = _mm512_shuffle_f64x2::<0x44>(x.0, y.0);
            Self(_mm512_add_pd(low, _mm512_shuffle_f64x2::<0xEE>(x.0, y.0)))
        }
    }

    /// The sums of neighbours, one of `self` and one of `other` in turn.
    #[inline(always)]
    fn pairs(self, other: Self) -> Self {
        unsafe {
            let first = _mm512_unpacklo_pd(self.0, other.0);
            Self(_mm512_add_pd(first, _mm512_unpackhi_pd(self.0, other.0)))
        }
    }
}

impl Wide<__m512> {
    #[inline(always)]
    fn halves(self) -> Pair<__m256> {
        Pair(unsafe { _mm512_castps512_ps256(self.0) }, unsafe {
            _mm512_extractf32x8_ps::<1>(self.0)
        })
    }

    /// Halves added to halves: eight numbers of `x`, then eight of `y`.
    #[inline(always)]
    fn eights(x: Self, y: Self) -> Self {
        unsafe {
            let low = _mm512_shuffle_f32x4::<0x44>(x.0, y.0);
            Self(_mm512_add_ps(low, _mm512_shuffle_f32x4::<0xEE>(x.0, y.0)))
        }
    }

    /// The quarters of both, each second one added to the one before it.
    #[inline(always)]
    fn fours(self, other: Self) -> Self {
        unsafe {
            let first = _mm512_shuffle_f32x4::<0x88>(self.0, other.0);
            Self(_mm512_add_ps(first, _mm512_shuffle_f32x4::<0xDD>(self.0, other.0)))
        }
    }
}
