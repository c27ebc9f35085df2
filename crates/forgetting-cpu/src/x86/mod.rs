//! Vectors in the registers of x86-64.
//!
//! These types are named by functions that `level` alone calls, which checks that the machine has the
//! instructions before it runs anything over them.

use crate::fused::Fused;
use crate::level::Levels;
use core::arch::x86_64::*;
use forgetting_kernels::number::vector::Vector;
use forgetting_kernels::Kernel;

mod block_vector;
mod columns;
mod lanes;
mod single;
mod sums;

use single::Single;

/// Two registers of 256 bits.
#[derive(Clone, Copy, Debug)]
pub struct Pair<R>(R, R);

/// A register of 512 bits.
#[derive(Clone, Copy, Debug)]
pub struct Wide<R>(R);

/// Compiles the kernels of a number type for both levels, in a module of their own: the compiler makes
/// units of code of whole modules, and two units are compiled side by side.
macro_rules! compile_levels {
    ($module:ident, $float:ident, $fused:ty, $wide:ty) => {
        mod $module {
            use crate::fused::Fused;
            use crate::x86::{Pair, Wide};
            use core::arch::x86_64::*;
            use forgetting_kernels::Kernel;

            #[target_feature(enable = "avx2,fma")]
            #[inline(never)]
            pub fn run_fused<K: Kernel<Fused<$float>>>(kernel: K) -> K::Output {
                kernel.run::<$fused, 4>()
            }

            #[target_feature(enable = "avx2,fma,avx512f,avx512dq,avx512vl")]
            #[inline(never)]
            pub fn run_wide<K: Kernel<Fused<$float>>>(kernel: K) -> K::Output {
                kernel.run::<$wide, 8>()
            }
        }

        impl Levels for Fused<$float> {
            #[inline(always)]
            unsafe fn run_fused<K: Kernel<Self>>(kernel: K) -> K::Output {
                // SAFETY: as the caller says
                unsafe { $module::run_fused(kernel) }
            }
            #[inline(always)]
            unsafe fn run_wide<K: Kernel<Self>>(kernel: K) -> K::Output {
                // SAFETY: as the caller says
                unsafe { $module::run_wide(kernel) }
            }
        }
    };
}
compile_levels!(double, f64, Pair<__m256d>, Wide<__m512d>);
compile_levels!(float, f32, Pair<__m256>, Wide<__m512>);

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
    type StreamVector = Self;
    type One = Single<__m128d>;

    #[inline(always)]
    fn load(chunk: &[Fused<f64>; 8]) -> Self {
        Self(unsafe { _mm512_loadu_pd(at!(chunk, f64, 0)) })
    }
    #[inline(always)]
    fn store(self, chunk: &mut [Fused<f64>; 8]) {
        unsafe { _mm512_storeu_pd(at_mut!(chunk, f64, 0), self.0) }
    }
}

impl Vector<Fused<f64>> for Pair<__m256d> {
    type StreamVector = Single<__m256d>;
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
}

impl Vector<Fused<f32>> for Wide<__m512> {
    type StreamVector = Self;
    type One = Single<__m128>;

    #[inline(always)]
    fn load(chunk: &[Fused<f32>; 16]) -> Self {
        Self(unsafe { _mm512_loadu_ps(at!(chunk, f32, 0)) })
    }
    #[inline(always)]
    fn store(self, chunk: &mut [Fused<f32>; 16]) {
        unsafe { _mm512_storeu_ps(at_mut!(chunk, f32, 0), self.0) }
    }
}

impl Vector<Fused<f32>> for Pair<__m256> {
    type StreamVector = Single<__m256>;
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
}
