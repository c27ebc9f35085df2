//! Sums across the numbers of vectors.
//!
//! As everywhere in this folder: only what has checked the machine names these types, so that
//! every intrinsic here has its instructions.

use super::single::Single;
use super::{at_mut, Pair, Wide};
use crate::fused::Fused;
use core::arch::x86_64::*;
use forgetting_kernels::number::sums::Sums;

impl Sums<Fused<f64>> for Pair<__m256d> {
    type Four = __m256d;
    type Eight = Self;

    #[inline(always)]
    fn sum(self) -> Fused<f64> {
        unsafe {
            let four = _mm256_add_pd(self.0, self.1);
            let (low, high) = (_mm256_castpd256_pd128(four), _mm256_extractf128_pd::<1>(four));
            // (four[0] + four[1]) and (four[2] + four[3])
            let pairs = _mm_hadd_pd(low, high);
            Fused(_mm_cvtsd_f64(_mm_add_sd(pairs, _mm_unpackhi_pd(pairs, pairs))))
        }
    }
    #[inline(always)]
    fn four_sums([a, b, c, d]: [Self; 4]) -> __m256d {
        unsafe {
            let (a, b) = (_mm256_add_pd(a.0, a.1), _mm256_add_pd(b.0, b.1));
            let (c, d) = (_mm256_add_pd(c.0, c.1), _mm256_add_pd(d.0, d.1));
            let (ab, cd) = (_mm256_hadd_pd(a, b), _mm256_hadd_pd(c, d));
            let low = _mm256_permute2f128_pd::<0x20>(ab, cd);
            let high = _mm256_permute2f128_pd::<0x31>(ab, cd);
            _mm256_add_pd(low, high)
        }
    }
    #[inline(always)]
    fn numbers(four: __m256d) -> [Fused<f64>; 4] {
        let mut numbers = [Fused(0.0); 4];
        unsafe { _mm256_storeu_pd(at_mut!(numbers, f64, 0), four) };
        numbers
    }
    #[inline(always)]
    fn join(first: __m256d, second: __m256d) -> Self {
        Self(first, second)
    }
}

impl Sums<Fused<f32>> for Pair<__m256> {
    type Four = __m128;
    type Eight = Single<__m256>;

    #[inline(always)]
    fn sum(self) -> Fused<f32> {
        unsafe {
            let eight = _mm256_add_ps(self.0, self.1);
            let four = _mm_add_ps(_mm256_castps256_ps128(eight), _mm256_extractf128_ps::<1>(eight));
            // (four[0] + four[1]) and (four[2] + four[3])
            let pairs = _mm_hadd_ps(four, four);
            Fused(_mm_cvtss_f32(_mm_add_ss(pairs, _mm_movehdup_ps(pairs))))
        }
    }
    #[inline(always)]
    fn four_sums([a, b, c, d]: [Self; 4]) -> __m128 {
        unsafe {
            let (a, b) = (_mm256_add_ps(a.0, a.1), _mm256_add_ps(b.0, b.1));
            let (c, d) = (_mm256_add_ps(c.0, c.1), _mm256_add_ps(d.0, d.1));
            // four lanes of a or c in the lower half, of b or d in the upper one
            let ab = _mm256_add_ps(
                _mm256_permute2f128_ps::<0x20>(a, b),
                _mm256_permute2f128_ps::<0x31>(a, b),
            );
            let cd = _mm256_add_ps(
                _mm256_permute2f128_ps::<0x20>(c, d),
                _mm256_permute2f128_ps::<0x31>(c, d),
            );
            let pairs = _mm256_hadd_ps(ab, cd);
            // a c a c in the lower half, b d b d in the upper one
            let all = _mm256_hadd_ps(pairs, pairs);
            let (ac, bd) = (_mm256_castps256_ps128(all), _mm256_extractf128_ps::<1>(all));
            _mm_unpacklo_ps(ac, bd)
        }
    }
    #[inline(always)]
    fn numbers(four: __m128) -> [Fused<f32>; 4] {
        let mut numbers = [Fused(0.0); 4];
        unsafe { _mm_storeu_ps(at_mut!(numbers, f32, 0), four) };
        numbers
    }
    #[inline(always)]
    fn join(first: __m128, second: __m128) -> Single<__m256> {
        Single(unsafe { _mm256_set_m128(second, first) })
    }
}

impl Sums<Fused<f64>> for Wide<__m512d> {
    type Four = __m256d;
    type Eight = Self;

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
    type Eight = Single<__m256>;

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
