"""Example 10 and Figure 9: the information-rich subspace under uniform forgetting."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from forgetting.plot.style import BLUE, INK, VERMILLION

from ..claim import Finding, claim
from ..picture import figure_of, group, legend_below, panels, picture
from .fifth import INFORMED, growth, information_content, run
from .systems import fifth_order

SAMPLES, EVERY = 2500, 5
FACTORS = (1.0, 0.9, 0.8)
"""The paper's values are lost with the figure, except 0.9 and 0.8 (Figure 10)."""


@claim("VDF Example 10", "six relatively large components of ψ_k: the subspace has dimension six")
def six_components() -> Finding:
    """The other four hold nothing but rounding once windup has set them apart."""
    words, clear = [], True
    for factor in FACTORS[1:]:
        path = run("exponential", factor, SAMPLES, EVERY)
        content = information_content(path, fifth_order(SAMPLES)[0])[100:]
        peak = content.max(axis=0)
        words.append(f"λ = {factor}: six ≥ {peak[4:].min():.0e}, four ≤ {peak[:4].max():.0e}")
        clear &= bool(peak[4:].min() > 1e4 * peak[:4].max())
    return "; ".join(words), clear


@claim("VDF Example 10", "λ < 1: the other singular values of P_k⁻¹ converge to zero")
def four_vanish() -> Finding:
    """They decay by λ a sample, down to the rounding of the regressor."""
    words, decay = [], True
    for factor in FACTORS[1:]:
        path = run("exponential", factor, SAMPLES, EVERY)
        each = 1 / growth(path.values, path.samples, 100, 200)
        words.append(f"λ = {factor}: four decay by {each[:4].min():.4f} to {each[:4].max():.4f}")
        decay &= bool((np.abs(each[:4] - factor) < 2e-3).all()) and path.values[-1, 3] > 1e20
    return "; ".join(words), bool(decay)


@picture(
    "vdf_figure_09",
    "VDF Figure 9",
    "Example 10. Information content of ψ_k (above) and singular values of P_k⁻¹ (below) for "
    "λ = 1, 0.9 and 0.8; inverse of the condition number in black. P₀ = I.",
)
def figure() -> Figure:
    """One column a factor."""
    titles = [f"{what}, λ = {f:g}" for what in ("|ψ|", "P⁻¹") for f in FACTORS]
    axes = panels(2, 3, titles, height=2.4)
    draw_content(axes, "exponential", FACTORS, SAMPLES)
    return figure_of(axes)


def draw_content(
    axes: list[Axes], rule: str, factors: tuple[float, ...], samples: int, **parameters: float
) -> None:
    """Information content above, singular values of the inverse below."""
    columns = len(factors)
    for column, factor in enumerate(factors):
        path = run(rule, factor, samples, EVERY, **parameters)
        content = information_content(path, fifth_order(samples)[0])
        curves = ((path.samples[:-1], np.maximum(content, 1e-22)), (path.samples, 1 / path.values))
        for ax, (k, values) in zip((axes[column], axes[columns + column]), curves, strict=True):
            # Where uniform forgetting does not sort the directions, the content does.
            ordered = np.sort(values, axis=1)
            group(ax, k, ordered[:, 4:], BLUE, f"largest {INFORMED}", width=0.7)
            group(ax, k, ordered[:, :4], VERMILLION, "other 4", width=0.7)
            ax.set(yscale="log", xlabel="k")
        inverse = axes[columns + column]
        inverse.plot(path.samples, 1 / path.condition, color=INK, label="1/κ(P)")
    legend_below(axes[columns + columns // 2], 3)
