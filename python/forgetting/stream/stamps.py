"""The time column of a stream: numbers, or date-times of ISO 8601, told by its first cell."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
import pandas as pd
import pyarrow as pa
from numpy.typing import NDArray

from forgetting.record.clock import find_clock
from forgetting.record.clock.numeric import EPOCH
from forgetting.words.errors import RecordError

Array = NDArray[np.float64]

LONG = 15
"""Digits from which on a whole number is kept as one: a float64 would lose its last digits."""


@dataclass(frozen=True)
class Stamps:
    """How the cells of the time column are read.

    Attributes
    ----------
    name : str
        The column.
    kind : str
        "number", "whole", "local" (a date-time without a zone) or "zoned".
    scale : float
        Seconds of one unit of numbers.
    """

    name: str
    kind: str
    scale: float = 1.0

    @property
    def is_text(self) -> bool:
        """Whether the cells are date-times."""
        return self.kind in ("local", "zoned")

    @property
    def arrow(self) -> pa.DataType:
        """The type that the column is read as."""
        return {"number": pa.float64(), "whole": pa.int64()}.get(self.kind, pa.string())

    def state(self) -> dict[str, Any]:
        """As ``Stamps(**state)`` takes it."""
        return asdict(self)

    def ticks(self, column: pa.Array) -> tuple[NDArray[Any], NDArray[np.bool_]]:
        """Numbers of a column as it was read, and where there is one.

        Date-times become whole nanoseconds since 1970.

        Raises
        ------
        pyarrow.ArrowInvalid
            When a cell is no such date-time.
        """
        if self.is_text:
            zone = "UTC" if self.kind == "zoned" else None
            column = column.cast(pa.timestamp("ns", zone)).cast(pa.int64())
        known = ~np.asarray(column.is_null())
        values = column.fill_null(0).to_numpy(zero_copy_only=False)
        if self.kind == "number":
            known &= np.isfinite(values)
        return values, known

    def seconds(self, ticks: NDArray[Any], known: NDArray[np.bool_], start: Any) -> Array:
        """Seconds since `start`, NaN where there is no time."""
        scale = 1e-9 if self.is_text else self.scale
        elapsed = (ticks - start).astype(np.float64) * scale
        return np.where(known, elapsed, np.nan)


def find_stamps(
    first: Mapping[str, Any], named: str | None, units: Mapping[str, str] | None = None
) -> Stamps | None:
    """The time column, found in the first line as the clock of a record is.

    Parameters
    ----------
    first : mapping of str to value
        Cells of the first line: text, or values of JSON.
    named : str or None
        The column, "none" for no clock, None to look for one.
    units : mapping of str to str, optional
        Units of columns.

    Raises
    ------
    RecordError
        When the column holds a time that cannot be read before all of the column is known.

    Examples
    --------
    >>> find_stamps({"time_ms": "0.5", "x": "1"}, None)
    Stamps(name='time_ms', kind='number', scale=0.001)
    >>> find_stamps({"t": "2024-01-05T10:30:00Z", "x": "1"}, None).kind
    'zoned'
    """
    cells = {name: as_number(value) for name, value in first.items() if not nested(value)}
    clock = find_clock(pd.DataFrame([cells]), named, None, units or {}, "the stream")
    if clock is None:
        return None
    if clock.name not in cells:
        raise RecordError(
            f"the time of a stream is one column, but {clock.name!r} is several; --time names "
            "one, or none"
        )
    value = cells[clock.name]
    if isinstance(value, str):
        return of_text(clock.name, value)
    if clock.is_datetime and "since 1970" not in clock.kind:
        raise unreadable(clock.name, value)
    epoch = {f"{unit} since 1970": 1 / count for unit, count in EPOCH}
    whole = isinstance(value, int) and len(str(abs(value))) > LONG
    scale = epoch.get(clock.kind, clock.scale)
    return Stamps(clock.name, "whole" if whole else "number", scale)


def of_text(name: str, value: str) -> Stamps:
    """How a date-time is read: with a zone, or without one."""
    for kind in ("local", "zoned"):
        stamps = Stamps(name, kind)
        try:
            stamps.ticks(pa.array([value]))
        except pa.ArrowInvalid:
            continue
        return stamps
    raise unreadable(name, value)


def unreadable(name: str, value: object) -> RecordError:
    """What to say of a time that is neither a number nor ISO 8601."""
    return RecordError(
        f"column {name!r} holds times such as {str(value)[:60]!r}; a stream reads numbers and "
        "date-times as in 2024-01-05T10:30:00Z; --time names another column, or none"
    )


def as_number(value: Any) -> Any:
    """The number that a cell is, or the cell."""
    if not isinstance(value, str):
        return value
    for kind in (int, float):
        try:
            return kind(value)
        except ValueError:
            continue
    return value.strip()


def nested(value: Any) -> bool:
    """Whether a value of JSON is itself an object or a list."""
    return isinstance(value, dict | list)
