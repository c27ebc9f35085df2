//! Gross errors, as the mixer is shown them where the members of a bank are weighted.

use super::mixture::Mixture;
use crate::memory::state::{State, Visitor};
use crate::sample::NoiseVariance;
use alloc::vec::Vec;
use forgetting_kernels::Kernels;

/// Standard deviations at which errors are clipped.
const LIMIT: f64 = 3.0;

/// How large the errors of the mixture usually are, target by target; of no target where every sample
/// is trusted alike.
#[derive(Clone, Debug)]
pub(super) struct Clip<T>(Vec<NoiseVariance<T>>);

impl<T: Kernels> Clip<T> {
    /// For members that are weighted, or not.
    pub fn new(targets: usize, is_weighted: bool) -> Self {
        Self(alloc::vec![NoiseVariance::UNKNOWN; if is_weighted { targets } else { 0 }])
    }

    /// Clips the whitened errors of all members at three standard deviations of the mixture's. One gross
    /// error must not decide which member is believed from then on. The mixture of the clipped errors
    /// takes the place of its own error, `mixed`.
    pub fn clip(
        &mut self,
        mixture: &Mixture<T>,
        (errors, mixed): (&mut [T], &mut [T]),
        awake: &[bool],
        parameters: usize,
    ) {
        let (targets, width) = (self.0.len(), mixed.len());
        for (t, usual) in self.0.iter_mut().enumerate() {
            let own = (t..width).step_by(targets);
            let squared = own.clone().fold(T::ZERO, |sum, j| sum + mixed[j] * mixed[j]);
            if let Some(variance) = usual.known() {
                let limit = T::from_f64(LIMIT) * variance.sqrt();
                for j in own {
                    for e in errors.iter_mut().skip(j).step_by(width) {
                        *e = e.max(-limit).min(limit);
                    }
                    mixed[j] = mixture.mean_of(&|i| errors[i * width + j], awake);
                }
            }
            if NoiseVariance::<T>::is_settled(mixture.samples(), parameters) {
                let rows = width / targets;
                usual.learn(squared / T::from_f64(rows as f64), rows, T::ZERO);
            }
        }
    }
}

impl<T: Kernels> State<T> for Clip<T> {
    fn visit(&mut self, visitor: &mut dyn Visitor<T>) {
        self.0.iter_mut().for_each(|usual| usual.visit(visitor));
    }

    fn is_sound(&self) -> bool {
        self.0.iter().all(State::is_sound)
    }
}
