"""A measured record: read from a file, or taken from a data frame of any library."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import narwhals as nw
import pandas as pd

from forgetting.record.clock import Clock, find_clock
from forgetting.record.files import load
from forgetting.words.errors import RecordError

if TYPE_CHECKING:
    from narwhals.typing import IntoDataFrame


@dataclass(frozen=True)
class Record:
    """A table of signals, one row per sample, and its clock when it has one.

    Attributes
    ----------
    frame : pandas.DataFrame
        The columns as read.
    clock : Clock or None
        The parsed time column.
    name : str
        Where it came from, for messages and titles.
    """

    frame: pd.DataFrame
    clock: Clock | None = None
    name: str = field(default="record")


def read(source: str | Path | IntoDataFrame | Record, time: str | None = None) -> Record:
    """Read a record and parse its time column.

    Parameters
    ----------
    source : path, data frame or Record
        A file ending in .csv, .tsv, .txt (separator comma, semicolon or tab, found in the header
        line; decimal point) or .parquet, .pq; or a table in memory: a data frame of pandas,
        Polars, PyArrow or any other library that narwhals knows.
    time : str, optional
        Name of the time column: date-times, or seconds as numbers. Without it a column named
        time, timestamp, date or datetime (a unit may follow, as in ``time_s``) is taken, or else a
        first column of date-times.

    Returns
    -------
    Record

    Raises
    ------
    RecordError
        When the file is missing, empty, has no rows or cannot be parsed, time does not increase,
        or the source is something else.
    """
    if isinstance(source, Record):
        return source if time is None else Record(source.frame, clock_of(source, time), source.name)
    if isinstance(source, str | Path):
        record = Record(with_index(load(Path(source))), name=Path(source).name)
    else:
        record = Record(with_index(to_pandas(source)))
    check_shape(record)
    return Record(record.frame, clock_of(record, time), record.name)


def clock_of(record: Record, time: str | None) -> Clock | None:
    """Parse the clock of a record's table."""
    return find_clock(record.frame, time, record.name)


def to_pandas(frame: Any) -> pd.DataFrame:
    """A data frame of any library as one of pandas."""
    try:
        table: pd.DataFrame = nw.from_native(frame, eager_only=True).to_pandas()
    except TypeError:
        kind = f"{type(frame).__module__}.{type(frame).__name__}"
        raise RecordError(f"a record is a file or a data frame in memory, but got {kind}") from None
    return table


def with_index(frame: pd.DataFrame) -> pd.DataFrame:
    """Make an index that holds times, or has a name, the first column; drop plain row numbers."""
    if isinstance(frame.index, pd.DatetimeIndex) and frame.index.name is None:
        frame = frame.rename_axis("time")
    return frame.reset_index(drop=frame.index.name is None)


def check_shape(record: Record) -> None:
    """Refuse a table without rows."""
    if len(record.frame) == 0:
        raise RecordError(f"{record.name} has a header and no rows")
