"""How fast the rule forgets, how far P has moved, and where it wound up."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from forgetting.analysis import Guarantee, Windup
from forgetting.plot import thinning
from forgetting.plot.bars import shade
from forgetting.plot.style import (
    BLUE,
    FAINT,
    GREEN,
    ORANGE,
    PURPLE,
    VERMILLION,
    axes_or_new,
    labelled,
    legend_above,
)
from forgetting.plot.timeline import label_time, timeline
from forgetting.record.identification import Identification
from forgetting.record.trace import USED

NEAR = 1e3
"""A bound further beyond the range of the axes than this factor would flatten what they show."""


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
    guaranteed_bounds(found.guarantee, ax)
    label_time(ax, x, label)
    legend_above(ax, len(ax.get_legend_handles_labels()[0]))
    return ax


def forgetting_factor(found: Identification, ax: Axes | None = None) -> Axes:
    """Draw the forgetting factor of each sample, or a bank's memory; marks what is left out."""
    if found.trace.memory is not None:
        return memory(found, ax)
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


def memory(found: Identification, ax: Axes | None = None) -> Axes:
    """Draw over how many samples a bank remembers, after each sample."""
    ax = axes_or_new(ax)
    x, label = timeline(found)
    samples = np.zeros(0) if found.trace.memory is None else found.trace.memory
    ax.plot(*thinning.line(x, np.where(np.isfinite(samples), samples, np.nan)), color=GREEN, lw=1.6)
    ax.set_yscale("log")
    ax.set_ylabel("memory (samples)")
    label_time(ax, x, label)
    return ax


def windup(found: Windup, ax: Axes | None = None) -> Axes:
    """Draw how far the variance of silent directions has grown, and where that is windup."""
    ax = labelled(ax, "growth since last informed", "sample")
    ax.semilogy(found.samples, found.path, color=BLUE)
    ax.axhline(found.factor, color=VERMILLION, ls="--", lw=0.9, label="windup above")
    shade(ax, found.samples, found.path > found.factor, ORANGE, "windup")
    ax.legend()
    return ax


def guaranteed_bounds(found: Guarantee, ax: Axes) -> Axes:
    """Draw the bounds that the rule guarantees, where they are near what the axes show."""
    low, high = ax.get_ylim()
    for value, colour, label in (
        (found.upper, VERMILLION, "guaranteed upper bound"),
        (found.lower, BLUE, "guaranteed lower bound"),
    ):
        if value is not None and low / NEAR < value < high * NEAR:
            ax.axhline(value, color=colour, ls="--", lw=1.0, label=label)
    return ax
