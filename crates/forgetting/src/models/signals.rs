//! The signals that regressors are taken from, and the filters between them.

use super::history::History;
use super::orders::{InputOrders, Layout, Orders};
use crate::memory::state::Visitor;
use alloc::vec::Vec;

/// The coefficients that filter: those of C, D and Fᵢ, the j-th times κʲ.
#[derive(Clone, Debug, Default)]
pub(super) struct Filters {
    pub c: Vec<f64>,
    pub d: Vec<f64>,
    pub f: Vec<Vec<f64>>,
}

impl Filters {
    /// Those of θ, contracted by κ.
    pub fn set(&mut self, theta: &[f64], layout: &Layout, kappa: f64) {
        contract(&mut self.c, &theta[layout.c.clone()], kappa);
        contract(&mut self.d, &theta[layout.d.clone()], kappa);
        self.f.resize(layout.f.len(), Vec::new());
        for (filter, f) in self.f.iter_mut().zip(&layout.f) {
            contract(filter, &theta[f.clone()], kappa);
        }
    }
}

fn contract(filter: &mut Vec<f64>, coefficients: &[f64], kappa: f64) {
    let mut power = 1.0;
    filter.resize(coefficients.len(), 0.0);
    for (own, c) in filter.iter_mut().zip(coefficients) {
        power *= kappa;
        *own = c * power;
    }
}

/// D/C x(k), from what stands one sample back in the histories of x and D/C x.
fn whitened(value: f64, filters: &Filters, (own, white): (&History, &History), lag: usize) -> f64 {
    value - own.filtered(&filters.d, lag) - white.filtered(&filters.c, 0)
}

/// An input, its part w of the output, and both through D/C and D/(C F).
#[derive(Clone, Debug)]
pub(super) struct InputSignals {
    pub u: History,
    u_white: History,
    pub u_filtered: History,
    pub w: History,
    w_white: History,
    pub w_filtered: History,
}

impl InputSignals {
    pub fn new(orders: InputOrders, nc: usize, nd: usize) -> Self {
        let InputOrders { nb, nf, nk } = orders;
        Self {
            u: History::of((nk + nb).max(nd + 1)),
            u_white: History::of(nc),
            u_filtered: History::of((nk + nb).max(nf).max(1)),
            w: History::of(nf.max(nd)),
            w_white: History::of(nc),
            w_filtered: History::of(nf),
        }
    }

    /// The input of the next sample; whether all is of a size that can be gone on with.
    pub fn push_input(&mut self, value: f64, filters: &Filters, f: &[f64]) -> bool {
        self.u.push(value);
        let white = whitened(value, filters, (&self.u, &self.u_white), 1);
        let filtered = white + self.u_filtered.filtered(f, 0);
        self.u_white.push(white);
        self.u_filtered.push(filtered);
        are_sound(&[white, filtered])
    }

    /// The part of the output that the input made; whether all is of a size that can be gone on with.
    pub fn push_part(&mut self, value: f64, filters: &Filters, f: &[f64]) -> bool {
        let white = whitened(value, filters, (&self.w, &self.w_white), 0);
        let filtered = white + self.w_filtered.filtered(f, 0);
        self.w.push(value);
        self.w_white.push(white);
        self.w_filtered.push(filtered);
        are_sound(&[value, white, filtered])
    }

    fn all(&mut self) -> [&mut History; 6] {
        [
            &mut self.u,
            &mut self.u_white,
            &mut self.u_filtered,
            &mut self.w,
            &mut self.w_white,
            &mut self.w_filtered,
        ]
    }
}

/// All signals of a model.
#[derive(Clone, Debug)]
pub(super) struct Signals {
    pub inputs: Vec<InputSignals>,
    pub y: History,
    pub y_white: History,
    /// v = A y − Σ w − constant, the noise
    pub v: History,
    /// v/C
    pub v_filtered: History,
    /// ε, the residual
    pub residual: History,
    /// ε/C
    pub residual_filtered: History,
    /// D/C 1
    pub one_white: History,
}

impl Signals {
    pub fn new(orders: &Orders) -> Self {
        let (na, nc, nd) = (orders.na, orders.nc, orders.nd);
        let inputs = orders.inputs.iter().map(|&own| InputSignals::new(own, nc, nd)).collect();
        Self {
            inputs,
            y: History::of(na.max(nd)),
            y_white: History::of(na.max(nc)),
            v: History::of(nd),
            v_filtered: History::of(nd.max(nc)),
            residual: History::of(nc),
            residual_filtered: History::of(nc),
            one_white: History::of(nc.max(1)),
        }
    }

    /// The constant of the next sample, through D/C.
    pub fn push_one(&mut self, filters: &Filters) -> bool {
        let past: f64 = filters.d.iter().sum();
        let white = 1.0 - past - self.one_white.filtered(&filters.c, 0);
        self.one_white.push(white);
        are_sound(&[white])
    }

    /// The output of a sample, its noise v and its residual ε; whether all is of a size that can be
    /// gone on with.
    pub fn push_output(&mut self, (y, v, residual): (f64, f64, f64), filters: &Filters) -> bool {
        let white = whitened(y, filters, (&self.y, &self.y_white), 0);
        let v_filtered = v - self.v_filtered.filtered(&filters.c, 0);
        let residual_filtered = residual - self.residual_filtered.filtered(&filters.c, 0);
        self.y.push(y);
        self.y_white.push(white);
        self.v.push(v);
        self.v_filtered.push(v_filtered);
        self.residual.push(residual);
        self.residual_filtered.push(residual_filtered);
        are_sound(&[y, v, residual, white, v_filtered, residual_filtered])
    }

    /// As before the first sample.
    pub fn clear(&mut self) {
        self.each(&mut History::clear);
    }

    pub fn visit(&mut self, visitor: &mut dyn Visitor<f64>) {
        self.each(&mut |history| history.visit(visitor));
    }

    fn each(&mut self, work: &mut dyn FnMut(&mut History)) {
        self.inputs.iter_mut().flat_map(InputSignals::all).for_each(&mut *work);
        let own = [
            &mut self.y,
            &mut self.y_white,
            &mut self.v,
            &mut self.v_filtered,
            &mut self.residual,
            &mut self.residual_filtered,
            &mut self.one_white,
        ];
        own.into_iter().for_each(work);
    }
}

/// The largest value that a signal may have: its square, times its count, is finite.
const LARGEST: f64 = 1e150;

fn are_sound(values: &[f64]) -> bool {
    values.iter().all(|x| x.abs() < LARGEST)
}
