"""How the lines of a stream are written: JSON objects, or cells between separators under names."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any

import pandas as pd

from forgetting.record.columns import resolve
from forgetting.record.formats import cells
from forgetting.record.formats.dialect import NAMES, SEPARATORS, dialect, is_aside, split
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
    """

    kind: str
    names: tuple[str, ...]
    separator: str = ""
    decimal: str = "."
    header: str = ""

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
        """Whether a line is that of the names."""
        return bool(self.header) and line.strip() == self.header

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
        The first lines, without blank ones and comments.
    separator : str or None
        Given, else found in the line of names and the first line below it.
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
    if first.startswith("{"):
        return of_object(first)
    if names is None and len(lines) < 2:
        return None
    found = dialect(lines[:2] if separator is None else [retold(each, separator) for each in lines])
    if found is None:
        raise RecordError(
            f"the stream begins with {first[:200]!r}, and no numbers stand below it; the first "
            "line holds the names of the columns, unless --names gives them"
        )
    sign = found.separator if separator is None else separator
    if names is not None:
        own = tuple(distinct(names))
        has_header = split(first, sign) == list(names)
        return Form("delimited", own, sign, found.decimal, first if has_header else "")
    return Form("delimited", tuple(distinct(split(first, sign))), sign, found.decimal, first)


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
