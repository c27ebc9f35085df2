"""The streams of a fleet as one Arrow table."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from forgetting.tables.columns import arrow
from forgetting.tables.outputs import times
from forgetting.tables.pages import PAGE
from forgetting.tables.streams import Streams

Whole = NDArray[np.int64]

FORMAT = 1
"""The version of the table; that of the states is among their own bytes."""
ABOUT, FRESH = b"forgetting.tables", b"forgetting.tables.fresh"
COLUMNS = ("key", "state", "time", "taken", "rows", "missing", "late", "lags")


def to_arrow(streams: Streams, keys: list[Any] | None) -> Any:
    """The table of all streams, or of those of some keys; see `TableFleet.to_arrow`."""
    if keys is None:
        return arrow().concat_tables(parts(streams))
    handed_on = streams.refused_rows
    if absent := [key for key in keys if key not in streams.keys and key not in handed_on]:
        raise KeyError(absent[0])
    there = [key for key in keys if key in streams.keys]
    at = np.array([streams.keys[key] for key in there], dtype=np.int64)
    own = _part(streams, at, there, [streams.pages[i].to_bytes() for i in at.tolist()])
    rows = [handed_on[key].cast(own.schema) for key in keys if key in handed_on]
    return arrow().concat_tables([own, *rows])


def parts(streams: Streams) -> Iterator[Any]:
    """The table of all streams in parts of a page each, so that it need not be whole in memory."""
    listed = streams.keys.listed()
    empty = _part(streams, np.empty(0, dtype=np.int64), [], [])
    yield empty
    for page, fleet in enumerate(streams.pages.fleets):
        at = np.arange(page * PAGE, page * PAGE + len(fleet))
        yield _part(streams, at, listed[at[0] : at[-1] + 1], fleet._states()[1:])
    for row in streams.refused_rows.values():
        yield row.cast(empty.schema)


def _part(streams: Streams, at: Whole, keys: list[Any], states: list[bytes]) -> Any:
    """A row for each of these streams."""
    pa = arrow()
    columns: dict[str, Any] = {
        "key": pa.array(keys, type=streams.keys.type),
        "state": pa.array(states, type=pa.large_binary()),
        "time": times(streams, streams.seen, at),
        "taken": times(streams, streams.taken, at),
    }
    columns |= {name: pa.array(count.values[at]) for name, count in streams.counts.items()}
    table = pa.table(columns | {"lags": _lags(streams, at)})
    return table.replace_schema_metadata({ABOUT: about_of(streams), FRESH: streams.fresh})


def about_of(streams: Streams) -> str:
    """What must agree between fleets that exchange streams, besides the state of a new one."""
    about = {"format": FORMAT, "by_clock": streams.by_clock, **streams.model.to_dict()}
    return json.dumps(about, sort_keys=True)


def _lags(streams: Streams, at: Whole) -> Any:
    """The last rows of each stream as a list of numbers."""
    pa = arrow()
    if streams.lags is None:
        return pa.nulls(len(at), type=pa.list_(pa.float64()))
    kept = streams.lags.kept.values[at]
    offsets = np.arange(len(at) + 1) * int(np.prod(kept.shape[1:]))
    return pa.ListArray.from_arrays(
        pa.array(offsets, pa.int32()), pa.array(kept.ravel(), from_pandas=True)
    )
