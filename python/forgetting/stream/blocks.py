"""Blocks of lines as bytes, before anything of them is a number."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from forgetting.record.formats.dialect import split
from forgetting.stream.form import Form

MOST = 8192
"""Lines taken in one go, so that memory does not grow with what waits."""


def decoded(line: bytes) -> str:
    """A line as text; what is none becomes �."""
    return line.decode("utf-8", errors="replace")


def pieces(block: bytes, most: int = MOST) -> Iterator[bytes]:
    """A block of lines in pieces of at most so many."""
    if not block:
        return
    if block.count(b"\n") <= most:
        yield block
        return
    ends = np.flatnonzero(np.frombuffer(block, dtype=np.uint8) == ord("\n"))[most - 1 :: most] + 1
    start = 0
    for end in [*ends.tolist(), len(block)]:
        if end > start:
            yield block[start:end]
        start = end


def first_cells(form: Form, lines: Sequence[str]) -> dict[str, Any]:
    """Cells of the first line below names and units, by name."""
    if form.kind == "json":
        found: dict[str, Any] = json.loads(lines[0])
        return found
    line = next((line for line in lines if not form.is_header(line)), lines[0])
    return dict(zip(form.names, split(line, form.separator), strict=False))
