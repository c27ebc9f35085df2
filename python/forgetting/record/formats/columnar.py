"""Parquet, Arrow and Feather, by pyarrow."""

from __future__ import annotations

from pathlib import Path
from typing import Any, BinaryIO

import pandas as pd

from forgetting.extras import extra
from forgetting.record.formats.table import Table
from forgetting.words.errors import RecordError, first_line

ENDINGS = (".parquet", ".pq", ".parq")


def parquet(stream: BinaryIO, source: str) -> Table:
    """Read a Parquet file."""
    return Table(whole("pyarrow.parquet", "read_table", stream, source, "Parquet"), "Parquet")


def arrow(stream: BinaryIO, source: str) -> Table:
    """Read an Arrow IPC file, which Feather is too."""
    frame = whole("pyarrow.feather", "read_table", stream, source, "Arrow or Feather")
    return Table(frame, "Arrow")


def arrow_stream(stream: BinaryIO, source: str) -> Table:
    """Read a stream of Arrow IPC messages."""
    reader = extra("pyarrow.ipc", "reading Arrow")
    try:
        return Table(reader.open_stream(stream).read_all().to_pandas(), "Arrow stream")
    except (OSError, ValueError) as error:
        raise RecordError(f"{source} is not a whole Arrow stream: {first_line(error)}") from None


def folder(path: Path) -> Table:
    """Read a folder of Parquet files as one table, in the order of their names."""
    files = sorted(str(each) for each in path.rglob("*") if is_part(each))
    if not files:
        raise RecordError(f"{path} is a folder without Parquet files; name a file")
    library = extra("pyarrow.dataset", "reading Parquet")
    try:
        parts = library.dataset(
            files, format="parquet", partitioning="hive", partition_base_dir=str(path)
        )
        frame = parts.to_table().to_pandas()
    except (OSError, ValueError, TypeError) as error:
        raise RecordError(f"{path} is no folder of Parquet: {first_line(error)}") from None
    return Table(frame, "folder of Parquet", {"files": str(len(files))})


def is_part(path: Path) -> bool:
    """Whether a file in a folder is one of its Parquet files; hidden ones are not."""
    return path.suffix.lower() in ENDINGS and not path.name.startswith((".", "_"))


def whole(module: str, function: str, source: Any, name: str, kind: str) -> pd.DataFrame:
    """Read by a function of pyarrow; what it refuses is no such file."""
    library = extra(module, f"reading {kind}")
    try:
        table = getattr(library, function)(source)
        # each column is let go once it is converted: a long record is not there twice
        frame: pd.DataFrame = table.to_pandas(self_destruct=True, split_blocks=True)
    except (OSError, ValueError, TypeError) as error:
        raise RecordError(f"{name} is no {kind} file: {first_line(error)}") from None
    return frame
