"""A batch of rows: read and checked before anything changes, then taken."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from forgetting.tables.clock import ticks
from forgetting.tables.columns import numbers
from forgetting.tables.order import Groups, grouped
from forgetting.tables.samples import Batch, samples_of
from forgetting.tables.single import CODES
from forgetting.tables.streams import Streams

Array = NDArray[Any]

LATE = 254
"""The code of a row that is older than the last one of its stream; others as in `SKIPPED`."""


def read(streams: Streams, table: Any) -> Batch:
    """Everything that is needed of a table; see `TableFleet.update` for what is refused."""
    model = streams.model
    y, phi = numbers(table, model.y), [numbers(table, name) for name in model.phi]
    time = None if model.time is None else ticks(table, model.time, streams.time_type)
    return Batch(table, streams.keys.read(table, model.key, streams.refused), time, y, phi)


def take(streams: Streams, batch: Batch, outputs: tuple[str, ...]) -> dict[str, Array]:
    """Take the rows of a batch.

    Returns
    -------
    dict of str to ndarray
        The outputs, one row for each of the batch; always with "skipped".
    """
    if batch.ticks is not None and len(batch.y):
        streams.keep_times(batch.ticks.type, batch.ticks.values.dtype)
    streams.start(batch.keys)
    skipped = _left_out(streams, batch)
    rows = np.flatnonzero(skipped == 0)
    time = None if batch.ticks is None else batch.ticks.values[rows]
    groups = grouped(batch.keys.rows[rows], rows, time)
    groups = _without_late(streams, batch, groups, skipped)
    samples, kept = samples_of(streams, batch, groups)
    found = streams.pages.take(samples, _asked(outputs))
    skipped[groups.rows] = found.pop("skipped")
    _count(streams, batch, groups, skipped)
    _remember(streams, batch, groups, skipped, kept)
    told = {name: _in_order(groups, values, len(batch.y)) for name, values in found.items()}
    if "prediction" in outputs:
        with np.errstate(over="ignore"):
            y = batch.y.astype(told["error"].dtype, copy=False)
        told["prediction"] = y - told["error"]
    return told | {"skipped": skipped}


def _asked(outputs: tuple[str, ...]) -> tuple[str, ...]:
    """What the estimators are asked for."""
    own = set(outputs) - {"prediction"} | {"skipped"}
    return tuple(sorted(own | ({"error"} if "prediction" in outputs else set())))


def _left_out(streams: Streams, batch: Batch) -> NDArray[np.uint8]:
    """The codes of rows that go to no stream: no time, or a key without a good state."""
    codes = np.zeros(len(batch.y), dtype=np.uint8)
    if batch.ticks is not None and batch.ticks.missing.any():
        codes[batch.ticks.missing] = CODES["missing"]
    if streams.refused:
        codes[batch.keys.rows < 0] = CODES["refused"]
    return codes


def _without_late(
    streams: Streams, batch: Batch, groups: Groups, skipped: NDArray[np.uint8]
) -> Groups:
    if batch.ticks is None or streams.seen is None:
        return groups
    seen = streams.seen.of(groups.streams)
    if not (batch.ticks.values[groups.rows[groups.starts]] < seen).any():
        return groups  # nor are the others: they are in the order of time
    late = batch.ticks.values[groups.rows] < np.repeat(seen, groups.counts)
    skipped[groups.rows[late]] = LATE
    return groups.without(late)


def _count(streams: Streams, batch: Batch, groups: Groups, skipped: NDArray[np.uint8]) -> None:
    """The rows of each stream, and those of them that are late or missing."""
    streams.rows.values[groups.streams] += groups.counts
    others = np.flatnonzero((skipped == LATE) | (skipped == CODES["missing"]))
    others = others[batch.keys.rows[others] >= 0]
    of, late = batch.keys.rows[others], skipped[others] == LATE
    np.add.at(streams.late.values, of[late], 1)
    np.add.at(streams.missing.values, of[~late], 1)
    if batch.ticks is not None:
        np.add.at(streams.rows.values, of[late | batch.ticks.missing[others]], 1)


def _remember(
    streams: Streams, batch: Batch, groups: Groups, skipped: NDArray[np.uint8], kept: Array | None
) -> None:
    """The times and lags of each stream after a batch."""
    if streams.lags is not None and kept is not None:
        streams.lags.kept.values[groups.streams] = kept
    if batch.ticks is None or streams.seen is None or not len(groups.rows):
        return
    ends = groups.starts + groups.counts - 1
    streams.seen.values[groups.streams] = batch.ticks.values[groups.rows[ends]]
    if streams.taken is None:
        return
    left_out = np.isin(skipped[groups.rows], [CODES["missing"], CODES["refused"]])
    last = np.where(left_out, -1, np.arange(len(left_out)))
    last = np.maximum.reduceat(last, groups.starts)
    some = last >= 0
    streams.taken.values[groups.streams[some]] = batch.ticks.values[groups.rows[last[some]]]


def _in_order(groups: Groups, values: Array, rows: int) -> Array:
    """Grouped rows in the order of the batch; NaN where a row went to no stream."""
    found = np.full((rows, *values.shape[1:]), np.nan, dtype=values.dtype)
    found[groups.rows] = values
    return found
