//! A model as it is while samples come: θ, the signals and what is made of them.
//!
//! With φ = [y(k−1) …, uᵢ(k−nk) …, ε(k−1) …, v(k−1) …, wᵢ(k−1) …, 1] the prediction is φθ, where
//!
//! wᵢ(k) = Σ b uᵢ(k−nk−j) + Σ f wᵢ(k−j), v(k) = y(k) − Σ a y(k−j) − Σᵢ wᵢ(k) − constant,
//! ε(k) = v(k) − Σ d v(k−j) − Σ c ε(k−j):
//!
//! every coefficient stands with a plus, so that a, d and f are those of 1 − a₁q⁻¹ − … and a pole of
//! first order is a₁; c is that of 1 + c₁q⁻¹ + …. The gradient of the prediction, ψ, is φ filtered by
//! D/C (y, the constant), D/(C Fᵢ) (uᵢ, wᵢ) and 1/C (ε, v): Ljung 1999, section 10.3. Extended least
//! squares takes φ in its place (Young 1968; Panuska 1969).
//!
//! θ stays where C and all Fᵢ are stable: the step to what the estimator says is halved until they are.

mod informed;
mod start;

use super::known::Known;
use super::linearised::Linearised;
use super::orders::{Layout, Orders};
use super::origin::Origin;
use super::regressor::{self, product};
use super::signals::{Filters, Signals};
use super::stable::is_stable;
use crate::error::Error;
use crate::memory::state::{shows_finite, Visitor};
use alloc::vec;
use alloc::vec::Vec;
use start::Start;

/// Halvings of a step after which θ stays where it is.
const HALVINGS: usize = 30;

/// What stands in the place of the regressor.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Method {
    /// ψ: the estimates are those of the least prediction error
    #[default]
    PredictionError,
    /// φ: needs no filters, and converges only where C is close enough to 1
    ExtendedLeastSquares,
}

/// A model while samples come.
#[derive(Clone, Debug)]
pub struct Polynomial {
    orders: Orders,
    method: Method,
    layout: Layout,
    known: Known,
    /// where the prediction is made linear: stable, and the estimate otherwise
    theta: Vec<f64>,
    origin: Origin,
    signals: Signals,
    filters: Filters,
    samples: u64,
    /// samples until all lags are measured
    incomplete: u64,
    start: Start,
    /// whether all signals are of a size that can be gone on with
    sound: bool,
    phi: Vec<f64>,
    candidate: Vec<f64>,
    work: Vec<f64>,
}

impl Polynomial {
    /// At rest, with θ = 0.
    ///
    /// # Errors
    /// Those of [`Orders::check`].
    pub fn new(orders: Orders, method: Method) -> Result<Self, Error> {
        orders.check()?;
        let (n, layout) = (orders.parameters(), orders.layout());
        let mut model = Self {
            signals: Signals::new(&orders),
            origin: Origin::new(orders.inputs.len(), orders.constant),
            incomplete: orders.reach() as u64,
            known: Known::nothing(n),
            theta: vec![0.0; n],
            phi: vec![0.0; n],
            candidate: vec![0.0; n],
            work: Vec::new(),
            filters: Filters::default(),
            samples: 0,
            start: Start::after(0, n),
            sound: true,
            orders,
            method,
            layout,
        };
        model.set_filters();
        Ok(model)
    }

    /// Its orders.
    #[must_use]
    pub fn orders(&self) -> &Orders {
        &self.orders
    }

    /// What stands in the place of the regressor.
    #[must_use]
    pub fn method(&self) -> Method {
        self.method
    }

    /// θ, n numbers: as the estimator said it, or where C and F are still stable on the way there. The
    /// constant is that of signals measured from their first values.
    #[must_use]
    pub fn theta(&self) -> &[f64] {
        &self.theta
    }

    /// The same with the constant of signals as they are, written to `theta`.
    pub fn express(&self, theta: &mut [f64]) {
        theta.copy_from_slice(&self.theta);
        self.origin.express(theta, &self.layout);
    }

    /// Samples so far.
    #[must_use]
    pub fn samples(&self) -> u64 {
        self.samples
    }

    /// Forgets all signals, as before the first sample; θ stays.
    pub fn rest(&mut self) {
        self.signals.clear();
        self.sound = true;
        self.incomplete = self.orders.reach() as u64;
    }

