"""Streams from a saved table: each state is checked, and a bad one stops no other."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from forgetting._core import Fleet, InvalidInput
from forgetting.extras import extra
from forgetting.tables.clock import ticks
from forgetting.tables.columns import PURPOSE, arrow, column
from forgetting.tables.keys import Found
from forgetting.tables.model import Model
from forgetting.tables.pages import PAGE
from forgetting.tables.state import ABOUT, COLUMNS, FORMAT, FRESH, about_of
from forgetting.tables.streams import NEVER, Streams
from forgetting.words.errors import first_line


def from_arrow(table: Any, threads: int | None) -> Streams:
    """The streams of a table; see `TableFleet.from_arrow`."""
    about = _read_about(table)
    by_clock = about.pop("by_clock")
    streams = Streams(Model.of(about), by_clock, table.schema.metadata[FRESH], threads)
    put(streams, table)
    return streams


def load(path: str, threads: int | None) -> Streams:
    """The streams of a file; see `TableFleet.load`."""
    parts = file_parts(path)
    streams = from_arrow(next(parts), threads)
    for part in parts:
        put(streams, part)
    return streams


def file_parts(path: str) -> Iterator[Any]:
    """The table of a file, first without rows, then the rows part by part."""
    pa = arrow()
    try:
        with extra("pyarrow.ipc", PURPOSE).open_file(path) as file:
            yield file.schema.empty_table()
            for number in range(file.num_record_batches):
                yield pa.Table.from_batches([file.get_batch(number)])
    except pa.ArrowException as error:
        raise InvalidInput(f"{path} is no state of a fleet: {first_line(error)}") from None


def _read_about(table: Any) -> dict[str, Any]:
    """What the metadata say of the fleet, checked."""
    metadata = table.schema.metadata or {}
    if ABOUT not in metadata or FRESH not in metadata:
        raise InvalidInput("table has no metadata of a fleet, allowed: what to_arrow has made")
    about: dict[str, Any] = json.loads(metadata[ABOUT])
    if (version := about.pop("format")) != FORMAT:
        raise InvalidInput(f"table has the format {version}, allowed: {FORMAT}")
    return about


def put(streams: Streams, table: Any) -> None:
    """Take over the streams of a table; see `TableFleet.put`."""
    pa, about = arrow(), _read_about(table)
    own = json.loads(about_of(streams))
    own.pop("format")
    if about != own or table.schema.metadata[FRESH] != streams.fresh:
        raise InvalidInput("table was saved by a fleet of other columns or another rule")
    if absent := [name for name in COLUMNS if name not in table.column_names]:
        raise InvalidInput(f"table has no column {absent[0]!r}, allowed: what to_arrow has made")
    checked = Checked(streams.fresh, table)
    good = table.filter(pa.array(checked.good)) if checked.reasons else table
    found = streams.keys.read(good, "key", {})
    if len(np.unique(found.rows)) < len(found.rows):
        raise InvalidInput("column 'key' of the table has a key twice, allowed: each once")
    kept = Kept(streams, good)
    for row, reason in checked.reasons.items():
        _refuse(streams, table.slice(row, 1), reason)
    count, only_new = len(streams.keys), len(found.added) == len(found.rows)
    if kept.ticks is not None:
        streams.keep_times(kept.ticks.type, kept.ticks.values.dtype)
    streams.start(found)
    if only_new and not checked.reasons and count % PAGE == 0:
        streams.pages.replace(count, checked.fleets)
    else:
        streams.pages.put(found.rows, good.column("state").to_pylist())
    kept.put(streams, found)


def _refuse(streams: Streams, row: Any, reason: str) -> None:
    """Note a row that has no good state; a stream that is there already goes on as it was."""
    key = row.column("key")[0].as_py()
    if key not in streams.keys:
        streams.keys.type = streams.keys.type or row.schema.field("key").type
        streams.refused[key], streams.refused_rows[key] = reason, row


class Checked:
    """The states of a table, each read once.

    Attributes
    ----------
    fleets : list of Fleet
        A page of streams each; complete where there are no reasons.
    reasons : dict of int to str
        Why the state of a row is refused.
    good : (rows,) ndarray of bool
    """

    def __init__(self, fresh: bytes, table: Any) -> None:
        self.fleets: list[Fleet] = []
        self.reasons: dict[int, str] = {}
        for first in range(0, len(table), PAGE):
            page = table.column("state").slice(first, PAGE).to_pylist()
            try:
                self.fleets.append(Fleet._of_states(fresh, page))
            except (InvalidInput, TypeError):
                self.reasons |= _reasons(fresh, page, first)
        self.good = np.ones(len(table), dtype=bool)
        self.good[list(self.reasons)] = False


def _reasons(fresh: bytes, states: list[Any], first: int) -> dict[int, str]:
    """Which states are refused, and why, one by one."""
    reasons = {}
    for row, state in enumerate(states, start=first):
        try:
            Fleet._of_states(fresh, [state])
        except InvalidInput as error:
            reasons[row] = str(error).removeprefix("stream 0: ")
        except TypeError:
            reasons[row] = "state: there is none"
    return reasons


class Kept:
    """Times, counts and lags of a table's streams, checked before anything changes."""

    def __init__(self, streams: Streams, table: Any) -> None:
        null = arrow().types.is_null
        self.ticks = self.taken = None
        if not null(table.schema.field("time").type):
            self.ticks = ticks(table, "time", streams.time_type)
            if streams.by_clock:
                self.taken = ticks(table, "taken", self.ticks.type)
        self.counts = {name: table.column(name).to_numpy() for name in streams.counts}
        self.lags: NDArray[np.float64] | None = None
        if streams.lags is not None:
            shape = streams.lags.kept.values.shape[1:]
            flat = column(table, "lags").flatten().to_numpy(zero_copy_only=False)
            if len(flat) != len(table) * int(np.prod(shape)):
                raise InvalidInput(f"column 'lags' must hold {int(np.prod(shape))} numbers a row")
            self.lags = flat.reshape(len(table), *shape)

    def put(self, streams: Streams, found: Found) -> None:
        """Write them over what the streams have."""
        for name, values in self.counts.items():
            streams.counts[name].values[found.rows] = values
        if streams.lags is not None and self.lags is not None:
            streams.lags.kept.values[found.rows] = self.lags
        for kept, read in ((streams.seen, self.ticks), (streams.taken, self.taken)):
            if kept is not None and read is not None:
                never = NEVER[kept.values.dtype.kind]
                kept.values[found.rows] = np.where(read.missing, never, read.values)
        for key in found.added:
            streams.refused.pop(key, None)
            streams.refused_rows.pop(key, None)
