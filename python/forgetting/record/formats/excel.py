"""Workbooks of Excel and OpenDocument, by python-calamine."""

from __future__ import annotations

from datetime import date, datetime, time, timedelta
from typing import Any, BinaryIO

import pandas as pd

from forgetting.extras import extra
from forgetting.record.formats import cells
from forgetting.record.formats.dialect import body
from forgetting.record.formats.layout import Layout, layout
from forgetting.record.formats.table import Table, choose
from forgetting.words.errors import RecordError, first_line

SEEN = 300
"""Rows in which the table is looked for."""


def load(stream: BinaryIO, source: str, part: str | None) -> Table:
    """Read the sheet that was asked for, or the first that holds a table of numbers."""
    calamine = extra("python_calamine", "reading Excel")
    try:
        book = calamine.CalamineWorkbook.from_filelike(stream)
        names = list(book.sheet_names)
        wanted = names if part is None else [choose(names, part, source, "sheet")]
        for name in wanted:
            found = table(book.get_sheet_by_name(name).to_python(skip_empty_area=False))
            if found is not None:
                return with_sheet(found, name, names)
    except (calamine.CalamineError, OSError, ValueError) as error:
        if isinstance(error, RecordError):
            raise
        raise RecordError(f"{source} is not a workbook: {first_line(error)}") from None
    raise RecordError(f"{source} has no sheet with a table of numbers")


def with_sheet(found: Table, name: str, names: list[str]) -> Table:
    """Say which sheet of how many it is."""
    which = f"{name!r}, one of {len(names)}" if len(names) > 1 else repr(name)
    return Table(found.frame, "Excel", {"sheet": which}, found.units, found.skipped)


def table(grid: list[list[Any]]) -> Table | None:
    """Find names, units and numbers among the cells of a sheet."""
    texts = [[text_of(cell) for cell in row] for row in grid]
    rows = [row if any(row) else None for row in texts]
    run, _ = body(rows[:SEEN] if len(rows) <= 2 * SEEN else rows[len(rows) // 2 :][:SEEN])
    found = None if run is None else layout(rows, run.kinds)
    if found is None:
        return None
    top = found.first if found.header is None else found.header
    skipped = [f"{top} row{'s' * (top > 1)} above the names"] if top else []
    return Table(frame(grid, found), "Excel", {}, found.units, skipped)


def frame(grid: list[list[Any]], found: Layout) -> pd.DataFrame:
    """Columns from the first row of numbers on, with an empty cell as a missing value."""
    width = len(found.names)
    body = [[None if cell == "" else cell for cell in row[:width]] for row in grid[found.first :]]
    made = pd.DataFrame(body, columns=range(width)).dropna(how="all", ignore_index=True)
    made = made.infer_objects()
    made.columns = pd.Index(found.names)
    empty = [not name and made.iloc[:, i].isna().all() for i, name in enumerate(found.names)]
    return made.loc[:, [not each for each in empty]]


def text_of(cell: Any) -> str:
    """A cell as the text by which its kind is recognised."""
    if isinstance(cell, datetime | date | time):
        return cell.isoformat()
    if isinstance(cell, timedelta):
        return str(cell).replace(" days,", "d").replace(" day,", "d")
    return cells.bare_number(cell) if isinstance(cell, float) else str(cell).strip()
