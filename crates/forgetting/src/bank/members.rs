//! What a bank asks of its members, and of where they and the numbers about them are kept.

use crate::error::Error;
use crate::estimator::Named;
use crate::memory::state::Visitor;
use crate::memory::{Buffer, Memory};
use crate::sample::{Answer, Noise, NoiseVariance, Skip};
use core::fmt::Debug;
use forgetting_kernels::kernel::functions::add_scaled;
use forgetting_kernels::{Kernels, Real};

/// An estimator in a bank.
pub trait Member<M: Memory>: Clone + Debug + Send + Sync {
    /// Takes a sample `elapsed` after the last one; writes y − φθ, p x m numbers, to `errors`.
    ///
    /// # Errors
    /// [`Error`] names what was wrong; the member is as it was, bit for bit.
    fn take(
        &mut self,
        elapsed: M::Real,
        sample: (&[M::Real], &[M::Real]),
        noise: Noise<'_, M::Real>,
        errors: &mut [M::Real],
    ) -> Result<Brought<M::Real>, Error>;

    /// Back to the prior, as if no sample had been seen.
    fn reset(&mut self);

    /// θ, m x n numbers, one target after the other.
    fn theta(&self) -> &[M::Real];

    /// P as n x n numbers, each parameter in units of the `reciprocal` units, if there are any.
    fn covariance(&self, reciprocal: Option<&[M::Real]>, dense: &mut [M::Real]);

    /// The trace of P.
    fn trace(&self) -> M::Real;

    /// Goes on in other units, for which there must be room: θ ← S θ and P ← S P S with
    /// S = diag(`ratios`).
    fn change_units(&mut self, ratios: &[M::Real]);

    /// Whether its state is one that samples can have led to.
    fn is_sound(&self) -> bool;

    /// Shows every number of the state to `visitor`.
    fn visit(&mut self, visitor: &mut dyn Visitor<M::Real>);
}

/// What a member brought of a sample, beside its errors.
#[derive(Clone, Copy, Debug)]
pub struct Brought<T> {
    /// φ̄P̄φ̄ᵀ
    pub leverage: T,
    /// λ
    pub forgetting_factor: T,
    /// why the sample was left out, if it was
    pub skipped: Option<Skip>,
    /// what its gate said
    pub gate: Answer,
    /// whether P has wound up
    pub windup: bool,
}

/// The members of a bank, of the same sizes; and the types of what is kept about them.
pub trait Members: Clone + Debug + Send + Sync {
    /// The number type.
    type Real: Kernels;
    /// The sizes of a sample.
    type Memory: Memory<Real = Self::Real>;
    /// Sizes with K in the place of n, for a mixer.
    type Weighed: Memory<Real = Self::Real>;
    /// One of them.
    type Member: Member<Self::Memory>;
    /// Numbers, as many of each member.
    type Numbers: Buffer<Self::Real>;
    /// Whether each of them does something.
    type Flags: Buffer<bool>;
    /// The noise variance of each target, or none.
    type NoiseVariances: Buffer<NoiseVariance<Self::Real>>;

    /// Whether samples may have several rows, and so a matrix Γ: what they need is compiled only then.
    const SEVERAL_ROWS: bool;

    /// Those that `next` gives, so many of them.
    ///
    /// # Errors
    /// Those of `next`, and of members that cannot be one bank.
    fn gather(
        count: usize,
        next: impl FnMut() -> Result<Self::Member, Error>,
    ) -> Result<Self, Error>;

    /// K
    fn count(&self) -> usize;

    /// The sizes of a sample.
    fn memory(&self) -> Self::Memory;

    /// K as the sizes that a mixer is made for.
    fn weighed(&self) -> Self::Weighed;

    /// Whether some samples are trusted less than others.
    fn is_weighted(&self) -> bool;

    /// `each` zeros a member.
    fn numbers(&self, each: usize) -> Self::Numbers;

    /// True for each member.
    fn flags(&self) -> Self::Flags;

    /// So many that are not known.
    fn noise_variances(&self, count: usize) -> Self::NoiseVariances;

    /// The members, to be updated one by one.
    fn each(&mut self) -> &mut [Self::Member];

    /// Shows every member as it is, with its number.
    fn visit_each(&self, visit: impl FnMut(usize, &Self::Member));

    /// Shows every number of all states to `visitor`.
    fn visit(&mut self, visitor: &mut dyn Visitor<Self::Real>);

    /// θ of the mixture of n parameters and one or more targets, in the units of the members.
    fn theta(&self, weights: &[Self::Real], theta: &mut [Self::Real]);
}

/// Σ w_i θ_i, one member after the other.
pub(crate) fn mix<M: Memory, E: Member<M>>(
    members: &[E],
    weights: &[M::Real],
    theta: &mut [M::Real],
) {
    if let [only] = members {
        return theta.copy_from_slice(only.theta());
    }
    theta.fill(M::Real::ZERO);
    for (member, &weight) in members.iter().zip(weights) {
        if weight > M::Real::ZERO {
            add_scaled(theta, weight, member.theta());
        }
    }
}

impl<M: Memory> Member<M> for Named<M> {
    #[inline]
    fn take(
        &mut self,
        elapsed: M::Real,
        (phi, y): (&[M::Real], &[M::Real]),
        noise: Noise<'_, M::Real>,
        errors: &mut [M::Real],
    ) -> Result<Brought<M::Real>, Error> {
        let update = self.update_after(elapsed, phi, y, noise)?;
        errors.copy_from_slice(update.error);
        Ok(Brought {
            leverage: update.leverage,
            forgetting_factor: update.forgetting_factor,
            skipped: update.skipped,
            gate: update.gate,
            windup: update.windup,
        })
    }

    fn reset(&mut self) {
        self.reset();
    }

    fn theta(&self) -> &[M::Real] {
        self.theta()
    }

    fn covariance(&self, reciprocal: Option<&[M::Real]>, dense: &mut [M::Real]) {
        let mut factor = self.factor().clone();
        if let Some(reciprocal) = reciprocal {
            factor.express(reciprocal);
        }
        factor.reconstruct(dense);
    }

    fn trace(&self) -> M::Real {
        self.factor().trace()
    }

    fn change_units(&mut self, ratios: &[M::Real]) {
        self.change_units(ratios);
    }

    fn is_sound(&self) -> bool {
        self.is_sound()
    }

    fn visit(&mut self, visitor: &mut dyn Visitor<M::Real>) {
        self.visit(visitor);
    }
}
