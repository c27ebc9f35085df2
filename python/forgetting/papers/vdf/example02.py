"""Example 2 and Figure 1: persistent excitation and the bounds (25) of P_k⁻¹."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from matplotlib.figure import Figure

import forgetting as fg
from forgetting.analysis import Excitation, excitation
from forgetting.plot.style import BLUE, SKY

from ..claim import Finding, claim
from ..path import Path, follow
from ..picture import bound, figure_of, group, legend_below, panels, picture
from .systems import Array, three_sinusoids, two_lags

FACTOR = 0.99
PERIOD = 17 * 23 * 53
"""Samples after which the input repeats: what holds over one period holds for ever."""
SHOWN = 1000


@lru_cache(maxsize=1)
def regressors() -> Array:
    """φ over one period."""
    return two_lags(three_sinusoids(PERIOD + 20))


@lru_cache(maxsize=2)
def excited(window: int) -> Excitation:
    """F_{j,j+N} for N + 1 = window."""
    return excitation(regressors(), window=window)


@lru_cache(maxsize=1)
def path() -> Path:
    """P_0 = I (the paper does not say)."""
    phi = regressors()[:SHOWN]
    return follow(fg.rule("exponential", forgetting_factor=FACTOR), phi, np.zeros(SHOWN))


def bounds(last: int) -> tuple[float, float]:
    """Lower and upper bound (25) for N = last."""
    found, forgotten = excited(last + 1).tutorial, 1 - FACTOR ** (last + 1)
    lower = FACTOR**last * (1 - FACTOR) * found.alpha / forgotten
    return lower, found.beta / forgotten + 1 / path().values[last, -1]


@claim("VDF Example 2", "u of (27) is persistently exciting for N = 2 and N = 10")
def persistently_exciting() -> Finding:
    """Over a whole period of the input."""
    two, ten = excited(3).tutorial, excited(11).tutorial
    measured = f"α = {two.alpha:.3g}, β = {two.beta:.3g}; α = {ten.alpha:.3g}, β = {ten.beta:.3g}"
    return measured, excited(3).persistent and excited(11).persistent


@claim("VDF Figure 1", "α and β are larger for N = 10 than for N = 2")
def larger_window_larger_constants() -> Finding:
    """Both constants grow with the window."""
    two, ten = excited(3).tutorial, excited(11).tutorial
    measured = f"ratios {ten.alpha / two.alpha:.3g} and {ten.beta / two.beta:.3g}"
    return measured, ten.alpha > two.alpha and ten.beta > two.beta


@claim("VDF Example 2, (25)", "the singular values of P_k⁻¹ lie between the bounds for λ = 0.99")
def between_the_bounds() -> Finding:
    """For both N and all k >= N + 1 shown."""
    inside, words = True, []
    for last in (2, 10):
        lower, upper = bounds(last)
        information = 1 / path().values[last + 1 :]
        inside &= bool((information >= lower).all() and (information <= upper).all())
        words.append(f"N = {last}: {lower:.2g} to {upper:.3g}")
    seen = 1 / path().values[11:]
    return f"{'; '.join(words)}; seen {seen.min():.2g} to {seen.max():.3g}", inside


@picture(
    "vdf_figure_01",
    "VDF Figure 1",
    "Example 2. Singular values of F_{j,j+N} for N = 2 and 10, with α and β of (19) dashed, and of "
    "P_k⁻¹ for λ = 0.99, P₀ = I, with the bounds (25).",
)
def figure() -> Figure:
    """Three panels."""
    titles = ("F over 3 samples", "F over 11 samples", "P⁻¹, λ = 0.99")
    axes = panels(1, 3, titles, height=2.8)
    for ax, window in zip(axes, (3, 11), strict=False):
        found = excited(window)
        values = np.stack([found.smallest, found.largest], axis=1)[:SHOWN]
        group(ax, np.arange(SHOWN), values, BLUE, "smaller", width=0.9)
        bound(ax, [found.alpha, found.beta], "α, β")
        ax.set(yscale="log", xlabel="j")
    group(axes[2], path().samples, 1 / path().values[:, :], BLUE, "smaller", width=0.9)
    bound(axes[2], bounds(2), "(25), N = 2")
    bound(axes[2], bounds(10), "(25), N = 10", ":")
    axes[2].set(yscale="log", xlabel="k")
    for ax in axes:
        ax.lines[1].set(color=SKY, label="larger")
        legend_below(ax, 2 if ax is axes[2] else 3)
    return figure_of(axes)
