"""The time column: ticks that can be compared, and how many of them are a unit of time."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from forgetting._core import InvalidInput
from forgetting.tables.columns import arrow, column
from forgetting.words.errors import first_line

PER_SECOND = {"s": 1.0, "ms": 1e3, "us": 1e6, "ns": 1e9}


@dataclass(frozen=True)
class Ticks:
    """The times of a batch.

    Attributes
    ----------
    values : (rows,) ndarray of int64 or float64
        The times, as numbers of their own type; what stands for a missing one is arbitrary.
    missing : (rows,) ndarray of bool
        Where there is none.
    type : pyarrow.DataType
        The type of the column.
    per_unit : float
        Ticks in a second for dates and durations; 1 for numbers.
    """

    values: NDArray[Any]
    missing: NDArray[np.bool_]
    type: Any
    per_unit: float


def ticks(table: Any, name: str, before: Any) -> Ticks:
    """The times of a table, in the type of those before.

    Parameters
    ----------
    table : pyarrow.Table
    name : str
    before : pyarrow.DataType or None
        The type of the first batch's times: all others are compared with these.

    Raises
    ------
    forgetting.InvalidInput
        When the column holds neither numbers nor dates nor durations, is infinite, or cannot
        be said in the type of before without loss.
    """
    pa, found = arrow(), column(table, name)
    own = comparable(found.type, name)
    wanted = before if before is not None else own
    if sort(own) != sort(wanted):
        raise InvalidInput(f"time column {name!r} holds {found.type} where {wanted} came before")
    try:
        found = found if found.type == wanted else found.cast(wanted)
    except pa.ArrowException as error:
        raise InvalidInput(
            f"time column {name!r} holds {found.type} where {wanted} came before: "
            f"{first_line(error)}"
        ) from None
    missing = np.asarray(found.is_null(nan_is_null=True).to_numpy(zero_copy_only=False))
    whole = not pa.types.is_floating(wanted)
    raw = found.cast(pa.int64()) if whole else found
    filled = raw.fill_null(0) if raw.null_count else raw
    values = filled.to_numpy(zero_copy_only=False)
    if not whole and np.isinf(values).any():
        row = int(np.flatnonzero(np.isinf(values))[0])
        raise InvalidInput(f"time column {name!r} is infinite in row {row}, allowed: finite times")
    return Ticks(values, missing, wanted, per_unit(wanted))


def comparable(kind: Any, name: str) -> Any:
    """The type in which times of this type are compared."""
    pa = arrow()
    if pa.types.is_integer(kind):
        return pa.int64()
    if pa.types.is_floating(kind) or pa.types.is_decimal(kind) or pa.types.is_null(kind):
        return pa.float64()
    if pa.types.is_date(kind):
        return pa.timestamp("s")
    if pa.types.is_timestamp(kind) or pa.types.is_duration(kind):
        return kind
    allowed = "numbers, dates and times, or durations"
    raise InvalidInput(f"time column {name!r} holds {kind}, allowed: {allowed}")


def sort(kind: Any) -> str:
    """What times are of a sort that can be compared; local times and instants are not."""
    local = hasattr(kind, "tz") and kind.tz is None
    return f"{type(kind).__name__} {local}" if hasattr(kind, "unit") else "number"


def per_unit(kind: Any) -> float:
    """Ticks in a unit of time: a second where the type has units, else the unit of the numbers."""
    return PER_SECOND[kind.unit] if hasattr(kind, "unit") else 1.0
