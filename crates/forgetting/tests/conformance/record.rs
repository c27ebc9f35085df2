//! Samples to feed, the same in every run.
#![allow(dead_code, reason = "each test uses its share")]

use forgetting::Kernels;

/// Numbers without a pattern (xorshift).
pub struct Noise(u64);

impl Noise {
    pub fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1)
    }

    /// In (−1, 1).
    pub fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

/// A sample: φ, y and Γ.
pub struct Datum<T> {
    pub phi: Vec<T>,
    pub y: Vec<T>,
    pub gamma: Vec<T>,
}

/// A record that excites, repeats a row, falls silent, keeps one direction and excites again.
pub fn record<T: Kernels>((n, p, m): (usize, usize, usize), samples: usize) -> Vec<Datum<T>> {
    let mut noise = Noise::new((n * 100 + p * 10 + m) as u64);
    let truth: Vec<f64> = (0..n * m).map(|_| 3.0 * noise.next()).collect();
    let fixed: Vec<f64> = (0..n).map(|_| noise.next()).collect();
    let datum = |k: usize| {
        let mut phi: Vec<f64> = (0..p * n).map(|_| noise.next()).collect();
        match k * 6 / samples {
            1 if p > 1 => phi.copy_within(..n, n),
            2 => phi.fill(0.0),
            3 => phi.iter_mut().enumerate().for_each(|(i, x)| *x = fixed[i % n]),
            4 => phi.iter_mut().for_each(|x| *x *= 1e-4),
            _ => {}
        }
        let clean = |k: usize| {
            let (i, t) = (k / m, k % m);
            (0..n).map(|j| phi[i * n + j] * truth[t * n + j]).sum::<f64>()
        };
        let y = (0..p * m).map(|k| T::from_f64(clean(k) + 0.1 * noise.next())).collect();
        let mut gamma: Vec<f64> = (0..p * p).map(|_| 0.2).collect();
        (0..p).for_each(|i| gamma[i * p + i] = 0.5 + i as f64);
        let real = |v: Vec<f64>| v.into_iter().map(T::from_f64).collect();
        Datum { phi: real(phi), y, gamma: real(gamma) }
    };
    (0..samples).map(datum).collect()
}
