"""Columns by name, and their cells as numbers."""

from __future__ import annotations

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from forgetting.record.names import twins
from forgetting.words.errors import RecordError
from forgetting.words.suggestion import suggestion

SHOWN = 60
"""Characters of a cell that a message shows."""


def resolve(frame: pd.DataFrame, name: str, source: str) -> str:
    """Return `name` when the table has it; the error otherwise lists the columns there are."""
    if name in frame.columns:
        return name
    same = twins(frame.columns, name)
    if same:
        raise RecordError(
            f"{source} has {len(same)} columns named {name!r}; "
            f"say which: {', '.join(map(repr, same))}"
        )
    among = suggestion([str(column) for column in frame.columns], name, "its columns are")
    raise RecordError(f"{source} has no column {name!r}{among}")


def numbers(frame: pd.DataFrame, name: str, source: str) -> NDArray[np.float64]:
    """Return a column as float64 with NaN for missing cells.

    Raises
    ------
    RecordError
        When the column is unknown, or a cell holds text or an infinite value; the message names
        column, row (counted from 1 below the header) and value.
    """
    column = frame[resolve(frame, name, source)]
    # Dates are numbers to pandas (nanoseconds); nobody means that.
    if pd.api.types.is_datetime64_any_dtype(column) or isinstance(column.dtype, pd.PeriodDtype):
        raise RecordError(f"column {name!r} of {source} holds times, not numbers")
    if column.dtype.kind == "c":
        raise RecordError(
            f"column {name!r} of {source} holds complex numbers; give their parts, "
            "such as real and imaginary, as columns"
        )
    parsed = to_numbers(column)
    text = np.flatnonzero(parsed.isna() & column.notna())
    if len(text):
        row = int(text[0])
        raise RecordError(
            f"column {name!r} of {source} must hold numbers, "
            f"but row {row + 1} is {str(column.iloc[row])[:SHOWN]!r}; "
            "if that means that the value is missing, say so by --missing"
        )
    plain = parsed.dtype == np.float64  # no copy then
    values = parsed.to_numpy() if plain else parsed.to_numpy(dtype=np.float64, na_value=np.nan)
    infinite = np.flatnonzero(np.isinf(values))
    if len(infinite):
        row = int(infinite[0])
        raise RecordError(f"column {name!r} of {source} is infinite in row {row + 1}")
    return np.asarray(values, dtype=np.float64)


def to_numbers(column: pd.Series) -> pd.Series:
    """Numbers of a column, NaN for what is none; the column itself where it is float64."""
    if column.dtype == np.float64:
        return column
    try:
        parsed = pd.to_numeric(column, errors="coerce")
    except TypeError:
        # Cells that are no scalars, such as lists.
        return pd.Series(np.nan, index=column.index)
    return parsed if parsed.dtype.kind in "fiub" else pd.Series(np.nan, index=column.index)
