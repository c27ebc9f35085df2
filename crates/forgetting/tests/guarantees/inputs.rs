//! Regressors that excite, and regressors that do not.

use crate::record::Noise;
use crate::run::N;

/// How the regressors of a run behave, all within the unit ball but for a factor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Input {
    /// every direction, this many rows
    Exciting(usize),
    /// 50 exciting samples, then zeros
    Silent,
    /// 50 exciting samples, then one direction
    Fixed,
    /// rows that are multiples of each other, every second sample silent
    Dependent,
    /// all directions, of this length
    Scaled(f64),
    /// one direction, falling to this length over 3000 samples
    Fading(f64),
    /// two rows, the second of this length and orthogonal to the first
    Uneven(f64),
    /// once (1, ±1e-3, 0), then ten times (0, 1e-4, 0)
    Alternating,
    /// one component at a time
    Axes,
    /// all components equal, but for one part in a thousand
    Correlated,
}

impl Input {
    pub fn rows(self) -> usize {
        match self {
            Self::Exciting(rows) => rows,
            Self::Dependent | Self::Uneven(_) => 2,
            _ => 1,
        }
    }

    /// φ at sample k, row by row.
    pub fn regressors(self, k: usize, noise: &mut Noise) -> Vec<f64> {
        let mut any = |size: f64| -> Vec<f64> { (0..N).map(|_| size * noise.next()).collect() };
        match self {
            Self::Exciting(rows) => (0..rows).flat_map(|_| any(1.0)).collect(),
            Self::Silent if k >= 50 => vec![0.0; N],
            Self::Fixed if k >= 50 => vec![0.3, -0.5, 0.7],
            Self::Silent | Self::Fixed => any(1.0),
            Self::Dependent if k % 2 == 1 => vec![0.0; 2 * N],
            Self::Dependent => {
                let row = any(1.0);
                row.iter().chain(&row).enumerate().map(|(i, x)| [1.0, -0.5][i / N] * x).collect()
            }
            Self::Scaled(size) => any(size),
            Self::Fading(last) => {
                let length = last.powf(k as f64 / 3000.0);
                vec![0.6 * length, 0.8 * length, 0.0]
            }
            Self::Uneven(second) => vec![1.0, 0.0, 0.0, 0.0, second, 0.0],
            Self::Alternating => match k % 22 {
                0 => vec![1.0, 1e-3, 0.0],
                11 => vec![1.0, -1e-3, 0.0],
                _ => vec![0.0, 1e-4, 0.0],
            },
            Self::Axes => (0..N).map(|i| if i == k % N { noise.next() } else { 0.0 }).collect(),
            Self::Correlated => {
                let common = any(1.0)[0];
                any(1e-3).iter().map(|x| common + x).collect()
            }
        }
    }
}
