"""Columns by name, and their cells as numbers."""

from __future__ import annotations

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from forgetting.words.errors import RecordError
from forgetting.words.suggestion import suggestion


def resolve(frame: pd.DataFrame, name: str, source: str) -> str:
    """Return `name` when the table has it; the error otherwise lists the columns there are."""
    if name in frame.columns:
        return name
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
    parsed = pd.to_numeric(column, errors="coerce")
    # Dates are numbers to pandas (nanoseconds); nobody means that.
    if pd.api.types.is_datetime64_any_dtype(column):
        raise RecordError(f"column {name!r} of {source} holds times, not numbers")
    text = np.flatnonzero(parsed.isna() & column.notna())
    if len(text):
        row = int(text[0])
        raise RecordError(
            f"column {name!r} of {source} must hold numbers, "
            f"but row {row + 1} is {str(column.iloc[row])!r}"
        )
    values = parsed.to_numpy(dtype=np.float64, na_value=np.nan)
    infinite = np.flatnonzero(np.isinf(values))
    if len(infinite):
        row = int(infinite[0])
        raise RecordError(f"column {name!r} of {source} is infinite in row {row + 1}")
    return np.asarray(values, dtype=np.float64)
