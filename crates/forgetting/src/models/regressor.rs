//! The regressor φ and the gradient ψ, as they stand in the signals.

use super::orders::{Layout, Orders};
use super::signals::Signals;
use core::ops::Range;

/// φ: what the prediction is made of.
pub(super) fn phi(regressor: &mut [f64], (orders, layout): (&Orders, &Layout), signals: &Signals) {
    put(regressor, &layout.a, signals.y.from(0, orders.na));
    put(regressor, &layout.c, signals.residual.from(0, orders.nc));
    put(regressor, &layout.d, signals.v.from(0, orders.nd));
    for (i, own) in orders.inputs.iter().enumerate() {
        put(regressor, &layout.b[i], signals.inputs[i].u.from(own.nk, own.nb));
        put(regressor, &layout.f[i], signals.inputs[i].w.from(0, own.nf));
    }
    regressor[layout.constant.clone()].fill(1.0);
}

/// ψ: the gradient of the prediction.
pub(super) fn psi(regressor: &mut [f64], (orders, layout): (&Orders, &Layout), signals: &Signals) {
    put(regressor, &layout.a, signals.y_white.from(0, orders.na));
    put(regressor, &layout.c, signals.residual_filtered.from(0, orders.nc));
    put(regressor, &layout.d, signals.v_filtered.from(0, orders.nd));
    for (i, own) in orders.inputs.iter().enumerate() {
        put(regressor, &layout.b[i], signals.inputs[i].u_filtered.from(own.nk, own.nb));
        put(regressor, &layout.f[i], signals.inputs[i].w_filtered.from(0, own.nf));
    }
    regressor[layout.constant.clone()].fill(signals.one_white.newest());
}

fn put(regressor: &mut [f64], place: &Range<usize>, values: &[f64]) {
    regressor[place.clone()].copy_from_slice(values);
}

/// The product of a regressor and θ.
pub(super) fn product(regressor: &[f64], theta: &[f64]) -> f64 {
    regressor.iter().zip(theta).map(|(x, c)| x * c).sum()
}
