"""Data frames of any library as one of pandas."""

from __future__ import annotations

from typing import Any

import narwhals as nw
import pandas as pd

from forgetting.words.errors import RecordError


def to_pandas(frame: Any) -> pd.DataFrame:
    """Convert by narwhals, by Arrow's protocol, or by the frame's own way to pandas."""
    if hasattr(frame, "to_dataframe") and type(frame).__module__.startswith("xarray"):
        return labelled(frame)
    try:
        table: pd.DataFrame = nw.from_native(frame, eager_only=True).to_pandas()
    except TypeError:
        if hasattr(frame, "__arrow_c_stream__") and not isinstance(frame, pd.Series):
            return by_arrow(frame)
        raise refused(frame) from None
    except ValueError:
        # narwhals refuses a name that occurs twice, which may be a column that nobody uses.
        if isinstance(frame, pd.DataFrame):
            return frame
        raise refused(frame) from None
    return table


def by_arrow(frame: Any) -> pd.DataFrame:
    """Convert what shows itself as a stream of Arrow batches."""
    try:
        return nw.from_arrow(frame, backend="pyarrow").to_pandas()
    except (TypeError, ValueError, ImportError):
        raise refused(frame) from None


def labelled(data: Any) -> pd.DataFrame:
    """Convert an array or data set of xarray that has one dimension."""
    if len(data.dims) != 1:
        raise RecordError(
            f"a record has one dimension, its rows, but the data of xarray have {len(data.dims)}: "
            f"{', '.join(map(str, data.dims))}"
        )
    named = data if not hasattr(data, "name") or data.name is not None else data.rename("value")
    table: pd.DataFrame = named.to_dataframe()
    return table


def refused(frame: Any) -> RecordError:
    """What to say of something that is no table."""
    kind = f"{type(frame).__module__}.{type(frame).__name__}"
    return RecordError(f"a record is a file or a data frame in memory, but got {kind}")


def with_index(frame: pd.DataFrame) -> pd.DataFrame:
    """Make an index that holds times, or has a name, the first column; drop plain row numbers."""
    index = frame.index
    if isinstance(index, pd.MultiIndex):
        return frame.reset_index()
    timed = isinstance(index, pd.DatetimeIndex | pd.TimedeltaIndex | pd.PeriodIndex)
    if not timed and index.name is None:
        return frame.reset_index(drop=True)
    values = pd.Series(index)
    frame = frame.reset_index(drop=True)
    frame.insert(0, "time" if index.name is None else index.name, values, allow_duplicates=True)
    return frame
