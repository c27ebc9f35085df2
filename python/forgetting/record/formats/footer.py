"""Lines below the table: sums, remarks, the end of the file."""

from __future__ import annotations

from forgetting.record.formats.dialect import Dialect, split
from forgetting.record.formats.layout import is_data
from forgetting.record.formats.lines import Text

FOOTER = 4096
"""Bytes at the end of a file that are searched for lines below the table."""


def below(text: Text, form: Dialect, mark: str | None) -> int:
    """Lines at the end of the file that are no rows of the table and no comments."""
    size = text.size()
    lines = list(text.lines(max(size - FOOTER, 0) // 4 * 4))
    rows = [split(line, form.separator) for line in lines if not ignored(line, mark)]
    if size > FOOTER:
        rows = rows[1:]
    count = 0
    while count < len(rows) and not belongs(rows[-1 - count], form):
        count += 1
    return count if count < len(rows) else 0


def ignored(line: str, mark: str | None) -> bool:
    """Whether pandas makes no row of a line."""
    return not line.strip() or (mark is not None and line.lstrip().startswith(mark))


def belongs(row: list[str], form: Dialect) -> bool:
    """Whether a row at the end is one of the table: it may have a bad cell, but is no sentence."""
    return is_data(row, form.kinds) or len(row) == len(form.kinds) > 1 or not any(row)
