"""Numbers as time: dates written as 20240105, seconds since 1970, or a time that elapsed."""

from __future__ import annotations

from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from forgetting.record.clock.times import Times
from forgetting.words.duration import SECONDS

WRITTEN = (
    (190001, 210012, "%Y%m", "months written as yyyymm"),
    (19000101, 21001231, "%Y%m%d", "dates written as yyyymmdd"),
    (1900010100, 2100123123, "%Y%m%d%H", "times written as yyyymmddhh"),
    (190001010000, 210012312359, "%Y%m%d%H%M", "times written as yyyymmddhhmm"),
    (19000101000000, 21001231235959, "%Y%m%d%H%M%S", "times written as yyyymmddhhmmss"),
)
EPOCH = (("s", 1.0), ("ms", 1e3), ("us", 1e6), ("ns", 1e9))
"""Units of time since 1970, and how many make a second."""
SINCE, UNTIL = 3e8, 5e9
"""Seconds since 1970 that are taken for a date: 1979 to 2128."""


def from_numbers(column: pd.Series, unit: str | None) -> Times:
    """Read numbers as time; without another sign they are seconds.

    Parameters
    ----------
    column : pandas.Series
        Numbers.
    unit : str or None
        Unit of time that the file names.
    """
    values = column.astype(np.float64)
    dates = as_written(values) or since_1970(column, unit)
    if dates is not None:
        return dates
    if unit is None:
        return Times(values, "numbers, taken as seconds")
    return Times(values, f"numbers in {unit}", SECONDS[unit.lower()])


def is_date(column: pd.Series, months: bool = False) -> bool:
    """Whether all numbers are dates of day and year (or months alone), or times since 1970."""
    written = as_written(column.astype(np.float64))
    if written is not None:
        return months or "months" not in written.kind
    return since_1970(column, None) is not None


def as_written(values: pd.Series) -> Times | None:
    """Read dates written as one number."""
    known = values.dropna()
    if known.empty or not bool((known == np.floor(known)).all()):
        return None
    low, high = known.min(), known.max()
    for first, last, form, kind in WRITTEN:
        if first <= low and high <= last:
            digits = values.astype("Int64").astype("string")
            parsed = pd.to_datetime(digits, format=form, errors="coerce")
            if parsed.notna().equals(values.notna()):
                return Times(parsed, kind)
    return None


def since_1970(column: pd.Series, unit: str | None) -> Times | None:
    """Read numbers as time since 1970, in the unit in which they would be of our days."""
    known = column.dropna()
    if known.empty:
        return None
    low, high = float(known.min()), float(known.max())
    for name, count in EPOCH:
        if unit is not None and same(name) != same(unit):
            continue
        if SINCE * count <= low and high <= UNTIL * count:
            return Times(at(column, name, count), f"{name} since 1970")
    return None


def same(unit: str) -> str:
    """One spelling of a unit."""
    seconds = SECONDS[unit.lower()]
    return {1.0: "s", 1e-3: "ms", 1e-6: "us", 1e-9: "ns"}.get(seconds, unit)


def at(column: pd.Series, unit: Any, count: float) -> pd.Series:
    """Date-times of numbers since 1970, to the nanosecond where they are whole."""
    if column.dtype.kind in "iu":
        return pd.Series(pd.to_datetime(column, unit=unit), index=column.index)
    whole: NDArray[np.float64] = np.floor(column.to_numpy(dtype=np.float64))
    rest = column.to_numpy(dtype=np.float64) - whole
    base = pd.to_datetime(pd.Series(whole, index=column.index).astype("Int64"), unit=unit)
    # Of 1700000000.25 a float64 knows 2e-7; more digits of a nanosecond would be rounding.
    nanoseconds = np.nan_to_num(np.round(rest / count * 1e7) * 100).astype(np.int64)
    return pd.Series(
        base.dt.as_unit("ns") + pd.to_timedelta(nanoseconds, unit="ns"), index=column.index
    )
