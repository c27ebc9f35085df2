"""Example 4 and Figure 3: z_k and θ_k converge, to wrong parameters, without excitation."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from matplotlib.figure import Figure

import forgetting as fg
from forgetting.analysis import excitation
from forgetting.plot.style import BLUE, SKY

from ..claim import Finding, claim, largest_gap
from ..path import Path, follow
from ..picture import bound, figure_of, group, panels, picture
from .systems import Array, first_order

SAMPLES = 8000
FACTOR = 0.999
INPUTS = {"u = 1": np.ones(SAMPLES), "u = (−1)ᵏ": (-1.0) ** np.arange(SAMPLES)}
LOST = (
    "The second input is lost: both are printed as u = 1. u = (−1)ᵏ is another input that excites "
    "one direction; a sinusoid would excite both."
)


@lru_cache(maxsize=2)
def case(name: str) -> tuple[Array, Path]:
    """φ and the path for P_0 = I, θ_0 = 0, λ = 0.999."""
    phi, y, _ = first_order(INPUTS[name])
    rule = fg.rule("exponential", forgetting_factor=FACTOR)
    return phi, follow(rule, phi, y, every=SAMPLES)


@claim("VDF Example 4", "z_k converges to zero though φ is not persistently exciting")
def error_vanishes() -> Finding:
    """With both inputs."""
    last = [float(np.abs(case(name)[1].error[-10:]).max()) for name in INPUTS]
    silent = [excitation(case(name)[0][20:], window=11).alpha for name in INPUTS]
    words = " and ".join(f"{value:.1g}" for value in last)
    weakest = f"{max(silent):.1g}"
    return f"|z| = {words} at the end; α = {weakest}", max(last) < 1e-6 and max(silent) < 1e-12


@claim("VDF Example 4, u = 1", "θ_k converges, not to the true (0.4, 0.8)")
def first_input() -> Finding:
    """The limit is the point of the line 2 θ_1 · (2/3) + θ_2 = 4/3 nearest to 0 in P_0."""
    theta = case("u = 1")[1].theta
    settled = largest_gap(theta[-1000], theta[-1])
    measured = f"({theta[-1, 0]:.4f}, {theta[-1, 1]:.4f})"
    return measured, settled < 1e-5 and largest_gap(theta[-1], [0.53609, 0.61855]) < 1e-4


@claim(
    "VDF Example 4, second input",
    "u = 1 again; θ_k converges to different parameter values, neither the true ones",
    verdict="corrected",
    reason=LOST,
)
def second_input() -> Finding:
    """u = 1 cannot give two limits."""
    first, second = case("u = 1")[1].theta, case("u = (−1)ᵏ")[1].theta
    settled = largest_gap(second[-1000], second[-1])
    measured = f"with u = (−1)ᵏ: ({second[-1, 0]:.4f}, {second[-1, 1]:.4f})"
    apart = min(np.linalg.norm(second[-1] - other) for other in (first[-1], [0.4, 0.8]))
    return measured, settled < 1e-4 and bool(apart > 0.1)


@picture(
    "vdf_figure_03",
    "VDF Figure 3",
    "Example 4. Singular values of F_{j,j+10}, predicted error and estimates for u = 1 (left) and "
    "u = (−1)ᵏ (right; the paper's second input is lost). True parameters dashed. λ = 0.999, "
    "P₀ = I, θ₀ = 0.",
)
def figure() -> Figure:
    """Two columns."""
    titles = [f"{what}, {name}" for what in ("F over 11 samples", "|z|", "θ") for name in INPUTS]
    axes = panels(3, 2, titles, height=1.9)
    for column, name in enumerate(INPUTS):
        phi, path = case(name)
        found = excitation(phi, window=11)
        values = np.stack([found.largest, np.maximum(found.smallest, 1e-17)], axis=1)[:100]
        group(axes[column], np.arange(100), values, BLUE, "larger")
        axes[column].lines[1].set(color=SKY, label="smaller")
        axes[column].set(yscale="log", xlabel="j")
        axes[column].legend(loc="center right", fontsize=8)
        axes[2 + column].semilogy(np.abs(path.error) + 1e-17, color=BLUE)
        axes[4 + column].plot(path.theta, label=["θ₁", "θ₂"])
        bound(axes[4 + column], [0.4, 0.8], "true")
        axes[4 + column].legend(loc="upper right", ncols=3, fontsize=8)
        for ax in axes[2 + column :: 2]:
            ax.set(xlabel="k", xlim=(0, 5000))
        axes[2 + column].set_ylim(1e-8, 3)
        axes[4 + column].set_ylim(-0.3, 1.35)
    return figure_of(axes)
