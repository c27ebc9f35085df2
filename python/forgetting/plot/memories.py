"""Which memory fitted when: the weights of a bank over time."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LinearSegmentedColormap, to_rgba
from matplotlib.ticker import LogLocator, NullFormatter, StrMethodFormatter
from numpy.typing import NDArray

from forgetting.plot.style import BLUE, VERMILLION, axes_or_new, legend_above
from forgetting.plot.timeline import label_time, timeline
from forgetting.record.identification import Identification
from forgetting.record.memories import Memories
from forgetting.words.duration import unit_for

Array = NDArray[np.float64]

COLUMNS = 400
"""Stretches of time in the picture."""


def memories(found: Identification, ax: Axes | None = None) -> Axes:
    """Draw how far a bank believes in each memory, over time, on a logarithmic axis.

    Members with about the same memory are one band. Beside samples stands time, where the record
    has a clock.

    Parameters
    ----------
    found : Identification
        Of the bank.
    ax : Axes, optional
        Where to draw.

    Raises
    ------
    ValueError
        For the identification of a single rule.
    """
    if found.memories is None:
        raise ValueError(f"memories are those of a bank, but the rule is {found.rule_in_words}")
    ax = axes_or_new(ax)
    x, label = timeline(found)
    known = found.memories
    rows, weights, typical = thinned(known)
    times = x[np.concatenate([[0], rows])]
    centres, weights = merged(known.samples, weights)
    blue = to_rgba(BLUE)[:3]
    colours = LinearSegmentedColormap.from_list("weight", [(*blue, 0.0), (*blue, 0.9)])
    # an image in the picture: one rectangle each would be most of a page
    ax.pcolormesh(times, edges(centres), weights.T, cmap=colours, vmin=0, vmax=1, rasterized=True)
    ax.plot(x[rows], typical, color=VERMILLION, lw=1.4, label="memory in the middle of the weights")
    ax.set_yscale("log")
    ax.yaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
    ax.set_ylabel("memory (samples)")
    if known.step is not None:
        add_time(ax, known.step)
    label_time(ax, x, label)
    legend_above(ax, 1)
    return ax


def thinned(known: Memories) -> tuple[NDArray[np.int64], Array, Array]:
    """Rows, weights and middle memories, each the mean of a stretch."""
    count = len(known.rows)
    length = max(1, -(-count // COLUMNS))
    starts = np.arange(0, count, length)
    sizes = np.diff(np.append(starts, count))
    weights = np.add.reduceat(known.weights, starts) / sizes[:, np.newaxis]
    typical = np.exp(np.add.reduceat(np.log(known.typical), starts) / sizes)
    return known.rows[starts + sizes - 1], weights, typical


def merged(samples: Array, weights: Array, near: float = 1.3) -> tuple[Array, Array]:
    """Memories, rising, and their weights, (K, bands): members closer than `near` are one."""
    order = np.argsort(samples)
    first = np.flatnonzero(np.diff(np.log(samples[order]), prepend=-np.inf) > np.log(near))
    sizes = np.diff(np.append(first, len(order)))
    centres = np.exp(np.add.reduceat(np.log(samples[order]), first) / sizes)
    return centres, np.add.reduceat(weights[:, order], first, axis=1)


def edges(centres: Array) -> Array:
    """Where the bands meet, on a logarithmic axis; the outer ones are as high as their neighbours.

    Examples
    --------
    >>> edges(np.array([1.0, 100.0])).round(1).tolist()
    [0.1, 10.0, 1000.0]
    """
    logs = np.log(centres)
    if len(logs) == 1:
        return np.asarray(np.exp(logs[0] + np.array([-0.5, 0.5])))
    inner = (logs[1:] + logs[:-1]) / 2
    ends = (2 * logs[0] - inner[0], 2 * logs[-1] - inner[-1])
    return np.asarray(np.exp(np.concatenate([ends[:1], inner, ends[1:]])))


def add_time(ax: Axes, step: float) -> None:
    """A second axis on the right, in time."""
    low, high = ax.get_ylim()
    size, unit = unit_for(float(np.sqrt(low * high)) * step)

    def in_time(samples: Any) -> Any:
        return samples * (step / size)

    def in_samples(time: Any) -> Any:
        return time / (step / size)

    other = ax.secondary_yaxis("right", functions=(in_time, in_samples))
    other.set_ylabel(f"memory ({unit})")
    other.yaxis.set_major_locator(LogLocator(numticks=6))
    other.yaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
    other.yaxis.set_minor_formatter(NullFormatter())
