//! What a sample adds to P along each eigenvector of P, kept until the next sample comes.

use super::growth::Growth;
use crate::covariance::spectrum::Spectrum;
use crate::covariance::Factor;
use crate::error::Error;
use crate::memory::state::{is_finite, State, Visitor};
use crate::memory::Memory;
use crate::rules::Step;
use forgetting_kernels::kernel::functions::{add_scaled, dot};
use forgetting_kernels::Real;

/// What the last sample adds to P.
#[derive(Clone, Debug)]
pub struct Pending<M: Memory> {
    spectrum: Spectrum<M>,
    /// the weight w_i of each eigenvector
    added: M::Vector,
    /// the components z_i of what was measured along the eigenvectors
    measured: M::Vector,
}

impl<M: Memory> Pending<M> {
    /// Nothing.
    pub fn new(memory: M) -> Self {
        Self { spectrum: Spectrum::new(memory), added: memory.vector(), measured: memory.vector() }
    }

    /// Takes note that P has changed otherwise, while what is still to be added has not.
    pub fn lose_sight(&mut self) {
        self.spectrum.discard();
    }

    /// Lets go of what is still to be added.
    pub fn clear(&mut self) {
        self.spectrum.discard();
        self.added.as_mut().fill(M::Real::ZERO);
    }

    /// Takes note of what this sample adds to P.
    pub fn note(&mut self, growth: Growth<M::Real>, factor: &Factor<M>) {
        self.spectrum.follow(factor);
        for (added, &r) in self.added.as_mut().iter_mut().zip(self.spectrum.information()) {
            *added = growth.added(M::Real::ONE / r);
        }
    }

    /// Takes note of the row that is measured.
    pub fn measure(&mut self, row: &[M::Real]) {
        self.spectrum.project(row, self.measured.as_mut());
    }

    /// Adds to P what the last sample adds; returns the number of directions.
    pub fn add(&mut self, step: &mut Step<'_, '_, M>) -> Result<usize, Error> {
        let Self { spectrum, added, .. } = self;
        let total = added.as_ref().iter().fold(M::Real::ZERO, |sum, &x| sum + x);
        let mut rank = 0;
        if total > M::Real::ZERO {
            step.factor.reserve(M::Real::ONE, total)?;
            let mut room = total;
            for (i, &weight) in added.as_ref().iter().enumerate() {
                if weight > M::Real::ZERO {
                    spectrum.widen(i, (weight, &mut room), step.factor, step.work.gain.as_mut());
                    rank += 1;
                }
            }
        }
        if self.spectrum.is_known() {
            self.follow(step.work.gain.as_mut());
        }
        Ok(rank)
    }

    /// The spectrum of P after it was measured and added to; uses n numbers `row`.
    ///
    /// What was measured before the addition is, after it, a measurement of another row:
    /// (P₊ + Σ w_i v_i v_iᵀ)⁻¹ = Σ v_i v_iᵀ/(p_i + w_i) + uᵀu with
    /// u = Σ z_i p_i/(p_i + w_i) v_i/√(1 + Σ z_i² p_i w_i/(p_i + w_i)), by the matrix inversion
    /// lemma: P₊ = P − P z zᵀ P/(1 + zᵀ P z).
    fn follow(&mut self, row: &mut [M::Real]) {
        let Self { spectrum, added, measured } = self;
        let (one, mut variance) = (M::Real::ONE, M::Real::ONE);
        for (i, (&w, z)) in added.as_ref().iter().zip(measured.as_mut()).enumerate() {
            let p = one / spectrum.information()[i];
            let kept = p / (p + w);
            variance = (*z * *z).mul_add(kept * w, variance);
            *z *= kept;
            spectrum.set_information(i, one / (p + w));
        }
        row.fill(M::Real::ZERO);
        for (i, &z) in measured.as_ref().iter().enumerate() {
            add_scaled(row, z / variance.sqrt(), spectrum.vector(i));
        }
        spectrum.learn(row);
    }
}

impl<M: Memory> State<M::Real> for Pending<M> {
    fn visit(&mut self, visitor: &mut dyn Visitor<M::Real>) {
        self.spectrum.visit(visitor);
        visitor.reals(self.added.as_mut());
        visitor.reals(self.measured.as_mut());
    }

    fn is_sound(&self) -> bool {
        let (added, measured) = (self.added.as_ref(), self.measured.as_ref());
        let total = added.iter().fold(M::Real::ZERO, |sum, &x| sum + x);
        is_finite(self)
            && added.iter().all(|&x| x >= M::Real::ZERO)
            && total <= M::Real::CEILING
            && dot(measured, measured) <= M::Real::CEILING
            && (total == M::Real::ZERO && !self.spectrum.is_known() || self.spectrum.is_spectrum())
    }
}
