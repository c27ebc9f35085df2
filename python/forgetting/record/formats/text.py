"""Delimited text: recognised line by line at its begin, then read by pandas."""

from __future__ import annotations

import io
import re
import warnings
from itertools import islice
from typing import Any, BinaryIO

import pandas as pd

from forgetting.record.formats.dialect import (
    COMMENT,
    NAMES,
    Dialect,
    dialect,
    split,
)
from forgetting.record.formats.encoding import encoding
from forgetting.record.formats.footer import below
from forgetting.record.formats.layout import Layout, is_data, layout
from forgetting.record.formats.lines import LINES, Text, joined, reference
from forgetting.record.formats.repairs import check_names, with_points, without_headers
from forgetting.record.formats.table import Table
from forgetting.words.errors import RecordError, first_line

OLD = tuple(int(part) for part in pd.__version__.split(".")[:2]) < (3, 1)
EXACT: dict[str, Any] = {"float_precision": "round_trip"} if OLD else {}
"""Before pandas 3.1 the default parser could be one bit off; a record must give the same bits."""
STOPPED = "Calling read(nbytes) on source failed"
"""What pandas says where Ctrl-C stops it; it gives errors of reading as they are."""
WHERE = re.compile(r"Expected (\d+) fields in line (\d+), saw (\d+)")


def load(stream: BinaryIO, source: str, given: str | None) -> Table:
    """Read delimited text.

    Parameters
    ----------
    stream : binary stream
        The whole file.
    source : str
        Its name, for messages.
    given : str or None
        The encoding, when the user knows it.
    """
    text = Text(stream, given or encoding(stream), source)
    try:
        return table(text, given is not None)
    except (UnicodeError, LookupError) as error:
        raise RecordError(f"{source} is not {text.encoding} text: {first_line(error)}") from None


def table(text: Text, known: bool) -> Table:
    """Recognise and read."""
    form = dialect(reference(text))
    if form is None:
        raise no_numbers(text)
    found, first = beginning(text, form)
    mark = comment(text, first)
    frame = parsed(text, form, found, first, mark)
    skipped = lines_before(found)
    footer = below(text, form, mark)
    if footer:
        frame = frame.iloc[:-footer]
        skipped.append(f"{footer} line{'s' * (footer > 1)} below the table")
    frame, notes = without_headers(frame)
    skipped += notes
    details = {
        "separator": NAMES[form.separator],
        "decimal": "comma" if form.decimal == "," else "point",
        "encoding": text.encoding
        + ("" if known or text.encoding.startswith("utf") else " (guessed)"),
    }
    if form.thousands:
        details["thousands"] = repr(form.thousands)
    if found.header is None:
        details["names"] = "none in the file; columns are numbered"
    places = used(frame)
    units = {new: found.units[old] for new, old in enumerate(places) if old in found.units}
    return Table(frame.iloc[:, places], "delimited text", details, units, skipped)


def no_numbers(text: Text) -> RecordError:
    """What to say of a text in which no line holds a number."""
    lines = [line for line in islice(text.lines(), LINES) if line.strip()]
    if not lines:
        return RecordError(f"{text.source} is empty: it has no line with anything in it")
    if len(lines) == 1:
        return RecordError(f"{text.source} has a header and no rows")
    return RecordError(f"{text.source} is no table of numbers: no line of it holds one")


def beginning(text: Text, form: Dialect) -> tuple[Layout, int]:
    """Look at ever more lines from the start until the table begins; also its first line."""
    count = LINES
    while True:
        lines = list(islice(text.lines(), count))
        starts, whole = joined(lines)
        rows = [cells_of(line, form) for line in whole]
        found = layout(rows, form.kinds)
        if found is not None and (found.header is not None or len(lines) < count or count > LINES):
            return found, starts[found.first]
        if len(lines) < count:
            raise RecordError(f"{text.source} is no table: its lines have no cells in common")
        count *= 10


def cells_of(line: str, form: Dialect) -> list[str] | None:
    """Cells of a line, None for a blank one; of a comment those behind its mark."""
    text = line.strip()
    for mark in COMMENT:
        if line.lstrip(" ").startswith(mark):
            inner = split(text.lstrip("#%!/ \t"), form.separator)
            # A line such as "# t I V" directly above the numbers holds their names.
            return (
                inner if len(inner) == len(form.kinds) and not is_data(inner, form.kinds) else None
            )
    return split(line, form.separator) if text else None


def lines_before(found: Layout) -> list[str]:
    """What stands above the numbers and is not used."""
    top = found.first if found.header is None else found.header
    notes = []
    if top:
        what = "names" if found.header is not None else "numbers"
        notes.append(f"{top} line{'s' * (top > 1)} above the {what}")
    if found.below:
        notes.append(f"{found.below} line{'s' * (found.below > 1)} between names and numbers")
    return notes


def parsed(text: Text, form: Dialect, found: Layout, first: int, mark: str | None) -> pd.DataFrame:
    """Read the rows by pandas; columns are numbered."""
    names = list(range(max(len(found.names), len(form.kinds))))
    times = {i: "str" for i, kind in enumerate(form.kinds) if kind == "time"}
    text.stream.seek(0)
    handle = io.TextIOWrapper(text.stream, text.encoding)
    try:
        for _ in range(first):
            handle.readline()
        with warnings.catch_warnings():
            warnings.simplefilter("error", pd.errors.ParserWarning)
            frame: pd.DataFrame = pd.read_csv(
                handle,
                sep={" ": r"\s+", "": "\x1f"}.get(form.separator, form.separator),
                header=None,
                names=names,
                index_col=False,
                dtype=times,
                decimal=form.decimal,
                thousands=form.thousands,
                comment=mark,
                skipinitialspace=True,
                low_memory=False,
                **EXACT,
            )
    except (pd.errors.ParserError, pd.errors.ParserWarning, pd.errors.EmptyDataError) as error:
        if STOPPED in str(error):
            raise KeyboardInterrupt from None
        raise unreadable(text, error, first) from None
    finally:
        handle.detach()
    check_names(text.source, frame, found)
    for place, kind in enumerate(form.kinds):
        if kind == "number" and frame[place].dtype.kind not in "fiub":
            frame[place] = with_points(frame[place], form)
    frame.columns = pd.Index([*found.names, *[""] * (len(names) - len(found.names))])
    return frame


def comment(text: Text, first: int) -> str | None:
    """The mark of comment lines, where there are some and no other line has it."""
    marks = set()
    for number, line in enumerate(islice(text.lines(), first + LINES)):
        start = line.lstrip()[:1]
        if start in ("#", "%"):
            marks.add(start)
        elif number >= first:
            marks -= set(line)
    return min(marks, default=None)


def unreadable(text: Text, error: Exception, first: int) -> RecordError:
    """Say which line has too many cells, or else what pandas says."""
    message = first_line(error)
    place = WHERE.search(message)
    if place is None:
        return RecordError(f"{text.source} cannot be read as CSV: {message}")
    want, line, have = (int(number) for number in place.groups())
    return RecordError(
        f"{text.source} cannot be read as CSV: line {line + first} has {have} cells, "
        f"the table {want} columns"
    )


def used(table: pd.DataFrame) -> list[int]:
    """Columns that have a name or a value; lines that end in a separator make others."""
    return [i for i, name in enumerate(table.columns) if name or table.iloc[:, i].notna().any()]
