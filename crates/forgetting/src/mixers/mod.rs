//! Which members of a bank to believe: their weights, from how well each has predicted.
//!
//! One file per mixer, one line per mixer in the registry below. A mixer sees the errors of the
//! members and of their mixture, before the members learn from the sample, and gives each member a
//! weight for the next one. Its K weights are not negative and sum to 1.

use crate::choice::registry::registry;
use crate::choice::{Value, Values};
use crate::error::Error;
use crate::memory::state::State;
use crate::memory::Memory;
use forgetting_kernels::Real;

/// What the members of a bank predicted of one sample, and what became of it.
#[derive(Clone, Copy, Debug)]
pub struct Forecasts<'a, T> {
    /// whitened y − φθ of each member, p x m numbers, one member after the other
    pub errors: &'a [T],
    /// the same of the mixture, p x m numbers
    pub mixed: &'a [T],
    /// φ̄P̄φ̄ᵀ of each member
    pub leverages: &'a [T],
    /// whether each member took the sample; the errors of one that did not are not to be used
    pub awake: &'a [bool],
}

impl<T: Real> Forecasts<'_, T> {
    /// The errors of member i.
    #[inline]
    pub fn error(&self, i: usize) -> &[T] {
        let width = self.mixed.len();
        &self.errors[i * width..(i + 1) * width]
    }

    /// Whether every member took the sample.
    #[inline]
    pub fn are_all_awake(&self) -> bool {
        self.awake.iter().fold(true, |all, &awake| all & awake)
    }

    /// The members that took the sample.
    pub fn awake(&self) -> impl Iterator<Item = usize> + '_ {
        self.awake.iter().enumerate().filter_map(|(i, &awake)| awake.then_some(i))
    }
}

/// A way to weigh the members of a bank; its memory has K in the place of n.
pub trait Mixer<M: Memory>: Clone + core::fmt::Debug + Send + Sync {
    /// What the mixer remembers from sample to sample.
    type State: State<M::Real>;

    /// The mixer with these parameter values.
    ///
    /// # Errors
    /// [`Error`] names the parameter, its value and the allowed range.
    fn configure(values: &dyn Values, memory: M) -> Result<Self, Error>;

    /// Names each parameter with its value: [`Mixer::configure`] takes them back.
    fn describe(&self, each: &mut dyn FnMut(&'static str, Value<'_>));

    /// The state before the first sample.
    fn start(&self, memory: M) -> Self::State;

    /// Writes a number for each member, not negative, to `weights`: in proportion to them, or all
    /// alike if all are 0, are the members believed.
    fn weigh(&self, state: &Self::State, weights: &mut [M::Real]);

    /// Takes note of a sample.
    fn learn(&self, state: &mut Self::State, forecasts: &Forecasts<'_, M::Real>);
}

registry! {
    "mixer", "mixers", MIXERS, AnyMixer [AnyMixerState]: Mixer {
        fn weigh(&self, state: &State, weights: &mut [M::Real]);
        fn learn(&self, state: &mut State, forecasts: &Forecasts<'_, M::Real>);
    }
    entries {
        mlpol::Mlpol,
        dynamic_model_averaging::DynamicModelAveraging,
        best::Best,
    }
}