    /// Takes the inputs of the next sample, NaN for one that is missing; writes n numbers to `psi`.
    pub fn regress(&mut self, inputs: &[f64], psi: &mut [f64]) -> Linearised {
        for (i, &value) in inputs.iter().enumerate() {
            let signals = &mut self.signals.inputs[i];
            if value.is_nan() {
                // held, as nothing better is known
                let reach = (self.orders.inputs[i].nk + self.orders.inputs[i].nb) as u64;
                self.incomplete = self.incomplete.max(reach);
            }
            let value = match value.is_nan() {
                true => signals.u.newest(),
                false => self.origin.input(i, value),
            };
            self.sound &= signals.push_input(value, &self.filters, &self.filters.f[i]);
        }
        self.sound &= self.signals.push_one(&self.filters);
        let form = (&self.orders, &self.layout);
        regressor::phi(&mut self.phi, form, &self.signals);
        match self.method {
            Method::PredictionError => regressor::psi(psi, form, &self.signals),
            Method::ExtendedLeastSquares => psi.copy_from_slice(&self.phi),
        }
        let prediction = product(&self.phi, &self.theta);
        let origin = self.origin.of_output();
        let estimated = self.theta.iter().zip(&self.known.values).map(|(own, known)| own - known);
        Linearised {
            prediction: prediction + origin,
            shift: psi.iter().zip(estimated).map(|(x, c)| x * c).sum::<f64>() - prediction - origin,
            scale: if self.orders.is_linear() { 1.0 } else { self.start.scale() },
            complete: self.incomplete == 0 && self.origin.is_known(),
        }
    }

    /// Takes the output of the sample, NaN if it is missing, and what the estimator then says of θ.
    pub fn observe(&mut self, y: f64, theta: &[f64]) {
        let y = self.origin.output(y);
        self.follow(theta);
        self.samples += 1;
        self.incomplete = self.incomplete.saturating_sub(1);
        self.set_filters();
        let parts = self.push_parts();
        let explained = self.signals.y.filtered(&self.theta[self.layout.a.clone()], 0);
        let known =
            explained + parts + self.theta[self.layout.constant.clone()].iter().sum::<f64>();
        let past_v = self.signals.v.filtered(&self.theta[self.layout.d.clone()], 0);
        let past_e = self.signals.residual.filtered(&self.theta[self.layout.c.clone()], 0);
        let predictable = past_v + past_e;
        // where the output is missing, the prediction stands for it
        let missing = y.is_nan();
        let v = if missing { predictable } else { y - known };
        let y = if missing { known + predictable } else { y };
        if missing {
            self.incomplete = self.incomplete.max(self.orders.na as u64);
        }
        self.sound &= self.signals.push_output((y, v, v - predictable), &self.filters);
        if !self.sound {
            self.rest();
        }
    }

    /// Shows all that the next sample needs to `visitor`.
    pub fn visit(&mut self, visitor: &mut dyn Visitor<f64>) {
        visitor.reals(&mut self.theta);
        visitor.whole(&mut self.samples);
        visitor.whole(&mut self.incomplete);
        self.origin.visit(visitor);
        self.signals.visit(visitor);
        self.set_filters();
    }

    /// Whether this is a state that samples can have led to.
    #[must_use]
    pub fn is_sound(&self) -> bool {
        let mut model = self.clone();
        let finite = shows_finite(|visitor| model.signals.visit(visitor));
        let theta = core::mem::take(&mut model.theta);
        finite && theta.iter().all(|x| x.is_finite()) && model.keeps_stable(&theta)
    }

    /// wᵢ of this sample: their sum.
    fn push_parts(&mut self) -> f64 {
        let mut sum = 0.0;
        for (i, signals) in self.signals.inputs.iter_mut().enumerate() {
            let (b, f) = (self.layout.b[i].clone(), self.layout.f[i].clone());
            let forced = signals.u.filtered(&self.theta[b], self.orders.inputs[i].nk);
            let part = forced + signals.w.filtered(&self.theta[f], 0);
            self.sound &= signals.push_part(part, &self.filters, &self.filters.f[i]);
            sum += part;
        }
        sum
    }

    /// Goes to `theta`, or as far as C and F are stable.
    fn follow(&mut self, theta: &[f64]) {
        let mut step = 1.0;
        let mut candidate = core::mem::take(&mut self.candidate);
        candidate.copy_from_slice(theta);
        for _ in 0..HALVINGS {
            if self.keeps_stable(&candidate) {
                core::mem::swap(&mut self.theta, &mut candidate);
                break;
            }
            step /= 2.0;
            for ((own, &old), &new) in candidate.iter_mut().zip(&self.theta).zip(theta) {
                *own = old + step * (new - old);
            }
        }
        self.candidate = candidate;
    }

    /// Whether C and all F are stable with this θ.
    fn keeps_stable(&mut self, theta: &[f64]) -> bool {
        let Self { layout, work, .. } = self;
        is_stable(&theta[layout.c.clone()], 1.0, work)
            && layout.f.iter().all(|f| is_stable(&theta[f.clone()], -1.0, work))
    }

    fn set_filters(&mut self) {
        self.start = Start::after(self.samples, self.theta.len());
        self.filters.set(&self.theta, &self.layout, self.start.contraction());
    }
}
