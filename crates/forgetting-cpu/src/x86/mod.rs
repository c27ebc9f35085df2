//! Vectors in the registers of x86-64.
//!
//! These types are named by the functions of `level` alone, which check that the machine has the
//! instructions before they run anything over them.

use crate::level::Vectors;
use crate::Fused;
use core::arch::x86_64::*;
use forgetting::vector::Vector;

mod lanes;
mod single;

use single::Single;

/// Two registers of 256 bits.
#[derive(Clone, Copy, Debug)]
pub struct Pair<R>(R, R);

/// A register of 512 bits.
#[derive(Clone, Copy, Debug)]
pub struct Wide<R>(R);

impl Vectors for Fused<f64> {
    type Fused = Pair<__m256d>;
    type Wide = Wide<__m512d>;
}

impl Vectors for Fused<f32> {
    type Fused = Pair<__m256>;
    type Wide = Wide<__m512>;
}

/// The address of the numbers of an array.
macro_rules! at {
    ($array:expr, $float:ty, $offset:expr) => {
        $array.as_ptr().cast::<$float>().add($offset)
    };
}
macro_rules! at_mut {
    ($array:expr, $float:ty, $offset:expr) => {
        $array.as_mut_ptr().cast::<$float>().add($offset)
    };
}
use {at, at_mut};

// SAFETY, for every `unsafe` below: the machine has the instructions (see the head of this
// file), `Fused` has the layout of its number, and the addresses are those of arrays of at least
// as many numbers as are read or written; loads and stores need no alignment.

impl Vector<Fused<f64>> for Wide<__m512d> {
    type Abreast = Self;
    type One = Single<__m128d>;

    #[inline(always)]
    fn load(chunk: &[Fused<f64>; 8]) -> Self {
        Self(unsafe { _mm512_loadu_pd(at!(chunk, f64, 0)) })
    }
    #[inline(always)]
    fn store(self, chunk: &mut [Fused<f64>; 8]) {
        unsafe { _mm512_storeu_pd(at_mut!(chunk, f64, 0), self.0) }
    }
    #[inline(always)]
    fn sum(self) -> Fused<f64> {
        Pair(unsafe { _mm512_castpd512_pd256(self.0) }, unsafe {
            _mm512_extractf64x4_pd::<1>(self.0)
        })
        .sum()
    }
}

/// The sums of four vectors: what `sum` does to each, side by side.
///
/// # Safety
/// The machine has AVX.
#[inline(always)]
unsafe fn sums_of_four(vectors: &[Pair<__m256d>; 4]) -> [Fused<f64>; 4] {
    let mut sums = [Fused(0.0); 4];
    // SAFETY: the instructions by the caller's promise; `Fused` has the layout of its number
    unsafe {
        let [a, b, c, d] = vectors.map(|Pair(low, high)| _mm256_add_pd(low, high));
        let (ab, cd) = (_mm256_hadd_pd(a, b), _mm256_hadd_pd(c, d));
        let low = _mm256_permute2f128_pd::<0x20>(ab, cd);
        let high = _mm256_permute2f128_pd::<0x31>(ab, cd);
        _mm256_storeu_pd(at_mut!(sums, f64, 0), _mm256_add_pd(low, high));
    }
    sums
}

impl Vector<Fused<f64>> for Pair<__m256d> {
    type Abreast = Single<__m256d>;
    type One = Single<__m128d>;

    #[inline(always)]
    fn load(chunk: &[Fused<f64>; 8]) -> Self {
        unsafe { Self(_mm256_loadu_pd(at!(chunk, f64, 0)), _mm256_loadu_pd(at!(chunk, f64, 4))) }
    }
    #[inline(always)]
    fn store(self, chunk: &mut [Fused<f64>; 8]) {
        unsafe {
            _mm256_storeu_pd(at_mut!(chunk, f64, 0), self.0);
            _mm256_storeu_pd(at_mut!(chunk, f64, 4), self.1);
        }
    }
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
    fn sums<const C: usize>(vectors: [Self; C]) -> [Fused<f64>; C] {
        let mut sums = [Fused(0.0); C];
        let (fours, rest) = vectors.as_chunks::<4>();
        let (sums_of_fours, sums_of_rest) = sums.as_chunks_mut::<4>();
        for (sums, four) in sums_of_fours.iter_mut().zip(fours) {
            *sums = unsafe { sums_of_four(four) };
        }
        for (sum, vector) in sums_of_rest.iter_mut().zip(rest) {
            *sum = vector.sum();
        }
        sums
    }
}

impl Vector<Fused<f32>> for Wide<__m512> {
    type Abreast = Self;
    type One = Single<__m128>;

    #[inline(always)]
    fn load(chunk: &[Fused<f32>; 16]) -> Self {
        Self(unsafe { _mm512_loadu_ps(at!(chunk, f32, 0)) })
    }
    #[inline(always)]
    fn store(self, chunk: &mut [Fused<f32>; 16]) {
        unsafe { _mm512_storeu_ps(at_mut!(chunk, f32, 0), self.0) }
    }
    #[inline(always)]
    fn sum(self) -> Fused<f32> {
        Pair(unsafe { _mm512_castps512_ps256(self.0) }, unsafe {
            _mm512_extractf32x8_ps::<1>(self.0)
        })
        .sum()
    }
}

impl Vector<Fused<f32>> for Pair<__m256> {
    type Abreast = Single<__m256>;
    type One = Single<__m128>;

    #[inline(always)]
    fn load(chunk: &[Fused<f32>; 16]) -> Self {
        unsafe { Self(_mm256_loadu_ps(at!(chunk, f32, 0)), _mm256_loadu_ps(at!(chunk, f32, 8))) }
    }
    #[inline(always)]
    fn store(self, chunk: &mut [Fused<f32>; 16]) {
        unsafe {
            _mm256_storeu_ps(at_mut!(chunk, f32, 0), self.0);
            _mm256_storeu_ps(at_mut!(chunk, f32, 8), self.1);
        }
    }
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
}
