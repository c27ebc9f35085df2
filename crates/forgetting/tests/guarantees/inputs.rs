//! The regressors of the settings that show what rules guarantee.

use crate::record::Noise;
use crate::run::N;
use forgetting::choice::Input;

/// Rows of a sample.
pub fn rows(input: Input) -> usize {
    match input {
        Input::Exciting(rows) => rows,
        Input::Dependent | Input::Uneven(_) => 2,
        _ => 1,
    }
}

/// φ at sample k, row by row.
pub fn regressors(input: Input, k: usize, noise: &mut Noise) -> Vec<f64> {
    let mut any = |size: f64| -> Vec<f64> { (0..N).map(|_| size * noise.next()).collect() };
    match input {
        Input::Exciting(rows) => (0..rows).flat_map(|_| any(1.0)).collect(),
        Input::Silent if k >= 50 => vec![0.0; N],
        Input::Fixed if k >= 50 => vec![0.3, -0.5, 0.7],
        Input::Silent | Input::Fixed => any(1.0),
        Input::Dependent if k % 2 == 1 => vec![0.0; 2 * N],
        Input::Dependent => {
            let row = any(1.0);
            row.iter().chain(&row).enumerate().map(|(i, x)| [1.0, -0.5][i / N] * x).collect()
        }
        Input::Scaled(size) => any(size),
        Input::Fading(last) => {
            let length = last.powf(k as f64 / 3000.0);
            vec![0.6 * length, 0.8 * length, 0.0]
        }
        Input::Uneven(second) => vec![1.0, 0.0, 0.0, 0.0, second, 0.0],
        Input::Alternating => match k % 22 {
            0 => vec![1.0, 1e-3, 0.0],
            11 => vec![1.0, -1e-3, 0.0],
            _ => vec![0.0, 1e-4, 0.0],
        },
        Input::Axes => (0..N).map(|i| if i == k % N { noise.next() } else { 0.0 }).collect(),
        Input::Correlated => {
            let common = any(1.0)[0];
            any(1e-3).iter().map(|x| common + x).collect()
        }
    }
}
