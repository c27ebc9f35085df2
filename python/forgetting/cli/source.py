"""The record of a command: read once, and shown when that is all that was wanted."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from rich.markup import escape

from forgetting.cli.tables import console

if TYPE_CHECKING:
    from forgetting.record import Record


def read_record(
    path: Path,
    time: str | None,
    gap: str | None,
    missing: Sequence[str] | None,
    part: str | None,
    encoding: str | None,
) -> Record:
    """Read by the one door, `forgetting.record.read`."""
    from forgetting.record.read import read

    return read(path, time, gap=gap, missing=missing or (), part=part, encoding=encoding)


def show_record(record: Record) -> None:
    """Print what was recognised."""
    out = console()
    pairs = record.describe()
    width = max(len(word) for word, _ in pairs)
    for word, text in pairs:
        out.print(f"[bold]{word:<{width}}[/]  {escape(text)}")
