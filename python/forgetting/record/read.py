"""Read a measured record from CSV or Parquet."""

from __future__ import annotations

import csv
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pandas as pd

from forgetting.record.clock import Clock, find_clock
from forgetting.words.errors import RecordError

SEPARATORS = ",;\t"
PARQUET = {".parquet", ".pq"}
CSV = {".csv", ".tsv", ".txt"}
OLD = tuple(int(part) for part in pd.__version__.split(".")[:2]) < (3, 1)
EXACT: dict[str, Any] = {"float_precision": "round_trip"} if OLD else {}
"""Before pandas 3.1 the default parser could be one bit off; a record must give the same bits."""


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


def read(source: str | Path | pd.DataFrame | Record, time: str | None = None) -> Record:
    """Read a record and parse its time column.

    Parameters
    ----------
    source : path, DataFrame or Record
        A file ending in .csv, .tsv, .txt (separator comma, semicolon or tab, found in the header
        line; decimal point) or .parquet, .pq; or a table already in memory.
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
        When the file is missing, empty, has no rows or cannot be parsed, or time does not increase.
    """
    if isinstance(source, Record):
        return source if time is None else Record(source.frame, clock_of(source, time), source.name)
    if isinstance(source, pd.DataFrame):
        record = Record(with_index(source))
    else:
        record = Record(load(Path(source)), name=Path(source).name)
    check_shape(record)
    return Record(record.frame, clock_of(record, time), record.name)


def clock_of(record: Record, time: str | None) -> Clock | None:
    """Parse the clock of a record's table."""
    return find_clock(record.frame, time, record.name)


def load(path: Path) -> pd.DataFrame:
    """Load the file by its suffix."""
    if not path.exists():
        raise RecordError(f"there is no file {path}")
    if path.is_dir():
        raise RecordError(f"{path} is a folder; name a CSV or Parquet file")
    if path.stat().st_size == 0:
        raise RecordError(f"{path} is empty")
    suffix = path.suffix.lower()
    if suffix in PARQUET:
        return load_parquet(path)
    if suffix in CSV:
        return load_csv(path)
    known = ", ".join(sorted(CSV | PARQUET))
    raise RecordError(f"{path} ends in {suffix or 'nothing'}; known endings are {known}")


def load_parquet(path: Path) -> pd.DataFrame:
    """Read Parquet by pyarrow."""
    try:
        return with_index(pd.read_parquet(path))
    except ImportError:
        raise RecordError(
            "reading Parquet needs pyarrow; install it with pip install 'forgetting[cli]'"
        ) from None
    except (OSError, ValueError) as error:
        raise RecordError(f"{path} is not a Parquet file: {first_line(error)}") from None


def with_index(frame: pd.DataFrame) -> pd.DataFrame:
    """Make an index that holds times, or has a name, the first column; drop plain row numbers."""
    if isinstance(frame.index, pd.DatetimeIndex) and frame.index.name is None:
        frame = frame.rename_axis("time")
    return frame.reset_index(drop=frame.index.name is None)


def load_csv(path: Path) -> pd.DataFrame:
    """Read CSV, finding the separator in the header line."""
    try:
        with path.open(encoding="utf-8-sig", newline="") as stream:
            header, first = stream.readline(), stream.readline()
        separator = max(SEPARATORS, key=header.count)
        check_header(path, cells(header, separator), cells(first, separator))
        frame: pd.DataFrame = pd.read_csv(
            path,
            sep=separator,
            encoding="utf-8-sig",
            skipinitialspace=True,
            low_memory=False,
            **EXACT,
        )
        return frame
    except UnicodeDecodeError:
        raise RecordError(f"{path} is not UTF-8 text") from None
    except (pd.errors.ParserError, pd.errors.EmptyDataError) as error:
        raise RecordError(f"{path} cannot be read as CSV: {first_line(error)}") from None


def cells(line: str, separator: str) -> list[str]:
    """Split a line of CSV."""
    return next(csv.reader([line], delimiter=separator, skipinitialspace=True), [])


def check_header(path: Path, names: list[str], first: list[str]) -> None:
    """Refuse what pandas would repair silently: a name twice, rows longer than the header."""
    twice = next((name for name in names if name and names.count(name) > 1), None)
    if twice is not None:
        raise RecordError(f"{path} has two columns named {twice!r}")
    if len(first) > len(names):
        raise RecordError(
            f"{path} has {len(first)} cells in its first row but {len(names)} names in its header"
        )


def check_shape(record: Record) -> None:
    """Refuse a table without rows."""
    if len(record.frame) == 0:
        raise RecordError(f"{record.name} has a header and no rows")


def first_line(error: Exception) -> str:
    """Shorten a library's message to its first line."""
    return str(error).strip().splitlines()[0].rstrip(".") if str(error).strip() else "unreadable"
