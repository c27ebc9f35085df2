"""The horizontal axis: date-times, a time in seconds, or the row number."""

from __future__ import annotations

from typing import Any

import matplotlib.dates as mdates
import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from forgetting.plot.style import literal
from forgetting.record.clock.units import unit_of
from forgetting.record.identification import Identification

UNITS = ((2 * 86400.0, 86400.0, "days"), (2 * 3600.0, 3600.0, "hours"), (300.0, 60.0, "minutes"))


def timeline(found: Identification) -> tuple[NDArray[Any], str]:
    """Return x for every row and its label."""
    clock = found.samples.clock
    if clock is None or not clock.runs_forward:
        return np.arange(1, len(found.samples.y) + 1), "row of the record"
    if clock.is_datetime:
        values = clock.values
        naive = values.dt.tz_localize(None) if values.dt.tz is not None else values
        zone = "" if values.dt.tz is None else f" ({values.dt.tz})"
        return naive.to_numpy(), f"{clock.name}{zone}"
    unit = found.samples.found.units.get(clock.name)
    shown = clock.name if unit_of(clock.name, None) else f"{clock.name} ({unit or 's'})"
    return clock.values.to_numpy(dtype=np.float64), shown


def label_time(ax: Axes, x: NDArray[Any], label: str) -> None:
    """Label the horizontal axis; dates get short tick labels."""
    ax.set_xlabel(literal(label))
    ax.set_xlim(x[0], x[-1]) if len(x) > 1 else None
    if np.issubdtype(x.dtype, np.datetime64):
        locator = mdates.AutoDateLocator(minticks=4, maxticks=9)  # type: ignore[no-untyped-call]
        formatter = mdates.ConciseDateFormatter(locator)  # type: ignore[no-untyped-call]
        ax.xaxis.set_major_locator(locator)
        ax.xaxis.set_major_formatter(formatter)
