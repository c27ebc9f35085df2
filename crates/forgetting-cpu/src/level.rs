//! What the machine can do, found out once.

#[cfg(target_arch = "x86_64")]
use forgetting_kernels::kernel::layout::FEW;
use forgetting_kernels::{Dispatch, Kernel, Real};
use std::sync::atomic::{AtomicU8, Ordering};

/// A set of instructions, each with those before it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[repr(u8)]
pub enum Level {
    /// what every machine of this architecture has, without fused multiply-add
    Baseline = 1,
    /// fused multiply-add and vectors of 256 bits (AVX2 and FMA), or NEON
    Fused = 2,
    /// vectors of 512 bits (AVX-512)
    Wide = 3,
}

/// The variable of the environment that holds the level down: `baseline`, `avx2` (or `neon`) or
/// `avx512`.
pub const VARIABLE: &str = "FORGETTING_CPU";

/// The best level that the machine has and the environment allows.
#[inline(always)]
pub fn level() -> Level {
    static LEVEL: AtomicU8 = AtomicU8::new(0);
    match LEVEL.load(Ordering::Relaxed) {
        1 => Level::Baseline,
        2 => Level::Fused,
        3 => Level::Wide,
        _ => {
            let level = allowed().map_or(detected(), |allowed| detected().min(allowed));
            LEVEL.store(level as u8, Ordering::Relaxed);
            level
        }
    }
}

#[cold]
fn allowed() -> Option<Level> {
    match std::env::var(VARIABLE).ok()?.as_str() {
        "baseline" => Some(Level::Baseline),
        "avx2" | "neon" => Some(Level::Fused),
        _ => None,
    }
}

#[cold]
#[cfg(target_arch = "x86_64")]
fn detected() -> Level {
    if !(is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma")) {
        Level::Baseline
    } else if is_x86_feature_detected!("avx512f")
        && is_x86_feature_detected!("avx512dq")
        && is_x86_feature_detected!("avx512vl")
    {
        Level::Wide
    } else {
        Level::Fused
    }
}

#[cold]
#[cfg(target_arch = "aarch64")]
fn detected() -> Level {
    Level::Fused
}

#[cold]
#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
fn detected() -> Level {
    Level::Baseline
}

/// A number type whose kernels are compiled for each level.
#[cfg(target_arch = "x86_64")]
pub trait Levels: Real {
    /// Runs a kernel with AVX2 and FMA.
    ///
    /// # Safety
    /// The machine has them.
    unsafe fn run_fused<K: Kernel<Self>>(kernel: K) -> K::Output;
    /// Runs a kernel with AVX-512 F, DQ and VL, AVX2 and FMA.
    ///
    /// # Safety
    /// The machine has them.
    unsafe fn run_wide<K: Kernel<Self>>(kernel: K) -> K::Output;
}

/// Runs loops with the instructions of [`level`].
#[derive(Clone, Copy, Debug)]
pub struct Machine;

#[cfg(target_arch = "x86_64")]
impl<T: Levels> Dispatch<T> for Machine {
    #[inline(always)]
    fn run<K: Kernel<T>>(kernel: K) -> K::Output {
        match level() {
            // SAFETY: the level says that the machine has AVX-512 F, DQ and VL, AVX2 and FMA
            Level::Wide if kernel.size() > FEW => unsafe { T::run_wide(kernel) },
            Level::Baseline => no_fused_multiply_add(),
            // SAFETY: the level says that the machine has AVX2 and FMA
            _ => unsafe { T::run_fused(kernel) },
        }
    }
}

#[cfg(target_arch = "x86_64")]
#[cold]
#[inline(never)]
fn no_fused_multiply_add() -> ! {
    panic!("this machine has no fused multiply-add, or the environment forbids it: use f64 or f32")
}

/// Every aarch64 has NEON and fused multiply-add.
#[cfg(not(target_arch = "x86_64"))]
impl<T: Real> Dispatch<T> for Machine {
    #[inline(always)]
    fn run<K: Kernel<T>>(kernel: K) -> K::Output {
        kernel.run::<T::Lanes, 4>()
    }
}
