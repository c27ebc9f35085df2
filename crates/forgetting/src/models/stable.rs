//! Whether a filter 1/(1 + c₁q⁻¹ + … + c_n q⁻ⁿ) is stable.

use alloc::vec::Vec;

/// How far inside the unit circle reflection coefficients must be.
const MARGIN: f64 = 1e-9;

/// Whether all roots lie inside the unit circle: all reflection coefficients of the step-down
/// recursion are below 1 (Schur–Cohn). `sign` is that with which `coefficients` stand in the
/// polynomial; `work` is overwritten.
pub(super) fn is_stable(coefficients: &[f64], sign: f64, work: &mut Vec<f64>) -> bool {
    work.clear();
    work.extend(coefficients.iter().map(|c| sign * c));
    while let Some(reflection) = work.pop() {
        // a NaN is not stable
        if !(reflection.abs() < 1.0 - MARGIN) {
            return false;
        }
        step_down(work, reflection);
    }
    true
}

/// The coefficients of the polynomial of one order less.
fn step_down(coefficients: &mut [f64], reflection: f64) {
    let (last, scale) = (coefficients.len(), 1.0 / (1.0 - reflection * reflection));
    for i in 0..last.div_ceil(2) {
        let j = last - 1 - i;
        let (low, high) = (coefficients[i], coefficients[j]);
        coefficients[i] = (low - reflection * high) * scale;
        coefficients[j] = (high - reflection * low) * scale;
    }
}

#[cfg(test)]
mod tests {
    use super::is_stable;
    use std::vec::Vec;

    /// The coefficients of ∏ (1 − r q⁻¹) for real roots r.
    fn polynomial(roots: &[f64]) -> Vec<f64> {
        let mut coefficients = std::vec![1.0];
        for root in roots {
            let before = coefficients.clone();
            coefficients.push(0.0);
            for (after, own) in coefficients[1..].iter_mut().zip(&before) {
                *after -= root * own;
            }
        }
        coefficients[1..].to_vec()
    }

    #[test]
    fn the_largest_root_decides() {
        let mut work = Vec::new();
        for (roots, stable) in [
            (&[0.9, -0.5, 0.3][..], true),
            (&[0.999_999], true),
            (&[0.9, -1.001, 0.3], false),
            (&[1.0], false),
            (&[0.99, 0.99, 0.99, 0.99], true),
            (&[0.5, 1.2, 0.1, -0.7], false),
            (&[], true),
        ] {
            assert_eq!(is_stable(&polynomial(roots), 1.0, &mut work), stable, "{roots:?}");
        }
        assert!(!is_stable(&[f64::NAN], 1.0, &mut work));
        // complex pairs: 1 − 2r cos φ q⁻¹ + r² q⁻²
        assert!(is_stable(&[1.8, -0.9], -1.0, &mut work));
        assert!(!is_stable(&[1.8, -1.01], -1.0, &mut work));
    }
}
