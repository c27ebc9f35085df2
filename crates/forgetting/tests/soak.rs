//! Soaking: every rule of O(n²) for as many samples as it may see in years. A short form runs with
//! the other tests; `make soak` takes a billion samples of each, and goes on where it was stopped.

#[path = "conformance/record.rs"]
mod record;
#[path = "conformance/subjects.rs"]
mod subjects;

use forgetting::saved::AnyEstimator;
use forgetting::{Kernels, Noise, Outcome};
use record::Noise as Random;
use std::path::PathBuf;
use std::time::Instant;
use subjects::{rules, update, Subject};

const N: usize = 4;
/// Samples between two looks, saved states and changes of the input.
const BLOCK: usize = 1 << 16;
const TRUTH: [f64; N] = [1.0, -2.0, 0.5, 3.0];

fn number(name: &str) -> Option<u64> {
    std::env::var(name).ok()?.parse().ok()
}

/// Regressors and measurements of a block: exciting, along one direction, silent, large, small, and
/// exciting again before each look at the estimate.
fn block(k: u64) -> (Vec<f64>, Vec<f64>) {
    let mut noise = Random::new(k + 1);
    let fixed: Vec<f64> = (0..N).map(|_| noise.next()).collect();
    let (mut phi, mut y) = (Vec::with_capacity(BLOCK * N), Vec::with_capacity(BLOCK));
    for i in 0..BLOCK {
        // short where a rule may wind up: in f32 it would soon refuse samples
        let until = if matches!(k % 6, 1 | 2) { 500 } else { BLOCK / 2 };
        let kind = if i > until { 0 } else { k % 6 };
        let row: Vec<f64> = match kind {
            1 => fixed.clone(),
            2 => vec![0.0; N],
            3 => (0..N).map(|_| 1e3 * noise.next()).collect(),
            4 => (0..N).map(|_| 1e-3 * noise.next()).collect(),
            _ => (0..N).map(|_| noise.next()).collect(),
        };
        let clean: f64 = row.iter().zip(TRUTH).map(|(x, theta)| x * theta).sum();
        y.push(clean + 0.01 * noise.next());
        phi.extend(row);
    }
    (phi, y)
}

/// Takes samples until there were `steps`, from where it was stopped; returns how many it took.
fn soak<T: Kernels>(subject: &Subject, steps: u64, folder: Option<&PathBuf>) -> u64 {
    let name = format!("{}-{}", subject.about.name, 8 * T::BYTES);
    let place = folder.map(|folder| folder.join(name.clone() + ".state"));
    let saved = place.as_ref().and_then(|place| std::fs::read(place).ok());
    let (mut k, mut estimator) = match saved {
        Some(bytes) => {
            let (count, state) = bytes.split_at(8);
            let count = u64::from_le_bytes(count.try_into().unwrap());
            (count, AnyEstimator::<T>::from_bytes(state).unwrap())
        }
        None => (0, subject.estimator::<T>((N, 1, 1), 0.99, 100.0).unwrap()),
    };
    let (first, mut outcomes) = (k, vec![Outcome::default(); 64]);
    while k * (BLOCK as u64) < steps {
        let (phi, y) = block(k);
        let phi: Vec<T> = phi.into_iter().map(T::from_f64).collect();
        let y: Vec<T> = y.into_iter().map(T::from_f64).collect();
        let mut i = 0;
        while i < BLOCK {
            let most = outcomes.len().min(BLOCK - i);
            let taken =
                estimator.update_many(&phi[i * N..], &y[i..], &mut outcomes[..most], &mut []);
            if taken == 0 {
                let sample = (&phi[i * N..(i + 1) * N], &y[i..=i]);
                update(&mut estimator, sample.0, sample.1, Noise::Unit).unwrap();
            }
            i += taken.max(1);
        }
        k += 1;
        assert!(estimator.is_sound(), "{name}, block {k}: {estimator:?}");
        // the last half of a block excites: whoever forgets has found the truth again
        let forgets = !matches!(subject.about.name, "none" | "restricted" | "data_dependent");
        for (found, truth) in estimator.theta().iter().zip(TRUTH) {
            let off = (found.to_f64() - truth).abs();
            assert!(off < 0.05 || !forgets, "{name}, block {k}: {:?}", estimator.theta());
        }
        if let Some(place) = &place {
            let mut bytes = k.to_le_bytes().to_vec();
            bytes.extend(estimator.to_bytes().unwrap());
            std::fs::write(place.with_extension("new"), bytes).unwrap();
            std::fs::rename(place.with_extension("new"), place).unwrap();
        }
    }
    (k - first) * BLOCK as u64
}

#[test]
fn nothing_wears_out() {
    let steps = number("SOAK_STEPS").unwrap_or(2 * BLOCK as u64);
    let folder = std::env::var("SOAK_FOLDER").ok().map(PathBuf::from);
    if let Some(folder) = &folder {
        std::fs::create_dir_all(folder).unwrap();
    }
    let square = |subject: &Subject| subject.about.cost.contains("n^2");
    for subject in rules().filter(square) {
        let start = Instant::now();
        let double = soak::<f64>(&subject, steps, folder.as_ref());
        let single = soak::<f32>(&subject, steps, folder.as_ref());
        let (name, seconds) = (subject.about.name, start.elapsed().as_secs_f64());
        println!(
            "soak {name}: 0 failures in {double} f64 and {single} f32 samples, {seconds:.0} s"
        );
    }
}
