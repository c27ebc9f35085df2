//! The information Σ φᵀΓ⁻¹φ of the last N samples, kept in O(n²) a sample.
//!
//! ```text
//! A_k = Σ φ_iᵀΓ_i⁻¹φ_i,  i = k − N + 1 … k       α I ≤ A_k ≤ β I: GF-RLS (A4), N terms
//! A ← A + φ_kᵀφ_k − φ_{k−N}ᵀφ_{k−N}              O(n²) a sample
//! B ← B + φ_kᵀφ_k                                 the same sum, begun anew every N samples
//! A ← B, B ← 0                                    every N samples
//! ```
//!
//! Subtracting is safe here because it does not last: every N samples A is replaced by a sum that
//! nothing was subtracted from. Until then rounding adds up to at most about N ε times the largest
//! trace of A since ([`InformationWindow::noise`]): an eigenvalue below that is 0.

use crate::choice::{Parameter, Range};
use crate::error::Error;
use crate::memory::{zeros, Dynamic};
use crate::sample::{whiten, Noise, Sample};
use alloc::vec::Vec;
use forgetting_kernels::{Kernels, Real};

/// A sliding window over whitened regressors.
#[derive(Clone, Debug)]
pub struct InformationWindow<T> {
    parameters: usize,
    rows: usize,
    window: usize,
    /// the last N samples, in a ring
    samples: Vec<T>,
    /// A, upper triangle
    sum: Vec<T>,
    /// B, upper triangle
    fresh: Vec<T>,
    /// the largest trace of A since B began
    largest: T,
    count: u64,
}

impl<T: Real> InformationWindow<T> {
    /// A window of `window` samples of `rows` x `parameters` numbers.
    ///
    /// # Errors
    /// [`Error::Value`] names what is 0 or larger than 2²⁰, [`Error::Memory`] when there is none.
    pub fn new(parameters: usize, rows: usize, window: usize) -> Result<Self, Error> {
        const RANGE: Range = Range::open(0.5, 1_048_576.5, "whole numbers from 1 to 1048576");
        for (name, size) in [("parameters", parameters), ("rows", rows), ("window", window)] {
            Parameter::whole(name, 1.0, RANGE, "").check(size as f64)?;
        }
        let length = window.checked_mul(rows).and_then(|all| all.checked_mul(parameters));
        Ok(Self {
            parameters,
            rows,
            window,
            samples: zeros(length.ok_or(Error::Memory)?)?,
            sum: zeros(parameters * parameters)?,
            fresh: zeros(parameters * parameters)?,
            largest: T::ZERO,
            count: 0,
        })
    }

    /// Takes one whitened sample Γ^(−1/2)φ, `rows` x `parameters` numbers.
    ///
    /// # Errors
    /// [`Error`] names `phi`: its length, or a number that is not finite or too large to square;
    /// nothing has changed.
    pub fn add(&mut self, phi: &[T]) -> Result<(), Error> {
        let length = self.rows * self.parameters;
        Error::check_length("phi", phi.len(), length)?;
        if let Some(index) = phi.iter().position(|x| !(*x * *x <= T::CEILING)) {
            let value = phi[index].to_f64();
            let allowed = "finite numbers with a square in range";
            return Err(Error::Value { parameter: "phi", index: Some(index), value, allowed });
        }
        let place = (self.count % self.window as u64) as usize;
        let oldest = &mut self.samples[place * length..(place + 1) * length];
        accumulate(&mut self.sum, oldest, -T::ONE, self.parameters);
        oldest.copy_from_slice(phi);
        accumulate(&mut self.sum, phi, T::ONE, self.parameters);
        accumulate(&mut self.fresh, phi, T::ONE, self.parameters);
        self.count += 1;
        self.largest = self.largest.max(self.trace());
        if self.count.is_multiple_of(self.window as u64) {
            self.sum.copy_from_slice(&self.fresh);
            self.fresh.fill(T::ZERO);
            self.largest = self.trace();
        }
        Ok(())
    }

