"""Example 5 and Figure 4: the condition number of P_k tells whether φ is persistently exciting."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from forgetting.plot.style import BLUE, VERMILLION

from ..claim import Finding, claim
from ..picture import figure_of, group, legend_below, panels, picture, two_groups, wide
from .fifth import INFORMED, growth, run, windows

SAMPLES, EVERY = 3000, 10
LONG = 300_000
FORGETTING = 0.99


@claim("VDF Example 5", "the smallest singular value of F_{j,j+20} is essentially zero")
def not_exciting() -> Finding:
    """After the start has died away, six are not zero and four are."""
    values = windows(SAMPLES)[30:]
    measured = f"sixth ≥ {values[:, 5].min():.1g}, seventh ≤ {values[:, 6].max():.1g}"
    return measured, bool(values[:, 5].min() > 1e-8 and values[:, 6].max() < 1e-15)


@claim(
    "VDF Figure 4 b)",
    "λ = 1: six singular values of P_k decrease, none exceeds P₀'s",
    reason="The sixth direction receives 1e-8 a sample; it takes 1e5 samples to see it fall.",
)
def six_decrease() -> Finding:
    """The other four stay where the start left them."""
    path = run("exponential", 1.0, LONG, LONG // 2)
    change = path.values[-1] / path.values[1]
    measured = (
        f"from k = {LONG // 2} to {LONG} six fall to {change[4:].max():.2f} of themselves or "
    )
    measured += f"less, four to {change[:4].min():.3f} or more"
    falls = bool((change[4:] < 0.92).all() and (change[:4] > 0.99).all())
    return measured, falls and bool(path.values.max() <= 1 + 1e-12)


@claim("VDF Figure 4 d)", "λ = 0.99: six singular values of P_k remain bounded, the rest diverge")
def four_diverge() -> Finding:
    """The four grow by 1/λ a sample."""
    path = run("exponential", FORGETTING, SAMPLES, EVERY)
    each = growth(path.values, path.samples, 1500, 2500)
    measured = f"four grow by {each[:4].min():.5f} to {each[:4].max():.5f} a sample; six by "
    measured += f"{each[4:].min():.5f} to {each[4:].max():.5f}"
    diverge = bool((np.abs(each[:4] - 1 / FORGETTING) < 1e-4).all())
    return measured, diverge and bool((np.abs(each[4:] - 1) < 1e-3).all())


@claim("VDF Example 5", "λ = 0.99: P_k becomes ill-conditioned")
def ill_conditioned() -> Finding:
    """And grows more so for ever."""
    condition = run("exponential", FORGETTING, SAMPLES, EVERY).condition
    growing = bool((np.diff(condition[len(condition) // 2 :: 20]) > 0).all())
    return f"κ = {condition[-1]:.1g} at k = {SAMPLES}", growing and bool(condition[-1] > 1e14)


@picture(
    "vdf_figure_04",
    "VDF Figure 4",
    "Example 5. Singular values of F_{j,j+20}; singular values and condition number of P_k for "
    "λ = 1 and λ = 0.99. P₀ = I.",
)
def figure() -> Figure:
    """a) above, then one row a factor."""
    titles = ("F over 21 samples", "P, λ = 1", "κ(P), λ = 1", "P, λ = 0.99", "κ(P), λ = 0.99")
    axes = panels(3, 2, (titles[0], "", *titles[1:]), height=2.1)
    axes.pop(1).remove()
    wide(axes[0])
    values = np.maximum(windows(SAMPLES), 1e-36)
    starts = np.arange(len(values)) * 10
    group(axes[0], starts, values[:, :INFORMED], BLUE, "first six", width=0.8)
    group(axes[0], starts, values[:, INFORMED:], VERMILLION, "last four", width=0.8)
    axes[0].set(yscale="log", xlabel="j")
    for left, right, factor in ((axes[1], axes[2], 1.0), (axes[3], axes[4], FORGETTING)):
        path = run("exponential", factor, SAMPLES, EVERY)
        two_groups(left, path.samples, path.values, INFORMED, "")
        right.semilogy(path.samples, path.condition, color=BLUE)
        left.set_xlabel("k")
        right.set_xlabel("k")
    for letter, title, ax in zip("abcde", titles, axes, strict=True):
        ax.set_title(f"{letter})  {title}")
    for ax in (axes[0], axes[1], axes[3]):
        legend_below(ax)
    return figure_of(axes)
