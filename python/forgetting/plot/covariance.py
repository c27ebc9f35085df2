"""How fast the rule forgets, and how far the covariance has moved."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from forgetting.analysis.plot import bounds
from forgetting.plot import thinning
from forgetting.plot.style import BLUE, FAINT, GREEN, PURPLE, VERMILLION, axes_or_new, legend_above
from forgetting.plot.timeline import label_time, timeline
from forgetting.record.identification import Identification
from forgetting.record.trace import USED


def eigenvalues(found: Identification, ax: Axes | None = None) -> Axes:
    """Draw the eigenvalues of P over time on a logarithmic axis, with the rule's bounds if near."""
    ax = axes_or_new(ax)
    x, label = timeline(found)
    values, times = found.trace.eigenvalues, x[found.trace.rows]
    for middle in values.T[1:-1]:
        ax.plot(times, middle, color=FAINT, lw=0.8, alpha=0.7)
    ax.plot(times, values[:, -1], color=VERMILLION, label="largest")
    if values.shape[1] > 1:
        ax.plot(times, values[:, 0], color=BLUE, label="smallest")
    ax.set_yscale("log")
    ax.set_ylabel("eigenvalues of P")
    bounds(found.guarantee, ax)
    label_time(ax, x, label)
    legend_above(ax, len(ax.get_legend_handles_labels()[0]))
    return ax


def forgetting_factor(found: Identification, ax: Axes | None = None) -> Axes:
    """Draw the forgetting factor of each sample; samples that were left out are marked."""
    ax = axes_or_new(ax)
    x, label = timeline(found)
    used = np.where(found.trace.skipped == USED, found.trace.forgetting_factor, np.nan)
    held = np.where(found.trace.skipped == USED, np.nan, 1.0)
    ax.plot(*thinning.line(x, used), color=GREEN, lw=1.6, label="learning", solid_capstyle="butt")
    if np.isfinite(held).any():
        ax.plot(
            *thinning.line(x, held),
            color=PURPLE,
            lw=3,
            label="left out: nothing forgotten",
            solid_capstyle="butt",
        )
    low = float(np.nanmin(used)) if np.isfinite(used).any() else 1.0
    ax.set_ylim(low - 0.15 * (1 - low) - 0.005, 1 + 0.15 * (1 - low) + 0.005)
    ax.set_ylabel("forgetting factor")
    label_time(ax, x, label)
    legend_above(ax, 2)
    return ax
