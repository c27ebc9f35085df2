//! One parameter a sample: what the samples of a cycle add to its variance, in its turn.

use super::growth::Growth;
use crate::error::Error;
use crate::memory::Memory;
use crate::rules::cycle::Cycle;
use crate::rules::Step;
use forgetting_kernels::Real;

/// P ← P + w e_i e_iᵀ for the parameter i whose turn it is; returns the number of directions.
#[inline]
pub fn take_turn<M: Memory>(
    cycle: &mut Cycle,
    growth: Growth<M::Real>,
    step: &mut Step<'_, '_, M>,
) -> Result<usize, Error> {
    let n = step.factor.parameters();
    let i = cycle.turn(n);
    let weight = growth.added_in(n, step.factor.variance(i));
    if !(weight > M::Real::ZERO) {
        return Ok(0);
    }
    step.factor.reserve(M::Real::ONE, weight)?;
    step.factor.add_variance(i, weight, step.work.first.as_mut());
    Ok(1)
}

#[cfg(test)]
mod tests {
    use crate::rules::efra::Efra;
    use crate::rules::Forgetting;
    use crate::testing::{covariance, forget, measured, memory, Dense};

    /// By the diagonal: with it the whole of a diagonal P.
    #[test]
    fn a_cycle_in_silence_is_as_many_samples() {
        let silence = Dense::new(1, &[0.0; 3]);
        let m = memory(&silence, 1);
        let all = Efra::new(0.5, 0.02, 0.01).unwrap();
        let turns = all.cyclic();
        for start in [Dense::new(3, &[1.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 9.0]), covariance()] {
            let is_diagonal = |k: usize| k.is_multiple_of(4);
            let diagonal = |k: usize| if is_diagonal(k) { start.elements[k] } else { 0.0 };
            let mut expected = Dense::new(3, &core::array::from_fn::<_, 9, _>(diagonal));
            // what the first sample adds is added by the second
            let (mut pending, mut cycle) = (all.start(m), turns.start(m));
            forget(&all, &mut pending, &expected, &silence, 0.9);
            let mut p = start.clone();
            for _ in 0..6 {
                expected = forget(&all, &mut pending, &expected, &silence, 0.9).covariance;
                p = forget(&turns, &mut cycle, &p, &silence, 0.9).covariance;
            }
            for k in 0..9 {
                let expected =
                    if is_diagonal(k) { expected.elements[k] } else { start.elements[k] };
                assert!((p.elements[k] - expected).abs() < 1e-14, "{k}");
            }
        }
    }

    /// Both variances go to the bound, and with them the forgetting of what φ measures.
    #[test]
    fn the_sum_of_parameters_with_equal_regressors_is_forgotten_no_more() {
        let (phi, mut p) = (Dense::new(1, &[1.0, 1.0]), Dense::new(2, &[10.0, 0.0, 0.0, 10.0]));
        let rule = Efra::new(1.0, 0.0, 1e-4).unwrap().cyclic();
        let (mut cycle, mut early) = (rule.start(memory(&phi, 1)), 0.0);
        let spread = |p: &Dense| p.elements.iter().sum::<f64>();
        for k in 1..=8000 {
            let found = forget(&rule, &mut cycle, &p, &phi, 0.95);
            p = measured(&found.covariance, &found.regressors);
            if k == 1000 {
                early = spread(&p);
            }
        }
        assert!(spread(&p) < 0.1 * early, "{early} {}", spread(&p));
    }
}
