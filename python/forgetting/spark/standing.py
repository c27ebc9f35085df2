"""What is kept of a stream as a row of Spark: where it stands, and the bytes of its state."""

from __future__ import annotations

import json
from hashlib import sha256
from typing import Any

import pyarrow as pa

from forgetting._core import InvalidInput
from forgetting.tables import TableFleet
from forgetting.tables.clock import comparable
from forgetting.tables.state import ABOUT

OWN = ("state", "taken", "lags", "model")
"""What such a row has besides the columns of `TableFleet.estimates`."""
LATER = ("rows", "missing", "late")
"""Columns that `to_arrow` and `estimates` share."""


def standing(fleet: TableFleet, rows: Any = None) -> Any:
    """A row for each stream, also for those whose state was refused.

    Parameters
    ----------
    fleet : TableFleet
    rows : pyarrow.Schema, optional
        Types of the columns read, where the fleet has seen none yet.

    Returns
    -------
    pyarrow.Table
        key, time, rows, samples, missing, late, status and parameters of `TableFleet.estimates`,
        then state, taken and lags of `TableFleet.to_arrow`, and `model`: 16 digits that are equal
        where columns and rule are.
    """
    saved, told, model = fleet.to_arrow(), fleet.estimates(), fleet.model
    refused = len(saved) - len(told)
    columns = {name: _longer(told.column(name), refused) for name in told.column_names}
    columns |= {name: saved.column(name) for name in (*LATER, *OWN[:-1])}
    columns |= {model.key: saved.column("key"), str(model.time): saved.column("time")}
    if refused:
        words = told.column("status").to_pylist() + ["refused"] * refused
        columns["status"] = pa.chunked_array([pa.array(words, pa.string())])
    columns["model"] = pa.array([digest(fleet)] * len(saved), pa.string())
    return pa.table(columns).cast(_types(pa.table(columns).schema, fleet, rows))


def _longer(column: Any, rows: int) -> Any:
    """The column with nulls behind it."""
    return pa.chunked_array([*column.chunks, pa.nulls(rows, column.type)], column.type)


def _types(schema: Any, fleet: TableFleet, rows: Any) -> Any:
    """The types of Spark: no large binaries, instants in microseconds."""
    key, time = fleet.model.key, str(fleet.model.time)
    kinds = {field.name: field.type for field in schema}
    if rows is not None:
        kinds[key] = rows.field(key).type
        kinds[time] = comparable(rows.field(time).type, time)
    kinds[time] = _in_microseconds(kinds[time])
    kinds |= {"state": pa.binary(), "taken": kinds[time]}
    return pa.schema([(name, kinds[name]) for name in schema.names])


def _in_microseconds(kind: Any) -> Any:
    return pa.timestamp("us", kind.tz) if pa.types.is_timestamp(kind) else kind


def digest(fleet: TableFleet) -> str:
    """What is equal for fleets of equal columns and rules."""
    metadata = fleet.to_arrow([]).schema.metadata
    return sha256(b"".join(metadata[name] for name in sorted(metadata))).hexdigest()[:16]


def put(fleet: TableFleet, rows: Any) -> None:
    """Take over the streams that `standing` has told.

    Raises
    ------
    forgetting.InvalidInput
        When they are of another model.
    """
    if set(rows.column("model").unique().to_pylist()) - {digest(fleet)}:
        raise InvalidInput("state is of a fleet of other columns or another rule")
    own = fleet.to_arrow([]).schema
    names = {"key": fleet.model.key, "time": fleet.model.time}
    columns = {name: rows.column(names.get(name, name)) for name in own.names}
    columns["state"] = columns["state"].cast(pa.large_binary())
    if not json.loads(own.metadata[ABOUT])["by_clock"]:
        columns["taken"] = pa.nulls(len(rows))  # as to_arrow has it
    fleet.put(pa.table(columns).replace_schema_metadata(own.metadata))
