"""The streams of a fleet as one Arrow table."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
from numpy.typing import NDArray

from forgetting.tables.columns import arrow
from forgetting.tables.outputs import times
from forgetting.tables.streams import Streams

Whole = NDArray[np.int64]

FORMAT = 1
"""The version of the table; that of the states is among their own bytes."""
ABOUT, FRESH = b"forgetting.tables", b"forgetting.tables.fresh"
COLUMNS = ("key", "state", "time", "taken", "rows", "missing", "late", "lags")


def to_arrow(streams: Streams, keys: list[Any] | None) -> Any:
    """The table of all streams, or of those of some keys; see `TableFleet.to_arrow`."""
    handed_on = streams.refused_rows
    if keys is not None:
        if absent := [key for key in keys if key not in streams.keys and key not in handed_on]:
            raise KeyError(absent[0])
        handed_on = {key: handed_on[key] for key in keys if key in handed_on}
    own = _own(streams, keys)
    table = arrow().concat_tables([own, *(row.cast(own.schema) for row in handed_on.values())])
    return table.replace_schema_metadata({ABOUT: about_of(streams), FRESH: streams.fresh})


def _own(streams: Streams, keys: list[Any] | None) -> Any:
    """A row for each stream."""
    pa, every = arrow(), streams.keys.listed()
    some = (
        range(len(every)) if keys is None else [streams.keys[k] for k in keys if k in streams.keys]
    )
    at = np.array(some, dtype=np.int64)
    columns: dict[str, Any] = {
        "key": pa.array([every[i] for i in at.tolist()], type=streams.keys.type),
        "state": _states(streams, None if keys is None else at),
        "time": times(streams, "seen").take(pa.array(at)),
        "taken": times(streams, "taken").take(pa.array(at)),
    }
    columns |= {name: pa.array(count.values[at]) for name, count in streams.counts.items()}
    return pa.table(columns | {"lags": _lags(streams, at)})


def about_of(streams: Streams) -> str:
    """What must agree between fleets that exchange streams, besides the state of a new one."""
    about = {"format": FORMAT, "by_clock": streams.by_clock, **streams.model.to_dict()}
    return json.dumps(about, sort_keys=True)


def _states(streams: Streams, at: Whole | None) -> Any:
    """The bytes of these streams; of all, page by page."""
    pa, kind = arrow(), arrow().large_binary()
    if at is not None:
        return pa.array([streams.pages[i].to_bytes() for i in at.tolist()], type=kind)
    parts = [pa.array(fleet._states()[1:], type=kind) for fleet in streams.pages.fleets]
    return pa.chunked_array(parts, type=kind)


def _lags(streams: Streams, at: Any) -> Any:
    """The last rows of each stream as a list of numbers."""
    pa = arrow()
    if streams.lags is None:
        return pa.nulls(len(at), type=pa.list_(pa.float64()))
    kept = streams.lags.kept.values[at].reshape(len(at), -1)
    offsets = np.arange(len(at) + 1) * kept.shape[1]
    return pa.ListArray.from_arrays(
        pa.array(offsets, pa.int32()), pa.array(kept.ravel(), from_pandas=True)
    )
