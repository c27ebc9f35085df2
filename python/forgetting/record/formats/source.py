"""From a path, standard input or a compressed file to bytes in which one can go back."""

from __future__ import annotations

import bz2
import gzip
import io
import lzma
import os
import shutil
import stat
import sys
import zipfile
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import NamedTemporaryFile, TemporaryFile
from typing import Any, BinaryIO, cast

from forgetting.extras import extra
from forgetting.record.formats.recognise import recognise
from forgetting.record.formats.table import choose
from forgetting.words.errors import RecordError

IN_MEMORY = 1 << 26
"""Unpacked bytes that are kept in memory; more go to a temporary file."""

DEPTH = 3
"""A file may be packed in a file that is packed, so often."""


def opened(path: Path) -> BinaryIO:
    """Open a file, a pipe or, for "-", standard input, such that one can go back in it."""
    if str(path) == "-":
        return spooled(sys.stdin.buffer)
    try:
        stream = path.open("rb")
    except FileNotFoundError:
        raise RecordError(f"there is no file {path}") from None
    if stat.S_ISREG(os.fstat(stream.fileno()).st_mode):
        return stream
    with stream:
        return spooled(stream)


def spooled(stream: Any) -> BinaryIO:
    """Copy a stream to where one can go back in it."""
    begin = io.BytesIO(stream.read(IN_MEMORY))
    rest = stream.read(1)
    if not rest:
        return begin
    kept = cast(BinaryIO, TemporaryFile())  # noqa: SIM115
    kept.write(begin.getvalue() + rest)
    shutil.copyfileobj(stream, kept, 1 << 20)
    kept.seek(0)
    return kept


@contextmanager
def on_disk(stream: BinaryIO, suffix: str) -> Iterator[Path]:
    """A path under which a library that wants one finds the bytes."""
    name = getattr(stream, "name", None)
    if isinstance(name, str) and Path(name).suffix.lower() == suffix:
        yield Path(name)
        return
    with NamedTemporaryFile(suffix=suffix, delete=False) as copy:
        stream.seek(0)
        shutil.copyfileobj(stream, copy)
    try:
        yield Path(copy.name)
    finally:
        os.unlink(copy.name)


def unpacked(stream: BinaryIO, source: str, part: str | None) -> tuple[BinaryIO, str, list[str]]:
    """Undo compression, layer by layer.

    Returns
    -------
    stream, format, layers
        The bytes, what they are (see `recognise`), and the names of what was undone.
    """
    layers: list[str] = []
    kind = recognise(stream)
    while kind in ("gzip", "xz", "bzip2", "zstd", "zip") and len(layers) < DEPTH:
        if kind == "zip" and is_spreadsheet(stream, source):
            return stream, "excel", layers
        try:
            inner = member(stream, source, part) if kind == "zip" else plain(stream, kind)
            stream = spooled(inner)
        except (OSError, EOFError, lzma.LZMAError, zlib.error, zipfile.BadZipFile) as error:
            raise RecordError(f"{source} cannot be unpacked ({kind}): {error}") from None
        layers.append(kind)
        kind = recognise(stream)
    return stream, kind, layers


def plain(stream: BinaryIO, kind: str) -> Any:
    """A stream of the unpacked bytes."""
    if kind == "gzip":
        return gzip.open(stream)
    if kind == "xz":
        return lzma.open(stream)
    if kind == "bzip2":
        return bz2.open(stream)
    arrow = extra("pyarrow", "reading Zstandard")
    return arrow.CompressedInputStream(stream, "zstd")


def is_spreadsheet(stream: BinaryIO, source: str) -> bool:
    """Whether a ZIP archive is a workbook of Excel or OpenDocument."""
    names = archive(stream, source).namelist()
    return any(name.startswith("xl/") for name in names) or "content.xml" in names


def archive(stream: BinaryIO, source: str) -> zipfile.ZipFile:
    """Open a ZIP archive."""
    try:
        return zipfile.ZipFile(stream)
    except zipfile.BadZipFile as error:
        raise RecordError(f"{source} is not a whole ZIP archive: {error}") from None


def member(stream: BinaryIO, source: str, part: str | None) -> Any:
    """The file in a ZIP archive that was asked for, or the only one."""
    files = archive(stream, source)
    names = [
        entry.filename
        for entry in files.infolist()
        if not entry.is_dir() and not entry.filename.startswith("__MACOSX/")
    ]
    name = choose(names, part if part in names or len(names) > 1 else None, source, "file")
    try:
        return files.open(name)
    except RuntimeError as error:
        raise RecordError(f"{source}: {error}") from None
