"""Example 8 and Figure 6: every regressor along one line."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import forgetting as fg
from forgetting.plot.style import BLUE, FAINT, ORANGE, VERMILLION

from ..claim import Finding, claim
from ..path import Path, follow
from ..picture import figure_of, panels, picture
from .systems import Array, constrained

SAMPLES = 1000
FACTORS = (1.0, 0.99)
TRUTH = np.array([0.4, 1.4])
ALONG, ACROSS = np.array([1.0, 1.0]) / np.sqrt(2), np.array([-1.0, 1.0]) / np.sqrt(2)


@lru_cache(maxsize=2)
def path(factor: float) -> Path:
    """P_0 = I, θ_0 = 0."""
    phi, y, _ = constrained(SAMPLES)
    return follow(fg.rule("exponential", forgetting_factor=factor), phi, y)


@claim("VDF Example 8, (16)", "θ_k lies in the subspace of the regressors")
def stays_on_the_line() -> Finding:
    """Distance from the line of [1, 1]."""
    off = max(float(np.abs(path(factor).theta @ ACROSS).max()) for factor in FACTORS)
    end = path(0.99).theta[-1]
    return f"off the line by {off:.1g}; ends at ({end[0]:.4f}, {end[1]:.4f})", off < 1e-12


@claim("VDF Figure 6 a)", "λ = 1: one singular value decreases to zero, the other is bounded")
def without_forgetting() -> Finding:
    """The bounded one is across the regressors."""
    last = path(1.0).values[-1]
    wanted = 1 / (1 + 2 * np.sum(np.sin(2 * np.pi * np.arange(SAMPLES) / 100) ** 2))
    gap = abs(last[1] / wanted - 1) + abs(last[0] - 1)
    return f"σ = {last[1]:.6f} (1/1001) and {last[0]:.6f} at k = 1000", gap < 1e-9


@claim("VDF Figure 6 b)", "λ = 0.99: one singular value is bounded, the other diverges")
def with_forgetting() -> Finding:
    """The diverging one is λ^-k."""
    last = path(0.99).values[-1]
    grown = last[0] * 0.99**SAMPLES
    measured = f"σ = {last[1]:.4f} and {last[0]:.4g} = {grown:.9f} λ⁻¹⁰⁰⁰"
    return measured, abs(grown - 1) < 1e-6 and bool(path(0.99).values[:, 1].max() < 1.05)


@claim(
    "VDF Figure 6",
    "θ̃_k converges along the singular vector of the bounded (λ = 1) or diverging (λ = 0.99) "
    "singular value",
)
def error_direction() -> Finding:
    """What is left of θ̃ is across the regressors; that is the larger singular value's vector."""
    cosines = []
    for factor in FACTORS:
        found = path(factor)
        error = found.theta[-1] - TRUTH
        cosines.append(abs(float(found.vectors[-1, :, 0] @ error) / float(np.linalg.norm(error))))
    words = " and ".join(f"{value:.8f}" for value in cosines)
    return f"|cosine| between the two: {words}", min(cosines) > 1 - 1e-5


def arrow(ax: Axes, vector: Array, color: str, label: str) -> None:
    """A vector from the origin."""
    ax.annotate(
        "", tuple(vector), (0, 0), arrowprops={"arrowstyle": "-|>", "color": color, "lw": 1.6}
    )
    ax.plot([], [], color=color, label=label)


@picture(
    "vdf_figure_06",
    "VDF Figure 6",
    "Example 8. Estimates (circles) and errors (squares), dark at k = 1 to light at k = 1000, with "
    "the singular vectors of P₁₀₀₀. Every estimate lies on the line of the regressors.",
)
def figure() -> Figure:
    """One panel a factor."""
    axes = panels(1, 2, [f"λ = {factor:g}" for factor in FACTORS], height=3.6)
    for ax, factor in zip(axes, FACTORS, strict=True):
        found, shades = path(factor), np.linspace(0, 1, SAMPLES)
        ax.axline((0, 0), (1, 1), color=FAINT, linestyle=":", label="regressors")
        for points, mark in ((found.theta[1:], "o"), (found.theta[1:] - TRUTH, "s")):
            ax.scatter(
                points[:, 0], points[:, 1], c=shades, cmap="viridis", marker=mark, s=16, zorder=3
            )
        ax.plot(*TRUTH, "*", color=VERMILLION, markersize=11, label="θ", linestyle="none")
        for i, color in ((1, BLUE), (0, ORANGE)):
            label = f"σ = {found.values[-1, i]:.3g}"
            vector = found.vectors[-1, :, i]
            arrow(ax, -vector * np.sign(vector[0]), color, label)
        ax.set(xlim=(-1.1, 1.6), ylim=(-1.6, 1.6), aspect="equal", xlabel="first component")
        ax.legend(loc="lower right", fontsize=8)
    axes[0].set_ylabel("second component")
    return figure_of(axes)
