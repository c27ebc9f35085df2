"""Example 9 and Figure 7: finite precision without excitation, in two forms of one recursion."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from forgetting.plot.style import BLUE, VERMILLION

from ..claim import Finding, claim
from ..picture import figure_of, legend_below, panels, picture, two_groups
from .covariance_form import covariance_form
from .fifth import INFORMED, growth, run
from .systems import DENOMINATOR, NUMERATOR, Array

SAMPLES, EVERY = 40_000, 200
FACTOR = 0.999
TRUTH = np.array([*NUMERATOR, *DENOMINATOR])


def error_norm(theta: Array) -> Array:
    """‖θ̃_k‖."""
    with np.errstate(over="ignore"):
        return np.asarray(np.linalg.norm(theta - TRUTH, axis=1))


@claim("VDF Example 9", "θ̃_k does not converge to zero")
def error_stays() -> Finding:
    """It settles before rounding matters."""
    error = error_norm(run("exponential", FACTOR, SAMPLES, EVERY).theta)
    settled = abs(error[20_000] / error[15_000] - 1)
    return f"‖θ̃‖ = {error[20_000]:.4f} at k = 20000", bool(error[20_000] > 0.5 and settled < 1e-4)


@claim("VDF Example 9", "six singular values of P_k remain bounded, the rest diverge")
def six_bounded() -> Finding:
    """From the factor, where none is lost to rounding."""
    path = run("exponential", FACTOR, SAMPLES, EVERY)
    each = growth(path.values, path.samples, 20_000, 30_000)
    measured = f"four grow by {each[:4].min():.6f} a sample or more (1/λ = {1 / FACTOR:.6f}), "
    measured += f"six by {each[4:].max():.6f} or less"
    return measured, bool((np.abs(each[:4] - 1 / FACTOR) < 2e-5).all() and each[4:].max() < 1.00002)


@claim(
    "VDF Example 9, (4), (5)",
    "the computation becomes erroneous and θ_k diverges",
    reason="The covariance form, computed as printed in float64.",
)
def covariance_form_diverges() -> Finding:
    """First P loses its sign, then θ leaves."""
    theta, _, extremes = covariance_form(FACTOR, SAMPLES, EVERY)
    negative = int(np.argmax(extremes[:, 0] < 0) + 1) * EVERY
    lost = int(np.argmax(~(error_norm(theta) < 100)))
    measured = f"an eigenvalue of P is negative at k = {negative}; ‖θ̃‖ > 100 at k = {lost}"
    return measured, 0 < negative < lost < SAMPLES


@claim(
    "VDF Example 9, in this package",
    "(not in the paper) the same recursion on a factor of P",
    reason="Nothing is subtracted from U D Uᵀ, so P keeps its sign whatever its condition number.",
)
def factored_form_does_not() -> Finding:
    """The same samples, the same λ."""
    path = run("exponential", FACTOR, SAMPLES, EVERY)
    worst, late = error_norm(path.theta).max(), np.abs(path.error[1000:]).max()
    measured = f"‖θ̃‖ ≤ {worst:.3f} and |z| ≤ {late:.0e} after 1000 samples; κ(P) = "
    measured += f"{path.condition[-1]:.0e}"
    start = float(np.linalg.norm(TRUTH))
    positive = bool((path.values > 0).all())
    return measured, bool(worst <= start * (1 + 1e-12) and late < 1e-2 and positive)


@picture(
    "vdf_figure_07",
    "VDF Figure 7",
    "Example 9. Predicted error, parameter error, singular values and condition number of P_k for "
    "λ = 0.999, P₀ = I, θ₀ = 0. The covariance form, as printed, breaks down; the factored "
    "form of this package does not.",
)
def figure() -> Figure:
    """Both forms in every panel but c)."""
    axes = panels(2, 2, ("|z|", "‖θ̃‖", "P, factored", "κ(P)"), height=2.6)
    path = run("exponential", FACTOR, SAMPLES, EVERY)
    theta, z, extremes = covariance_form(FACTOR, SAMPLES, EVERY)
    for ax, ours, theirs in (
        (axes[0], np.abs(path.error), np.abs(z)),
        (axes[1], error_norm(path.theta), error_norm(theta)),
    ):
        ax.plot(theirs[::20].clip(1e-18, 1e30), color=VERMILLION, label="covariance form")
        ax.plot(ours[::20].clip(1e-18, 1e30), color=BLUE, label="factored")
        ax.set_xticks(np.arange(0, 2001, 500), [f"{k * 20}" for k in range(0, 2001, 500)])
    two_groups(axes[2], path.samples, path.values, INFORMED, "")
    when = np.arange(1, len(extremes) + 1) * EVERY
    axes[3].plot(when, np.abs(extremes[:, 1] / extremes[:, 0]), color=VERMILLION)
    axes[3].plot(path.samples, path.condition, color=BLUE)
    for ax in axes:
        ax.set(yscale="log", xlabel="k")
    legend_below(axes[0])
    legend_below(axes[1])
    legend_below(axes[2])
    return figure_of(axes)
