"""Bars over time where something holds, and how many directions are excited."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from forgetting.analysis import Excited
from forgetting.plot.style import BLUE, GREEN, VERMILLION, labelled, literal

BINS = 1200
"""Bins of a long record, at most about as many."""


def excited_directions(found: Excited, ax: Axes | None = None, x: Any = None) -> Axes:
    """Draw how many directions the last samples excite; `x` has a value for each sample."""
    ax = labelled(ax, "directions", "sample")
    at = found.samples if x is None else np.asarray(x)[found.samples]
    ax.step(at, found.rank, where="mid", color=GREEN)
    ax.fill_between(at, found.rank, step="mid", color=GREEN, alpha=0.15, lw=0)
    ax.set_ylim(0, found.parameters * 1.08)
    few = range(found.parameters + 1)
    ax.set_yticks(few if found.parameters < 4 else [0, found.parameters])
    ax.set_title(f"Directions of {found.parameters} that the last {found.window} samples excite")
    return ax


def excited_parameters(
    found: Excited,
    ax: Axes | None = None,
    names: Sequence[str] | None = None,
    x: Any = None,
    most: int = 24,
) -> Axes:
    """Draw a bar for each of the first `most` parameters while the last samples inform about it."""
    shown = min(found.parameters, most)
    labels = [f"parameter {i}" for i in range(shown)] if names is None else list(names[:shown])
    at = found.samples if x is None else np.asarray(x)[found.samples]
    rows = dict(zip(labels, found.informed.T[:shown], strict=True))
    return bars(rows, ax, at, dict.fromkeys(labels, BLUE))


def bars(
    rows: Mapping[str, Any],
    ax: Axes | None = None,
    x: Any = None,
    colours: Mapping[str, str] | None = None,
) -> Axes:
    """Draw bars above one another where something holds: its name, and a bool a sample.

    Bins of a long record are filled when it holds anywhere in them.
    """
    ax = labelled(ax, "", "sample")
    for place, (label, where) in enumerate(rows.items()):
        where = np.asarray(where, dtype=bool)
        at, held = binned(np.arange(len(where)) if x is None else x, where)
        colour = VERMILLION if colours is None else colours[label]
        ax.fill_between(at, place - 0.32, place + 0.32, where=held, step="post", color=colour, lw=0)
    ax.set_yticks(range(len(rows)), labels=list(map(literal, rows)))
    ax.set_ylim(len(rows) - 0.45, -0.55)
    ax.grid(visible=False, axis="y")
    return ax


def binned(x: Any, where: NDArray[np.bool_]) -> tuple[NDArray[Any], NDArray[np.bool_]]:
    """The edges of the bins of x; True where it holds anywhere in the bin."""
    x = np.asarray(x)
    step = max(1, -(-len(where) // BINS))
    starts = np.arange(0, len(where), step)
    held = np.logical_or.reduceat(where, starts) if len(where) else where
    last = x[-1:] + (x[-1:] - x[-2:-1]) if len(x) > 1 else x[-1:]
    return np.concatenate([x[starts], last]), np.append(held, held[-1:])


def shade(
    ax: Axes, x: NDArray[Any], where: NDArray[np.bool_], color: str, label: str | None = None
) -> None:
    """Shade the stretches of x in which something holds, each to the sample after it."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], where, [False]]).astype(np.int8)))
    for number, (start, stop) in enumerate(edges.reshape(-1, 2)):
        end = x[min(stop, len(x) - 1)]
        ax.axvspan(x[start], end, color=color, alpha=0.2, lw=0, label=None if number else label)
