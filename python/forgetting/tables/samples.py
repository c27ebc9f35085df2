"""The rows of a batch, in the order of streams and times, as samples of their estimators."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from forgetting.tables.clock import Ticks
from forgetting.tables.keys import Found
from forgetting.tables.order import Groups
from forgetting.tables.pages import Samples
from forgetting.tables.streams import NEVER, Streams

Array = NDArray[Any]


@dataclass(frozen=True)
class Batch:
    """What a table holds for a fleet.

    Attributes
    ----------
    table : pyarrow.Table
    keys : Found
    ticks : Ticks or None
    y : (rows,) ndarray
    phi : list of (rows,) ndarray
    """

    table: Any
    keys: Found
    ticks: Ticks | None
    y: Array
    phi: list[Array]


def samples_of(streams: Streams, batch: Batch, groups: Groups) -> tuple[Samples, Array | None]:
    """The samples of grouped rows, and the rows that are to be kept for lags."""
    dtype, model = np.dtype(streams.pages.new.dtype), streams.model
    phi = np.empty((len(batch.y), len(batch.phi) + model.offset), dtype=np.float64)
    for j, values in enumerate(batch.phi):
        phi[:, j] = values
    if model.offset:
        phi[:, -1] = 1.0
    phi, y, kept = phi.take(groups.rows, axis=0), batch.y.take(groups.rows), None
    if streams.lags is not None:
        signals = np.column_stack([y, phi[:, : len(batch.phi)]])
        breaks = _breaks(streams, batch, groups)
        lagged, kept = streams.lags.regressors(groups, signals, breaks)
        phi = np.column_stack([lagged, phi[:, len(batch.phi) :]])
    time, last = _times(streams, batch, groups)
    with np.errstate(over="ignore"):  # what float32 cannot hold is infinite, and is refused
        phi, y = phi.astype(dtype, copy=False), y.astype(dtype, copy=False)
    return Samples(groups, phi, y, time, last), kept


def _breaks(streams: Streams, batch: Batch, groups: Groups) -> NDArray[np.bool_]:
    """Rows that come too long after the one before them in their stream for lags to reach back."""
    breaks = np.zeros(len(groups.rows), dtype=bool)
    gap = streams.model.gap
    if gap is None or batch.ticks is None or streams.seen is None or not len(breaks):
        return breaks
    values, longest = batch.ticks.values[groups.rows], gap * batch.ticks.per_unit
    before = streams.seen.of(groups.streams)
    never = before == NEVER[before.dtype.kind]
    first = values[groups.starts]
    breaks[1:] = values[1:] - values[:-1] > longest
    breaks[groups.starts] = ~never & (first - np.where(never, first, before) > longest)
    return breaks


def _times(streams: Streams, batch: Batch, groups: Groups) -> tuple[Array | None, Array | None]:
    """When samples were taken, and the last ones before, in units of time; None without a clock.

    Whole ticks are counted from the first of the batch, so that no digit of a date is lost.
    """
    if batch.ticks is None or streams.taken is None:
        return None, None
    values = batch.ticks.values[groups.rows]
    before = streams.taken.of(groups.streams)
    never = before == NEVER[before.dtype.kind]
    origin = values.min() if values.dtype.kind == "i" and len(values) else 0
    last = (np.where(never, origin, before) - origin) / batch.ticks.per_unit
    return (values - origin) / batch.ticks.per_unit, np.where(never, np.nan, last)
