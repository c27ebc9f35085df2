"""The time column: parsing it, checking that it increases, and finding its gaps."""

from __future__ import annotations

import re
import warnings
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from forgetting.record.columns import resolve
from forgetting.words.errors import RecordError

TIME_NAME = re.compile(r"(time|timestamp|date|datetime|date_time)([ _.\[(].*)?$", re.IGNORECASE)
GAP = 1.5
"""A step longer than this many median steps is a gap: lags do not reach across it."""


FORMATS: tuple[dict[str, Any], ...] = (
    {"format": "ISO8601"},
    {"format": "ISO8601", "utc": True},
    {},
)
"""How text is read as time: ISO, ISO with changing offsets, or the format of its first cell."""


@dataclass(frozen=True)
class Clock:
    """When each row was measured.

    Attributes
    ----------
    values : pandas.Series
        Date-times, or seconds as float64.
    name : str
        Column name.
    """

    values: pd.Series
    name: str

    @property
    def is_datetime(self) -> bool:
        """Whether the column held date-times (else numbers, taken as seconds)."""
        return bool(pd.api.types.is_datetime64_any_dtype(self.values))

    def seconds(self) -> NDArray[np.float64]:
        """Seconds since the first row, (T,)."""
        elapsed = self.values - self.values.iloc[0]
        if self.is_datetime:
            elapsed = elapsed.dt.total_seconds()
        return np.asarray(elapsed, dtype=np.float64)

    def segments(self) -> NDArray[np.int64]:
        """Number the stretches between gaps, (T,): 0, 0, ..., 1, 1, ..."""
        steps = np.diff(self.seconds())
        if len(steps) == 0:
            return np.zeros(len(self.values), dtype=np.int64)
        # One part in a million forgives the rounding of time stamps such as 0.1, 0.2, 0.30000001.
        gaps = steps > GAP * np.median(steps) * (1 + 1e-6)
        return np.concatenate([[0], np.cumsum(gaps)]).astype(np.int64)


def find_clock(frame: pd.DataFrame, time: str | None, source: str) -> Clock | None:
    """Return the clock of a table: the named column, or the one that looks like time."""
    if time is not None:
        column = resolve(frame, time, source)
        values = parse(frame[column])
        if values is None:
            why = example(frame[column])
            raise RecordError(f"column {column!r} of {source} holds no times: {why}")
    else:
        column, values = guess(frame)
        if values is None:
            return None
    check_increasing(values, column, source)
    return Clock(values.reset_index(drop=True), str(column))


def guess(frame: pd.DataFrame) -> tuple[str, pd.Series | None]:
    """Take the first column with a time-like name, else a first column of ISO date-times."""
    for name in frame.columns:
        if TIME_NAME.match(str(name)):
            values = parse(frame[name])
            if values is not None:
                return name, values
    first = frame.columns[0]
    if pd.api.types.is_numeric_dtype(frame[first]):
        return first, None
    return first, parse(frame[first], FORMATS[:2])


def parse(column: pd.Series, formats: Sequence[dict[str, Any]] = FORMATS) -> pd.Series | None:
    """Parse numbers as seconds and text as date-times; None when a cell is neither."""
    values: pd.Series | None
    if pd.api.types.is_datetime64_any_dtype(column):
        values = column
    elif pd.api.types.is_bool_dtype(column):
        return None
    elif pd.api.types.is_numeric_dtype(column):
        values = column.astype(np.float64)
    else:
        values = next((each for each in parses(column, formats) if each is not None), None)
    return None if values is None or values.isna().any() else values


def parses(column: pd.Series, formats: Sequence[dict[str, Any]]) -> Iterator[pd.Series | None]:
    """Parse text by each format in turn; one format holds for the whole column, 02/03 included."""
    for options in formats:
        try:
            with warnings.catch_warnings():
                # pandas only warns when it gives up one format and guesses cell by cell.
                warnings.simplefilter("error")
                parsed = pd.to_datetime(column, **options)
        except (ValueError, TypeError, OverflowError, Warning):
            continue
        yield parsed if pd.api.types.is_datetime64_any_dtype(parsed) else None


def example(column: pd.Series) -> str:
    """Name the first cell that is no time, for an error."""
    for row, cell in enumerate(column, start=1):
        if parse(pd.Series([cell])) is None:
            return f"row {row} is {cell!r}"
    return "its cells do not share one format"


def check_increasing(values: pd.Series, column: str, source: str) -> None:
    """Refuse time that does not increase; the error names the row."""
    bad = np.flatnonzero(~(values.diff().iloc[1:] > values.iloc[0] - values.iloc[0]))
    if len(bad):
        row = int(bad[0]) + 2
        raise RecordError(
            f"time must increase, but column {column!r} of {source} "
            f"goes from {values.iloc[row - 2]} to {values.iloc[row - 1]} in row {row}"
        )