    /// Takes one sample φ, `rows` x `parameters` numbers, with the noise covariance Γ = `noise`.
    ///
    /// # Errors
    /// Those of [`InformationWindow::add`], and [`Error`] names a `gamma` that is not positive
    /// definite; nothing has changed.
    pub fn add_with_noise(&mut self, phi: &[T], noise: Noise<'_, T>) -> Result<(), Error>
    where
        T: Kernels,
    {
        Error::check_length("phi", phi.len(), self.rows * self.parameters)?;
        let memory = Dynamic::new(self.parameters, self.rows, 1)?;
        let (mut whitened, mut root) = (phi.to_vec(), zeros(self.rows * self.rows)?);
        let mut errors = zeros(self.rows)?;
        whiten(&mut Sample::new(memory, &mut whitened, &mut errors), noise, &mut root)?;
        self.add(&whitened)
    }

    fn trace(&self) -> T {
        self.sum.iter().step_by(self.parameters + 1).fold(T::ZERO, |sum, &x| sum + x)
    }

    /// A, n x n numbers, written to `information`.
    ///
    /// # Errors
    /// [`Error::Length`].
    pub fn information(&self, information: &mut [T]) -> Result<(), Error> {
        let n = self.parameters;
        Error::check_length("information", information.len(), n * n)?;
        for i in 0..n {
            for j in i..n {
                information[i * n + j] = self.sum[i * n + j];
                information[j * n + i] = self.sum[i * n + j];
            }
        }
        Ok(())
    }

    /// The size below which an eigenvalue of A cannot be distinguished from rounding.
    pub fn noise(&self) -> T {
        T::EPSILON * self.largest * T::from_f64((self.window + self.parameters) as f64)
    }

    /// Samples taken so far; the window is full from N on.
    pub fn samples(&self) -> u64 {
        self.count
    }

    /// N
    pub fn window(&self) -> usize {
        self.window
    }
}

/// Upper triangle of `sum` += sign · φᵀφ.
fn accumulate<T: Real>(sum: &mut [T], phi: &[T], sign: T, n: usize) {
    for row in phi.chunks_exact(n) {
        for (i, line) in sum.chunks_exact_mut(n).enumerate() {
            let c = sign * row[i];
            for (x, &f) in line[i..].iter_mut().zip(&row[i..]) {
                *x = c.mul_add(f, *x);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::InformationWindow;
    use alloc::vec::Vec;

    fn sample(k: usize) -> Vec<f64> {
        (0..6)
            .map(|i| ((k * 6 + i) as f64).sin() * if k.is_multiple_of(50) { 1e6 } else { 1.0 })
            .collect()
    }

    #[test]
    fn the_window_is_the_sum_of_its_samples() {
        let mut meter = InformationWindow::<f64>::new(3, 2, 20).unwrap();
        let mut information = [0.0; 9];
        for k in 0..500 {
            meter.add(&sample(k)).unwrap();
            meter.information(&mut information).unwrap();
            let noise = meter.noise();
            for (place, value) in information.iter().enumerate() {
                let (i, j) = (place / 3, place % 3);
                let start = k.saturating_sub(19);
                let rows: Vec<_> = (start..=k).map(sample).collect();
                let direct: f64 = rows.iter().map(|r| r[i] * r[j] + r[3 + i] * r[3 + j]).sum();
                assert!((value - direct).abs() <= noise, "{k}: {value} {direct} {noise}");
            }
        }
    }

    #[test]
    fn bad_samples_change_nothing() {
        let mut meter = InformationWindow::<f64>::new(2, 1, 3).unwrap();
        meter.add(&[1.0, 2.0]).unwrap();
        for bad in [&[1.0][..], &[f64::NAN, 1.0], &[1e200, 1.0], &[f64::INFINITY, 0.0]] {
            meter.add(bad).unwrap_err();
        }
        let mut information = [0.0; 4];
        meter.information(&mut information).unwrap();
        assert_eq!(information, [1.0, 2.0, 2.0, 4.0]);
        assert!(InformationWindow::<f64>::new(0, 1, 3).is_err());
    }
}
