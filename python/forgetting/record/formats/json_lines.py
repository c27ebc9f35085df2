"""JSON: an object a line, or one list of objects, by pandas."""

from __future__ import annotations

import io
from typing import Any, BinaryIO

import pandas as pd

from forgetting.record.formats.encoding import encoding
from forgetting.record.formats.table import Table
from forgetting.words.errors import RecordError, first_line

OLD = tuple(int(part) for part in pd.__version__.split(".")[:2]) < (3, 1)
AS_WRITTEN: dict[str, Any] = {"convert_dates": False} if OLD else {"dtype": False}
"""What makes pandas leave dates to `forgetting.record.clock`."""


def load(stream: BinaryIO, source: str, given: str | None) -> Table:
    """Read JSON lines; a list of objects is told by its bracket."""
    code = given or encoding(stream)
    stream.seek(0)
    text = io.TextIOWrapper(stream, code)
    try:
        lines = not begins_with_bracket(text)
        frame = pd.read_json(text, lines=lines, precise_float=True, **AS_WRITTEN)
    except (ValueError, TypeError, AttributeError) as error:
        raise RecordError(f"{source} is not JSON lines: {first_line(error)}") from None
    finally:
        text.detach()
    if not isinstance(frame, pd.DataFrame):
        raise RecordError(f"{source} is JSON, but no list of objects with names")
    return Table(frame, "JSON lines" if lines else "JSON", {"encoding": code})


def begins_with_bracket(text: io.TextIOWrapper) -> bool:
    """Whether the first character is that of a list."""
    first = text.read(1)
    while first.isspace():
        first = text.read(1)
    text.seek(0)
    return first == "["
