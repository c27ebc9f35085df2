"""Files are written whole or not at all, and never over what they are made from."""

from __future__ import annotations

import os
import secrets
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path

from forgetting.words.errors import RecordError

UNFINISHED: set[Path] = set()
"""Temporary names of files that are being written."""


@contextmanager
def whole(path: str | Path) -> Iterator[Path]:
    """Yield a temporary name in the same folder; it becomes `path` when the block ends well.

    Whatever interrupts the block (a full disk, Ctrl-C) leaves the old file as it was. A link is
    followed: what it points to is replaced. What is no regular file, such as a pipe, is written
    directly. The suffix of the temporary name is that of `path`, because libraries look at it.

    Raises
    ------
    OSError
        When the folder is not there or cannot be written; the message names `path`.

    Examples
    --------
    >>> import tempfile
    >>> target = Path(tempfile.mkdtemp()) / "a.txt"
    >>> with whole(target) as path:
    ...     _ = path.write_text("whole")
    >>> target.read_text(), len(list(target.parent.iterdir()))
    ('whole', 1)
    """
    target = Path(path).resolve()
    if target.exists() and not target.is_file():
        yield target
        return
    made = target.with_name(f".{target.stem[:100]}.{secrets.token_hex(4)}{target.suffix}")
    UNFINISHED.add(made)
    try:
        yield made
        with made.open("rb+") as stream:
            os.fsync(stream.fileno())
        if target.exists():
            made.chmod(target.stat().st_mode & 0o7777)
        made.replace(target)
    except BaseException as error:
        with suppress(OSError):
            made.unlink(missing_ok=True)
        # a disk that is full does not say for which file
        if isinstance(error, OSError) and error.errno and error.filename in (None, str(made)):
            error.filename = str(path)
        raise
    finally:
        UNFINISHED.discard(made)


def remove_unfinished() -> None:
    """Remove what `whole` has under way, before a process ends without its blocks ending."""
    for path in tuple(UNFINISHED):
        with suppress(OSError):
            path.unlink(missing_ok=True)


def write_text(path: str | Path, text: str) -> None:
    """Write text as UTF-8, whole or not at all."""
    with whole(path) as made:
        made.write_text(text, encoding="utf-8")


def check_outputs(outputs: Mapping[str, Path | None], record: Path | None = None) -> None:
    """Refuse outputs that would destroy the record or one another, or that have no folder.

    Parameters
    ----------
    outputs : mapping of str to Path or None
        Where to write, by the name of the option; None is not written.
    record : Path, optional
        What is read: a file, or a folder of files.

    Raises
    ------
    RecordError
        When a folder is missing, when an output is the record by whatever name (a link, too) or
        lies in the record's folder, or when two outputs are one file.
    """
    wanted = [(name, path) for name, path in outputs.items() if path is not None]
    for number, (name, path) in enumerate(wanted):
        if not path.resolve().parent.is_dir():
            raise RecordError(f"{name} {path}: there is no folder {path.parent}")
        if record is not None and belongs(path, record):
            raise RecordError(f"{name} {path} is the record that is read; name another file")
        for other, before in wanted[:number]:
            if same(path, before):
                raise RecordError(f"{name} and {other} are one file, {path}; name two")


def belongs(path: Path, record: Path) -> bool:
    """Whether a path is the record, or would be a part of it."""
    return same(path, record) or (record.is_dir() and record.resolve() in path.resolve().parents)


def same(one: Path, other: Path) -> bool:
    """Whether two paths are one file, by whatever name."""
    if one.resolve() == other.resolve():
        return True
    try:
        return one.samefile(other)
    except OSError:
        # One of them is not there yet.
        return False
