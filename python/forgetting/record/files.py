"""Tables from CSV and Parquet files."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import Any

import pandas as pd

from forgetting.words.errors import RecordError

SEPARATORS = ",;\t"
PARQUET = {".parquet", ".pq"}
CSV = {".csv", ".tsv", ".txt"}
OLD = tuple(int(part) for part in pd.__version__.split(".")[:2]) < (3, 1)
EXACT: dict[str, Any] = {"float_precision": "round_trip"} if OLD else {}
"""Before pandas 3.1 the default parser could be one bit off; a record must give the same bits."""


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
        frame: pd.DataFrame = pd.read_parquet(path)
        return frame
    except ImportError:
        raise RecordError(
            "reading Parquet needs pyarrow; install it with pip install 'forgetting[cli]'"
        ) from None
    except (OSError, ValueError) as error:
        raise RecordError(f"{path} is not a Parquet file: {first_line(error)}") from None


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


def first_line(error: Exception) -> str:
    """Shorten a library's message to its first line."""
    return str(error).strip().splitlines()[0].rstrip(".") if str(error).strip() else "unreadable"
