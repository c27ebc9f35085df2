"""The separator, decimal sign and width of delimited text, found in lines of its body."""

from __future__ import annotations

import csv
from collections.abc import Sequence
from dataclasses import dataclass

from forgetting.record.formats import cells

SEPARATORS = ("\t", ";", ",", "|", " ", "")
"""In order of preference: tab to bar, white space, and one column without any."""

NAMES = {
    "\t": "tab",
    ";": "semicolon",
    ",": "comma",
    "|": "bar",
    " ": "white space",
    "": "none, one column",
}
COMMENT = ("#", "%", "//", "!")
LONG = 30
"""Rows from which on a run is no more like a table when it is longer."""
MISFIT = 0.4
"""What is left of a separator's worth where the line above the numbers has another width."""


@dataclass(frozen=True)
class Dialect:
    """How lines become cells.

    Attributes
    ----------
    separator : str
        One of `SEPARATORS`; a space stands for any white space.
    decimal : str
        "." or ",".
    thousands : str or None
        Sign between thousands.
    kinds : tuple of str
        Kind of each column: "number", "time", "text" or "missing" (nothing seen).
    """

    separator: str
    decimal: str
    thousands: str | None
    kinds: tuple[str, ...]


@dataclass(frozen=True)
class Run:
    """Lines behind one another with cells of the same kinds."""

    first: int
    rows: list[list[str]]
    kinds: tuple[str, ...]


def split(line: str, separator: str) -> list[str]:
    """Split a line into cells without quotes and surrounding spaces."""
    if separator == "":
        return [line.strip().strip('"')]
    if separator == " ":
        line = " ".join(line.split())
    try:
        row = next(csv.reader([line], delimiter=separator, skipinitialspace=True), [])
    except csv.Error:
        row = line.split(separator)
    return [cell.strip() for cell in row]


def separates(separator: str, lines: Sequence[str]) -> bool:
    """Whether any line may have more than one cell; true of "", which stands for one column."""
    if separator == " ":
        return any(len(line.split()) > 1 for line in lines)
    return any(separator in line for line in lines)


def is_aside(line: str) -> bool:
    """Whether a line is blank or a comment."""
    return not line.strip() or line.lstrip(" ").startswith(COMMENT)


def dialect(lines: Sequence[str]) -> Dialect | None:
    """Choose the dialect in which the most cells of the body are numbers or times.

    Returns
    -------
    Dialect or None
        None where no line has a number or a time.
    """
    best, worth = None, 0.0
    for separator in filter(lambda each: separates(each, lines), SEPARATORS):
        run, above = body([None if is_aside(each) else split(each, separator) for each in lines])
        if run is None or (separator and len(run.kinds) < 2):
            continue
        value = quality(run) * (1.0 if fits(above, run, separator) else MISFIT)
        if value > worth * (1 + 1e-9):
            best, worth = (separator, run), value
    if best is None:
        return None
    separator, run = best
    return Dialect(separator, *signs(run, separator), run.kinds)


def body(rows: Sequence[list[str] | None]) -> tuple[Run | None, list[str] | None]:
    """The run that is most like a table, and the row above it; asides are None."""
    runs: list[Run] = []
    above: dict[int, list[str] | None] = {}
    previous: list[str] | None = None
    for number, row in enumerate(rows):
        if row is None:
            continue
        kinds = tuple(map(cells.kind, row))
        merged = merge(runs[-1].kinds, kinds) if runs else None
        if merged is not None:
            runs[-1].rows.append(row)
            runs[-1] = Run(runs[-1].first, runs[-1].rows, merged)
        elif valued(kinds):
            runs.append(Run(number, [row], kinds))
            above[number] = previous
        else:
            runs.append(Run(number, [], ("text",)))
        previous = row
    tables = [run for run in runs if valued(run.kinds)]
    if not tables:
        return None, None
    best = max(tables, key=lambda run: likeness(run, run is tables[-1]))
    return best, above[best.first]


def likeness(run: Run, last: bool) -> float:
    """How much a run is like the body of a table, which goes on to the end."""
    return min(len(run.rows), LONG) * quality(run) ** 2 * (4 if last else 1)


def merge(one: tuple[str, ...], other: tuple[str, ...]) -> tuple[str, ...] | None:
    """Kinds of a run that is one row longer, or None where the row is of other kinds."""
    if len(one) != len(other) or not (valued(one) and any(kind != "text" for kind in other)):
        return None
    merged = []
    for a, b in zip(one, other, strict=True):
        if a != b and "missing" not in (a, b):
            return None
        merged.append(b if a == "missing" else a)
    return tuple(merged)


def valued(kinds: Sequence[str]) -> bool:
    """Whether any cell is a number or a time."""
    return "number" in kinds or "time" in kinds


def quality(run: Run) -> float:
    """Share of the columns that hold numbers or times."""
    known = [kind for kind in run.kinds if kind != "missing"]
    return sum(kind != "text" for kind in known) / len(known)


def fits(above: list[str] | None, run: Run, separator: str) -> bool:
    """Whether the row above a run has as many cells, give or take an empty last column."""
    if above is None:
        return True
    if not separator:
        return not any(sign in above[0] for sign in "\t;,|")
    width = len(run.kinds) - (run.kinds[-1] == "missing")
    return len(trimmed(above)) in (len(run.kinds), width) or len(above) == len(run.kinds)


def trimmed(row: list[str]) -> list[str]:
    """A row without empty cells at its end."""
    end = len(row)
    while end and not row[end - 1]:
        end -= 1
    return row[:end]


def signs(run: Run, separator: str) -> tuple[str, str | None]:
    """Decimal sign and the sign between thousands."""
    numbers = [cell for row in run.rows for cell in row if cells.is_number(cell)]
    comma = any(map(cells.COMMA.match, numbers))
    point = any(map(cells.POINT.match, numbers))
    groups = {found[1] for found in map(cells.THOUSANDS.match, numbers) if found}
    if comma and not point:
        decimal = ","
    elif not point and "," in groups and separator != "," and not repeated(numbers, ","):
        # 1,234 between semicolons: nobody who writes so has thousands in mind.
        decimal = ","
    else:
        decimal = "."
    groups.discard(decimal)
    # A point is a thousand's only beside decimal commas: 1.234 alone is a number.
    certain = [sign for sign in sorted(groups) if sign != "." or decimal == ","]
    return decimal, certain[0] if certain else None


def repeated(numbers: Sequence[str], sign: str) -> bool:
    """Whether a number has the sign twice, as only thousands have it."""
    return any(cell.count(sign) > 1 for cell in numbers)
