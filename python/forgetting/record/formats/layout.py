"""Where the table begins: lines before it, its names, its units, its first row."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from forgetting.record.formats import cells
from forgetting.record.formats.dialect import trimmed

HALF = 0.5
VALUES = ("number", "time")
"""Kinds of cells that are values."""
AMONG = 20
"""A header stands below at most this many lines that could be rows of the table themselves."""


@dataclass(frozen=True)
class Layout:
    """The rows of a table that are not its numbers.

    Attributes
    ----------
    names : list of str
        One per column; empty where there is none.
    units : dict of int to str
        Unit by position.
    header : int or None
        Row with the names, counted from 0.
    first : int
        The first row of numbers.
    below : int
        Rows between names and numbers that are neither; their content is not used.
    """

    names: list[str]
    units: dict[int, str] = field(default_factory=dict)
    header: int | None = None
    first: int = 0
    below: int = 0


def layout(rows: Sequence[list[str] | None], kinds: Sequence[str]) -> Layout | None:
    """Find the names and the first row of numbers.

    Parameters
    ----------
    rows : sequence of list of str or None
        The first rows of the file as cells; None for a blank row.
    kinds : sequence of str
        Kind of each column in the body of the table.

    Returns
    -------
    Layout or None
        None while no row of the body is among them.
    """
    alone = None
    before = 0
    for number, row in enumerate(rows):
        if row is None or not is_data(row, kinds):
            continue
        first = over_bad_cells(rows, number, kinds)
        header = above(rows, first, kinds)
        if header:
            return named(rows, header, first, len(kinds))
        alone = number if alone is None else alone
        before += 1
        if before > AMONG:
            break
    return None if alone is None else Layout([""] * len(kinds), first=alone)


def is_data(row: list[str], kinds: Sequence[str]) -> bool:
    """Whether a row can belong to the body: numbers where the body has numbers."""
    short = trimmed(row)
    if not short or len(short) > len(kinds):
        return False
    found = [cells.kind(cell) for cell in row[: len(kinds)]]
    pairs = list(zip(found, kinds, strict=False))
    fine = all(have != "text" for have, want in pairs if want in VALUES)
    return fine and any(have in VALUES for have, want in pairs if want in VALUES)


def over_bad_cells(rows: Sequence[list[str] | None], first: int, kinds: Sequence[str]) -> int:
    """Go up over rows of the table in which some cell is no number, though others are."""
    number = first
    while number and has_some(rows[number - 1], kinds):
        number -= 1
    return number


def has_some(row: list[str] | None, kinds: Sequence[str]) -> bool:
    """Whether a row is as wide as the table and has a number where the table has numbers."""
    if row is None or len(row) != len(kinds) or len(kinds) < 2:
        return False
    pairs = zip(map(cells.kind, row), kinds, strict=True)
    return any(have in VALUES for have, want in pairs if want in VALUES)


def above(rows: Sequence[list[str] | None], first: int, kinds: Sequence[str]) -> list[int]:
    """Rows of words directly above a row of numbers, lowest first."""
    found: list[int] = []
    for number in range(first - 1, -1, -1):
        row = rows[number]
        if row is None:
            if found and not unit_like(rows[found[-1]] or []):
                break
            continue
        if not is_words(row, kinds):
            break
        found.append(number)
    return found


def is_words(row: list[str], kinds: Sequence[str]) -> bool:
    """Whether a row could hold names or units: as wide as the table, no number among numbers."""
    width = len(trimmed(row))
    if not width or not (len(row) == len(kinds) or width in (len(kinds), len(kinds) - 1)):
        return width > len(kinds) and all(cells.kind(cell) == "text" for cell in trimmed(row))
    words = [cells.kind(cell) == "text" for cell in row[: len(kinds)] if cell]
    return sum(words) > len(words) / 2


def named(rows: Sequence[list[str] | None], header: list[int], first: int, width: int) -> Layout:
    """Tell names from the rows of units below them."""
    place = 0
    while place + 1 < len(header) and is_below(rows[header[place]], rows[header[place + 1]]):
        place += 1
    names = trimmed(rows[header[place]] or [])
    units: dict[int, str] = {}
    spare = place
    for number in header[:place][::-1]:
        row = rows[number] or []
        if not units and unit_like(row):
            units = {i: cells.bare(cell) for i, cell in enumerate(row) if cells.bare(cell)}
            spare -= bool(units)
    return Layout(padded(names, width), units, header[place], first, spare)


def padded(names: list[str], width: int) -> list[str]:
    """Names for every column; more names than columns stay, so that the caller can see it."""
    return names + [""] * max(width - len(names), 0)


def is_below(row: list[str] | None, over: list[str] | None) -> bool:
    """Whether a row stands below the names, which are in the row over it."""
    row, names = row or [], trimmed(over or [])
    share = unit_share(row)
    if share >= max(HALF, unit_share(names)) and len(trimmed(row)) <= len(names):
        return True
    filled = [name for name in names if name]
    own = [cell for cell, name in zip(row, names, strict=False) if name]
    repeats = len(set(own)) < len(own) or not all(own)
    return len(set(filled)) == len(filled) == len(own) and repeats


def unit_share(row: list[str]) -> float:
    """Share of the filled cells of a row that are units or remarks."""
    filled = [cell for cell in row if cell]
    return sum(map(cells.is_unit, filled)) / len(filled) if filled else 0.0


def unit_like(row: list[str]) -> bool:
    """Whether at least half of the cells of a row are units or remarks."""
    return unit_share(row) >= HALF
