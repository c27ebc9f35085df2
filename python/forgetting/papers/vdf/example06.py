"""Example 6 and Figure 5: how fast θ_k converges, with and without forgetting."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from matplotlib.figure import Figure

import forgetting as fg

from ..claim import Finding, claim
from ..path import Path, follow
from ..picture import figure_of, legend_below, panels, picture
from .systems import Array, finite_response

FACTORS = (1.0, 0.95, 0.9)
STARTS = (0.01, 1.0, 100.0)
"""The paper's values of λ and P_0 are lost with the figure; these are ours."""
SAMPLES = {1.0: 100_000, 0.95: 600, 0.9: 300}


@lru_cache(maxsize=16)
def case(factor: float, start: float) -> tuple[Array, Path]:
    """‖θ̃_k‖ and the path, from θ_0 = 0 and P_0 = start I."""
    samples = SAMPLES[factor]
    phi, y, theta = finite_response(samples)
    rule = fg.rule("exponential", forgetting_factor=factor)
    every = max(1, samples // 1000)
    path = follow(rule, phi, y, initial_covariance=start, every=every)
    return np.linalg.norm(path.theta - theta, axis=1), path


def slope(x: Array, y: Array) -> float:
    """Slope of the least-squares line."""
    return float(np.polyfit(x, y, 1)[0])


@claim("VDF Figure 5 d)", "λ = 1: slope −1 between log ‖θ̃_k‖ and log k, O(1/k)")
def without_forgetting() -> Finding:
    """Over the last two decades, for every P_0."""
    k = np.unique(np.logspace(3, 5, 200).astype(int))
    found = [slope(np.log(k), np.log(case(1.0, start)[0][k])) for start in STARTS]
    words = ", ".join(f"{value:.3f}" for value in found)
    return f"slopes {words} for P₀ = 0.01, 1, 100", max(abs(value + 1) for value in found) < 0.02


@claim("VDF Figure 5 b, c)", "λ < 1: slope log λ between log ‖θ̃_k‖ and k, O(λ^k)")
def with_forgetting() -> Finding:
    """Over the straight part, above rounding."""
    found = {}
    for factor in FACTORS[1:]:
        error = case(factor, 1.0)[0]
        k = np.flatnonzero(error > 1e-13 * error[0])
        found[factor] = slope(k[50:].astype(float), np.log(error[k[50:]])) / np.log(factor)
    words = ", ".join(f"{value:.3f} log λ for λ = {factor}" for factor, value in found.items())
    return words, max(abs(value - 1) for value in found.values()) < 0.05


@claim("VDF Example 6", "as λ decreases, convergence is faster and κ(P_k) degrades")
def faster_and_worse() -> Finding:
    """Samples to an error of 1e-3 and median condition number after them."""
    needed = [int(np.argmax(case(factor, 1.0)[0] < 1e-3)) for factor in FACTORS]
    condition = [float(np.median(case(factor, 1.0)[1].condition[100:])) for factor in FACTORS]
    measured = f"λ = 1, 0.95, 0.9: error 1e-3 after {needed} samples, median κ "
    measured += ", ".join(f"{value:.2f}" for value in condition)
    ordered = needed == sorted(needed, reverse=True) and condition == sorted(condition)
    return measured, ordered


@claim("VDF Example 6", "as λ decreases, the effect of P₀ is reduced")
def start_matters_less() -> Finding:
    """Spread of log10 κ over the three P_0 after 100 samples, in the same units of P."""
    spread = []
    for factor in FACTORS:
        steps = [case(factor, start)[1] for start in STARTS]
        values = [p.values[int(np.searchsorted(p.samples, 100)), 0] for p in steps]
        spread.append(float(max(values) / min(values) - 1))
    words = ", ".join(f"{value:.1g}" for value in spread)
    measured = f"largest eigenvalue of P at k = 100 differs by {words} of itself over P₀"
    return measured, spread == sorted(spread, reverse=True)


@picture(
    "vdf_figure_05",
    "VDF Figure 5",
    "Example 6. Parameter error (above; log–log for λ = 1, where the slope is −1) and condition "
    "number of P_k (below) for three λ and P₀ = 0.01 I, I and 100 I. White input, θ₀ = 0.",
)
def figure() -> Figure:
    """One column a factor."""
    titles = [f"{what}, λ = {f:g}" for what in ("‖θ̃‖", "κ(P)") for f in FACTORS]
    axes = panels(2, 3, titles, height=2.2)
    for column, factor in enumerate(FACTORS):
        for start in STARTS:
            error, path = case(factor, start)
            axes[column].plot(np.arange(1, len(error)), error[1:])
            axes[3 + column].plot(path.samples[1:], path.condition[1:], label=f"P₀ = {start:g} I")
        axes[column].set(yscale="log", xlabel="k", xscale="log" if factor == 1 else "linear")
        axes[3 + column].set(yscale="log", xlabel="k", xscale="log" if factor == 1 else "linear")
        axes[3 + column].set(ylim=(0.8, 100))
    legend_below(axes[4], 3)
    return figure_of(axes)
