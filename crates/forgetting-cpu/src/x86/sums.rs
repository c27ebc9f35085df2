//! Sums across the lanes: halves added to halves down to four, then pairs.
//!
//! As everywhere in this folder: only what has checked the machine names these types, so that
//! every intrinsic here has its instructions.

use super::{at_mut, Pair, Wide};
use crate::Fused;
use core::arch::x86_64::*;

impl Wide<__m512d> {
    #[inline(always)]
    pub fn halves(self) -> Pair<__m256d> {
        Pair(unsafe { _mm512_castpd512_pd256(self.0) }, unsafe {
            _mm512_extractf64x4_pd::<1>(self.0)
        })
    }
}

impl Wide<__m512> {
    #[inline(always)]
    pub fn halves(self) -> Pair<__m256> {
        Pair(unsafe { _mm512_castps512_ps256(self.0) }, unsafe {
            _mm512_extractf32x8_ps::<1>(self.0)
        })
    }
}

/// A vector whose lanes are added up.
pub trait Sum<F>: Copy {
    fn sum(self) -> F;
    /// The sums of four vectors: what `sum` does to each, side by side.
    fn four(vectors: &[Self; 4]) -> [F; 4];
}

/// The sum of each.
#[inline(always)]
pub fn sums<F: Copy, V: Sum<F>, const C: usize>(vectors: [V; C], zero: F) -> [F; C] {
    let mut sums = [zero; C];
    let (fours, rest) = vectors.as_chunks::<4>();
    let (sums_of_fours, sums_of_rest) = sums.as_chunks_mut::<4>();
    for (sums, four) in sums_of_fours.iter_mut().zip(fours) {
        *sums = V::four(four);
    }
    for (sum, vector) in sums_of_rest.iter_mut().zip(rest) {
        *sum = vector.sum();
    }
    sums
}

impl Sum<Fused<f64>> for Pair<__m256d> {
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
    fn four(vectors: &[Self; 4]) -> [Fused<f64>; 4] {
        let mut sums = [Fused(0.0); 4];
        unsafe {
            let [a, b, c, d] = *vectors;
            let (a, b) = (_mm256_add_pd(a.0, a.1), _mm256_add_pd(b.0, b.1));
            let (c, d) = (_mm256_add_pd(c.0, c.1), _mm256_add_pd(d.0, d.1));
            let (ab, cd) = (_mm256_hadd_pd(a, b), _mm256_hadd_pd(c, d));
            let low = _mm256_permute2f128_pd::<0x20>(ab, cd);
            let high = _mm256_permute2f128_pd::<0x31>(ab, cd);
            _mm256_storeu_pd(at_mut!(sums, f64, 0), _mm256_add_pd(low, high));
        }
        sums
    }
}

impl Sum<Fused<f32>> for Pair<__m256> {
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
    fn four(vectors: &[Self; 4]) -> [Fused<f32>; 4] {
        let mut sums = [Fused(0.0); 4];
        unsafe {
            let [a, b, c, d] = *vectors;
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
            _mm_storeu_ps(at_mut!(sums, f32, 0), _mm_unpacklo_ps(ac, bd));
        }
        sums
    }
}
