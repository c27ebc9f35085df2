"""Read any file: what it is packed in, what it is, and the reader for that."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import BinaryIO

from forgetting.record.formats import columnar, excel, json_lines, loggers, matlab, text
from forgetting.record.formats.source import opened, unpacked
from forgetting.record.formats.table import Table
from forgetting.words.errors import RecordError

NO_PARTS = ("parquet", "arrow", "arrow stream", "json", "text")


def load(path: Path, source: str, part: str | None = None, encoding: str | None = None) -> Table:
    """Read a file, a folder of Parquet, a pipe, or standard input for "-".

    Parameters
    ----------
    path : Path
        Where it is.
    source : str
        Its name, for messages.
    part : str, optional
        Which sheet, group, topic or file of an archive.
    encoding : str, optional
        Encoding of text, when the guess is wrong.

    Raises
    ------
    RecordError
        When there is no such file, or it is nothing that can be read.
    """
    if path.is_dir():
        return columnar.folder(path)
    with opened(path) as stream:
        plain, kind, layers = unpacked(stream, source, part)
        plain.seek(0)
        if kind == "empty":
            raise RecordError(f"{source} is empty")
        if part is not None and kind in NO_PARTS and "zip" not in layers:
            raise RecordError(f"{source} has no parts, so --part {part} names nothing")
        found = by_kind(plain, kind, source, None if "zip" in layers else part, encoding)
    if layers:
        return replace(found, details={"packed": ", ".join(layers), **found.details})
    return found


def by_kind(
    stream: BinaryIO, kind: str, source: str, part: str | None, encoding: str | None
) -> Table:
    """Call the reader of a format."""
    if kind == "text" or (encoding is not None and kind == "binary"):
        return text.load(stream, source, encoding)
    if kind == "json":
        return json_lines.load(stream, source, encoding)
    columns = {
        "parquet": columnar.parquet,
        "arrow": columnar.arrow,
        "arrow stream": columnar.arrow_stream,
    }
    if kind in columns:
        return columns[kind](stream, source)
    parts = {
        "excel": excel.load,
        "matlab": matlab.load,
        "tdms": loggers.tdms,
        "mdf": loggers.mdf,
        "ulog": loggers.ulog,
    }
    if kind in parts:
        return parts[kind](stream, source, part)
    what = {
        "hdf5": "HDF5, which has no rule for where a table lies in it; write it as Parquet",
        "pdf": "PDF, which is made for reading by people; export the table as text",
        "markup": "HTML or XML, a page and no table; was the right file downloaded?",
    }
    raise RecordError(
        f"{source} is {what.get(kind, 'no table: it is neither text nor a known format')}"
    )
