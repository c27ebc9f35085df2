//! Sums across two registers of 256 bits.
//!
//! As everywhere in this folder: only what has checked the machine names these types, so that
//! every intrinsic here has its instructions.

use crate::fused::Fused;
use crate::x86::single::Single;
use crate::x86::{at_mut, Pair};
use core::arch::x86_64::*;
use forgetting_kernels::number::sums::Sums;

impl Sums<Fused<f64>> for Pair<__m256d> {
    type Four = __m256d;
    type BlockVector = Self;

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
    type BlockVector = Single<__m256>;

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
