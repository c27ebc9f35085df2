"""How the lines of a stream are written: JSON objects, or cells between separators under names."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass, field
from typing import Any

import pandas as pd

from forgetting.record.columns import resolve
from forgetting.record.formats import cells
from forgetting.record.formats.dialect import NAMES, SEPARATORS, dialect, is_aside, split
from forgetting.record.formats.layout import is_below, unit_like
from forgetting.record.names import clean, distinct
from forgetting.words.errors import RecordError

WORDS = {word: sign for sign, word in NAMES.items()} | {"space": " ", "tabulator": "\t"}
"""Separators that have a name, for shells in which they are hard to type."""


@dataclass(frozen=True)
class Form:
    """How a line becomes values.

    Attributes
    ----------
    kind : str
        "delimited" or "json".
    names : tuple of str
        The columns; of JSON the keys of the first object.
    separator, decimal : str
        Between cells, and within numbers.
    header : str
        The line of names as it was, to be known again; empty without one.
    unit_line : str
        The line of units below it as it was; empty without one.
    units : dict of str to str
        Unit of each column that has one.
    """

    kind: str
    names: tuple[str, ...]
    separator: str = ""
    decimal: str = "."
    header: str = ""
    unit_line: str = ""
    units: dict[str, str] = field(default_factory=dict)

    def column(self, name: str) -> str:
        """A column's name, if there is such a column; the error lists those there are."""
        return resolve(pd.DataFrame(columns=list(self.names)), name, "the stream")

    def state(self) -> dict[str, Any]:
        """As `restored` takes it."""
        return asdict(self)

    @classmethod
    def restored(cls, state: dict[str, Any]) -> Form:
        """The form of a saved state."""
        return cls(**(state | {"names": tuple(state["names"])}))

    def is_header(self, line: str) -> bool:
        """Whether a line is that of the names, or that of their units."""
        return bool(line.strip()) and line.strip() in (self.header, self.unit_line)

    def check_first(self, line: str) -> None:
        """Refuse the first line of a further input when it holds other names.

        Words alone are names when one of them is, or when they are as many; else they are rubbish.

        Raises
        ------
        RecordError
            Since numbers under other names would be taken for those of before.
        """
        if self.kind == "json" or self.is_header(line) or is_aside(line):
            return
        row = split(line, self.separator)
        words = all(cells.kind(cell) == "text" for cell in row)
        if words and (set(row) & set(self.names) or len(row) == len(self.names) > 1):
            raise RecordError(
                f"the input begins with {line.strip()[:200]!r}, but the columns so far are "
                f"{', '.join(map(repr, self.names))}"
            )


def recognised(
    lines: Sequence[str], separator: str | None, names: Sequence[str] | None
) -> Form | None:
    """The form of a stream that begins with these lines; None while it cannot be told.

    Parameters
    ----------
    lines : sequence of str
        The first three lines, or as many as there are, without blank ones and comments.
    separator : str or None
        Given, else found in the line of names and the first line of numbers.
    names : sequence of str or None
        Given, for a stream without a line of names.

    Raises
    ------
    RecordError
        When no line has a number or a time where a table has them.
    """
    if not lines:
        return None
    first = lines[0].strip()
    if "\r" in first:
        raise RecordError(
            "the lines of the stream end with a carriage return alone; end them with a line feed"
        )
    if first.startswith("{"):
        return of_object(first)
    unit_line = lines[1].strip() if has_units(lines, separator) else ""
    table = [first, *lines[2 if unit_line else 1 :][:1]]
    if len(table) < 2 and (names is None or unit_line):
        return None
    found = dialect(table if separator is None else [retold(each, separator) for each in table])
    if found is None:
        raise RecordError(
            f"the stream begins with {first[:200]!r}, and no numbers stand below it; the first "
            "line holds the names of the columns, unless --names gives them"
        )
    sign = found.separator if separator is None else separator
    own = tuple(distinct(split(first, sign) if names is None else names))
    has_header = names is None or split(first, sign) == list(names)
    units = units_of(own, split(unit_line, sign)) if unit_line and has_header else {}
    if not units:
        unit_line = ""
    header = first if has_header else ""
    return Form("delimited", own, sign, found.decimal, header, unit_line, units)


def has_units(lines: Sequence[str], separator: str | None) -> bool:
    """Whether the second line holds units of the names in the first, split in any way.

    Numbers are none, but for the 1 of what has no unit.
    """
    if len(lines) < 2:
        return False
    for sign in SEPARATORS if separator is None else (separator,):
        names, row = split(lines[0], sign), split(lines[1], sign)
        if len(row) != len(names) or (sign and len(row) < 2):
            continue
        words = all(cells.kind(cell) == "text" or cell in ("", "-", "1") for cell in row)
        if words and row != names and unit_like(row) and is_below(row, names):
            return True
    return False


def units_of(names: Sequence[str], row: Sequence[str]) -> dict[str, str]:
    """Units by name; a remark, or the sign of none, is no unit."""
    pairs = zip(names, map(cells.bare, row), strict=False)
    return {name: unit for name, unit in pairs if unit}


def retold(line: str, separator: str) -> str:
    """The line with tabs between its cells, which no other separator is taken for."""
    return "\t".join(split(line, separator))


def of_object(line: str) -> Form:
    """The form of JSON lines, named by the first object."""
    try:
        found = json.loads(line)
    except ValueError as error:
        raise RecordError(f"the first line of the stream is no JSON object: {error}") from None
    return Form("json", tuple(clean(name) for name in found))


def separator_of(text: str | None) -> str | None:
    """A separator as it is given: the sign itself, or its name.

    Examples
    --------
    >>> separator_of(";"), separator_of("tab"), separator_of("\\\\t"), separator_of(None)
    (';', '\\t', '\\t', None)
    """
    if text is None:
        return None
    sign = WORDS.get(text.lower(), text.replace("\\t", "\t"))
    if sign not in SEPARATORS or not sign:
        known = ", ".join(repr(NAMES[each]) for each in SEPARATORS if each)
        raise RecordError(f"--separator is {text!r}; it must be one of , ; | or a name: {known}")
    return sign
