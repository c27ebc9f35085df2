"""When to trust the estimate: what is excited, and what went wrong when."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from forgetting.plot.bars import bars, excited_directions, excited_parameters
from forgetting.plot.style import ORANGE, PURPLE, SKY, VERMILLION, axes_or_new
from forgetting.plot.timeline import label_time, timeline
from forgetting.record.identification import Identification
from forgetting.record.trace import DEAD_ZONE, FROZEN, HELD, MISSING, WITHIN_BOUND


def rank(found: Identification, ax: Axes | None = None) -> Axes:
    """Draw how many directions the samples in the rule's memory excite, over time."""
    ax = axes_or_new(ax)
    x, label = timeline(found)
    excited_directions(found.excited, ax, x)
    label_time(ax, x, label)
    return ax


def excited(found: Identification, ax: Axes | None = None, most: int = 24) -> Axes:
    """Draw a bar for each parameter while the samples in the rule's memory excite it."""
    ax = axes_or_new(ax)
    x, label = timeline(found)
    excited_parameters(found.excited, ax, found.samples.regressors, x, most)
    ax.set_title("Parameters that they excite")
    label_time(ax, x, label)
    return ax


def alarms(found: Identification, ax: Axes | None = None) -> Axes:
    """Draw bars where P wound up and where samples were left out or frozen; windup always."""
    ax = axes_or_new(ax)
    x, label = timeline(found)
    trace = found.trace
    rows = {
        "windup": (trace.windup, VERMILLION),
        "missing": (trace.skipped == MISSING, ORANGE),
        "dead zone": (trace.skipped == DEAD_ZONE, PURPLE),
        "within bound": (trace.skipped == WITHIN_BOUND, PURPLE),
        "held by the gate": (trace.skipped == HELD, PURPLE),
        "frozen by the gate": (trace.gate == FROZEN, SKY),
    }
    shown = {name: row for name, row in rows.items() if name == "windup" or np.any(row[0])}
    bars(
        {name: where for name, (where, _) in shown.items()},
        ax,
        x,
        {name: colour for name, (_, colour) in shown.items()},
    )
    ax.set_title("Alarms and samples left out")
    label_time(ax, x, label)
    return ax
