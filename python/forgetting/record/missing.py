"""Words and numbers that stand for missing values."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from numbers import Number
from typing import Any

import numpy as np
import pandas as pd

from forgetting.record.columns import to_numbers
from forgetting.record.formats import cells

Words = Sequence[str | float]

FIRST = 100
"""Cells that are looked at one by one before a whole column is."""


def is_text(column: pd.Series) -> bool:
    """Whether a column may hold text."""
    return bool(pd.api.types.is_object_dtype(column) or pd.api.types.is_string_dtype(column))


def without_words(frame: pd.DataFrame, missing: Words) -> tuple[pd.DataFrame, Counter[str]]:
    """Make numbers of the columns in which all text is a word for a missing value.

    Parameters
    ----------
    frame : pandas.DataFrame
    missing : sequence of str or float
        Words beside the usual ones; see `forgetting.record.formats.cells.MISSING`.

    Returns
    -------
    frame, counts
        The table, and how often each word was met.
    """
    words = cells.MISSING | {str(word).strip().lower() for word in missing}
    counts: Counter[str] = Counter()
    changed: dict[str, pd.Series] = {}
    for name in frame.columns:
        if is_text(frame[name]):
            numbers, met = as_numbers(frame[name], words)
            if numbers is not None:
                changed[name] = numbers
                counts += met
    return (frame.assign(**changed) if changed else frame), counts


def as_numbers(column: pd.Series, words: frozenset[str]) -> tuple[pd.Series | None, Counter[str]]:
    """The column as numbers, or None where it holds other text than the words."""
    if any(is_other(cell, words) for cell in column.dropna().head(FIRST)):
        return None, Counter()
    parsed, odd = converted(column)
    if odd.any():
        others = column[odd].astype(str).str.strip()
        word = others.str.lower().isin(words)
        if not word.all() and all(map(cells.COMMA.match, others[~word].unique())):
            comma = column.where(~odd, others.str.replace(",", ".", regex=False))
            if not column[~odd].astype(str).str.contains(".", regex=False).any():
                return as_numbers(comma, words)
        if not word.all():
            return None, Counter()
        return parsed, Counter(others[others != ""])
    return parsed, Counter()


def is_other(cell: object, words: frozenset[str]) -> bool:
    """Whether a cell is neither a number nor a word for a missing value."""
    if not isinstance(cell, str):
        return not isinstance(cell, Number)
    text = cell.strip()
    return not (cells.is_number(text) or is_float(text) or text.lower() in words)


def is_float(text: str) -> bool:
    """Whether Python reads a number, infinity included."""
    return number_of(text) is not None


def converted(column: pd.Series) -> tuple[pd.Series, pd.Series]:
    """Numbers where there are some, and where there is something else."""
    parsed = to_numbers(column)
    return parsed, parsed.isna() & column.notna()


def without_numbers(
    frame: pd.DataFrame, missing: Words, but: Sequence[str]
) -> tuple[pd.DataFrame, Counter[str]]:
    """Make numbers such as −200 missing in all columns of numbers but those named."""
    given = [number for number in map(number_of, missing) if number is not None]
    counts: Counter[str] = Counter()
    changed: dict[str, Any] = {}
    for name in frame.columns if given else ():
        column = frame[name]
        if name in but or column.dtype.kind not in "fiu":
            continue
        marked = column.isin(given)
        if marked.any():
            counts += Counter(f"{value:g}" for value in column[marked].tolist())
            changed[name] = column.astype(np.float64).mask(marked)
    return (frame.assign(**changed) if changed else frame), counts


def number_of(word: str | float) -> float | None:
    """The number that a word is, if it is one."""
    try:
        return float(word)
    except ValueError:
        return None
