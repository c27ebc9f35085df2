"""Example 12 and Figure 11: variable-direction forgetting keeps θ_k and P_k bounded."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from forgetting.plot.style import BLUE

from ..claim import Finding, claim
from ..path import Path
from ..picture import figure_of, legend_below, panels, picture, two_groups
from .example09 import EVERY, FACTOR, SAMPLES, TRUTH, error_norm
from .example11 import THRESHOLD
from .fifth import INFORMED, run


def path() -> Path:
    """As Example 9, with variable-direction forgetting."""
    return run("variable_direction", FACTOR, SAMPLES, EVERY, threshold=THRESHOLD)


@claim("VDF Example 12", "θ̃_k does not converge to zero, z_k does")
def error_stays() -> Finding:
    """z_k falls to rounding."""
    error, z = error_norm(path().theta), np.abs(path().error)
    measured = f"‖θ̃‖ = {error[-1]:.4f}; |z| ≤ {z[-1000:].max():.0e} in the last 1000 samples"
    return measured, bool(error[-1] > 0.1 and z[-1000:].max() < 1e-9)


@claim("VDF Figure 11", "all singular values of P_k remain bounded, and θ_k is bounded")
def all_bounded() -> Finding:
    """The largest stands still over the second half."""
    largest = path().values[:, 0]
    half = largest[len(largest) // 2 :]
    error = error_norm(path().theta).max()
    measured = f"largest {largest.max():.3g}, second half × {half.max() / half.min():.4f}; "
    measured += f"‖θ̃‖ ≤ {error:.3f}; κ(P) ≤ {path().condition.max():.0e}"
    start = float(np.linalg.norm(TRUTH))
    return measured, bool(half.max() / half.min() < 1.01 and error <= start * (1 + 1e-9))


@picture(
    "vdf_figure_11",
    "VDF Figure 11",
    "Example 12. Predicted error, parameter error, singular values and condition number of P_k "
    "with variable-direction forgetting. λ = 0.999, ε = 1e-8, P₀ = I, θ₀ = 0.",
)
def figure() -> Figure:
    """As Figure 7."""
    axes = panels(2, 2, ("|z|", "‖θ̃‖", "P", "κ(P)"), height=2.6)
    found = path()
    axes[0].plot(np.arange(0, SAMPLES, 20), np.abs(found.error[::20]).clip(1e-18), color=BLUE)
    axes[1].plot(np.arange(0, SAMPLES + 1, 20), error_norm(found.theta)[::20], color=BLUE)
    two_groups(axes[2], found.samples, found.values, INFORMED, "")
    axes[3].plot(found.samples, found.condition, color=BLUE)
    for ax in axes:
        ax.set(yscale="log", xlabel="k")
    axes[1].set(yscale="linear", ylim=(0, 1.5))
    legend_below(axes[2])
    return figure_of(axes)
