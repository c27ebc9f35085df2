"""Names of columns as one can type and print them: one line, none empty, none twice."""

from __future__ import annotations

import re
from collections.abc import Iterable

UNPRINTABLE = re.compile(r"[\x00-\x20\x7f-\xa0\u200b\u2028\u2029\ufeff\ud800-\udfff]+")


def clean(name: object) -> str:
    """A name on one line, without spaces around it.

    Examples
    --------
    >>> clean(" Temp\\n[°C] ")
    'Temp [°C]'
    """
    return UNPRINTABLE.sub(" ", str(name)).strip()


def distinct(names: Iterable[object]) -> list[str]:
    """Names that differ: a column without a name is numbered, one of several is told apart.

    Examples
    --------
    >>> distinct(["I", "Units", "V", "Units", ""])
    ['I', 'Units (column 2)', 'V', 'Units (column 4)', 'column 5']
    """
    cleaned = [clean(name) for name in names]
    cleaned = [name or f"column {place}" for place, name in enumerate(cleaned, start=1)]
    return [
        f"{name} (column {place})" if cleaned.count(name) > 1 else name
        for place, name in enumerate(cleaned, start=1)
    ]


def twins(names: Iterable[str], name: str) -> list[str]:
    """The columns that all bore this name before they were told apart.

    Examples
    --------
    >>> twins(distinct(["x", "y", "x"]), "x")
    ['x (column 1)', 'x (column 3)']
    """
    return [each for each in names if re.fullmatch(re.escape(name) + r" \(column \d+\)", each)]
