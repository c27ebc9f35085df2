//! Gross errors, as the mixer is shown them where the members of a bank are weighted.

use super::members::Members;
use super::mixture::{in_deviations, Mixture};
use crate::memory::state::{State, Visitor};
use crate::sample::NoiseVariance;
use forgetting_kernels::{Kernels, Real};

/// Standard deviations at which errors are clipped.
const LIMIT: f64 = 3.0;

/// How large the errors of the mixture usually are, target by target; of no target where every sample
/// is trusted alike.
#[derive(Clone, Debug)]
pub(super) struct Clip<G: Members>(G::NoiseVariances);

impl<T: Kernels, G: Members<Real = T>> Clip<G> {
    /// For members that are weighted, or not.
    pub fn new(members: &G, targets: usize) -> Self {
        Self(members.noise_variances(if members.is_weighted() { targets } else { 0 }))
    }

    /// Clips the whitened errors of all members at three standard deviations of the mixture's. One gross
    /// error must not decide which member is believed from then on. The mixture of the clipped errors
    /// takes the place of its own error, `mixed`. Returns whether it is known what is gross: until then
    /// the mixer is better told nothing.
    pub fn clip(
        &mut self,
        mixture: &Mixture<G>,
        (errors, mixed): (&mut [T], &mut [T]),
        awake: &[bool],
        parameters: usize,
    ) -> bool {
        let usual = self.0.as_mut();
        let (targets, width) = (usual.len(), mixed.len());
        let mut all_known = true;
        for (t, usual) in usual.iter_mut().enumerate() {
            let own = (t..width).step_by(targets);
            let squared = own.clone().fold(T::ZERO, |sum, j| sum + mixed[j] * mixed[j]);
            if let Some(variance) = usual.known() {
                let limit = T::from_f64(LIMIT) * variance.sqrt();
                for j in own {
                    for e in errors.iter_mut().skip(j).step_by(width) {
                        *e = e.max(-limit).min(limit);
                    }
                    mixed[j] = mixture.mean_of(errors.iter().skip(j).step_by(width), awake);
                }
            } else {
                all_known = false;
            }
            if NoiseVariance::<T>::is_settled(mixture.samples(), parameters) {
                let rows = width / targets;
                usual.learn(squared / T::from_f64(rows as f64), rows, T::ZERO);
            }
        }
        all_known
    }

    /// Errors in units of what is usual now, as far as members are weighted. Before θ is known, what is
    /// usual is large: what a member gained or lost then would otherwise decide for ever.
    pub fn in_usual_units(&self, mixture: &Mixture<G>, errors: &mut [T], mixed: &mut [T]) {
        let usual = self.0.as_ref();
        if usual.is_empty() {
            in_deviations(mixture.target_variances().iter().copied(), errors, mixed);
        } else {
            let variances = usual.iter().map(|usual| usual.known().unwrap_or_default());
            in_deviations(variances, errors, mixed);
        }
    }
}

impl<T: Real, G: Members<Real = T>> State<T> for Clip<G> {
    fn visit(&mut self, visitor: &mut dyn Visitor<T>) {
        self.0.as_mut().iter_mut().for_each(|usual| usual.visit(visitor));
    }

    fn is_sound(&self) -> bool {
        self.0.as_ref().iter().all(State::is_sound)
    }
}
