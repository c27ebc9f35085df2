"""Which column is the clock, found by what it holds and how it runs."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from datetime import date, time
from itertools import islice

import numpy as np
import pandas as pd

from forgetting.record.clock.clock import Clock
from forgetting.record.clock.numeric import from_numbers, is_date
from forgetting.record.clock.text import from_text
from forgetting.record.clock.times import Times
from forgetting.record.clock.units import is_named_time, sounds_like_time, unit_of
from forgetting.record.columns import SHOWN, resolve
from forgetting.record.formats.cells import is_time
from forgetting.record.missing import is_text
from forgetting.words.errors import RecordError

ONWARD = 0.6
"""A column runs like time when at least this share of its steps does not go back."""
UNNAMED = re.compile(r"column \d+")
YMD = ("year", "month", "day", "hour", "minute", "second")


def find_clock(
    frame: pd.DataFrame,
    named: str | None,
    gap: float | None,
    units: Mapping[str, str],
    source: str,
) -> Clock | None:
    """Return the clock of a table.

    Parameters
    ----------
    frame : pandas.DataFrame
        The record.
    named : str or None
        The column to take, two with a comma for date and time, or "none" for no clock.
    gap : float or None
        Seconds above which a step is a gap.
    units : mapping of str to str
        Units of columns.
    source : str
        The record's name, for messages.
    """
    if named is not None and named not in frame.columns and named.strip().lower() == "none":
        return None
    name, times = guess(frame, units) if named is None else asked(frame, named, units, source)
    if times is None:
        return None
    values = times.values.reset_index(drop=True)
    return Clock(values, name, times.kind, times.scale, times.daily, gap)


def asked(
    frame: pd.DataFrame, named: str, units: Mapping[str, str], source: str
) -> tuple[str, Times]:
    """Read the column that the user named."""
    if named not in frame.columns and named.count(",") == 1:
        day, hour = (resolve(frame, part.strip(), source) for part in named.split(","))
        both = together(frame, day, hour, units)
        if both is None:
            raise RecordError(f"columns {day!r} and {hour!r} of {source} are no date and time")
        return f"{day} + {hour}", both
    column = resolve(frame, named, source)
    times = read(frame[column], column, units)
    if times is None or times.values.notna().sum() == 0:
        raise RecordError(
            f"column {column!r} of {source} holds no times: {example(frame[column], column, units)}"
        )
    return column, times


def guess(frame: pd.DataFrame, units: Mapping[str, str]) -> tuple[str, Times | None]:
    """Take the column that runs most like time, if there is any that does."""
    able = [
        (name, times)
        for name, times in candidates(frame, units)
        if times.onward() >= ONWARD and times.values.notna().mean() >= 0.5
    ]
    # Of equals the first is taken.
    worth = [(times.forward(), is_named_time(name)) for name, times in able]
    return able[worth.index(max(worth))] if able else ("", None)


def candidates(frame: pd.DataFrame, units: Mapping[str, str]) -> Iterator[tuple[str, Times]]:
    """Columns that could be the clock, dates joined with their times of day first."""
    found = {}
    for place, name in enumerate(frame.columns):
        if may_be_time(frame[name], name, place == 0, units):
            times = read(frame[name], name, units)
            if times is not None:
                found[name] = times
    parts = year_month_day(frame)
    if parts is not None:
        yield parts
    days = [name for name, times in found.items() if times.is_date and times.forward() < 1]
    for day in days:
        for hour in found:
            both = together(frame, day, hour, units) if found[hour].daily else None
            if both is not None:
                yield f"{day} + {hour}", both
    yield from found.items()


def may_be_time(column: pd.Series, name: str, first: bool, units: Mapping[str, str]) -> bool:
    """Whether it is worth reading a column as time."""
    if is_text(column):
        known = column.dropna()
        return bool(len(known)) and looks_like_time(known.iloc[0])
    if not pd.api.types.is_numeric_dtype(column) or column.dtype.kind not in "fiu":
        return pd.api.types.is_datetime64_any_dtype(column) or column.dtype.kind == "m"
    timed = unit_of(name, units.get(name)) is not None
    unnamed = first and UNNAMED.fullmatch(name) is not None and is_date(column, months=True)
    hinted = unnamed or (sounds_like_time(name) and (timed or name not in units))
    return hinted or (timed and (first or name in units)) or (first and is_date(column))


def looks_like_time(cell: object) -> bool:
    """Whether a cell of text or an object is a time."""
    return isinstance(cell, date | time) or is_time(str(cell).strip())


def read(column: pd.Series, name: str, units: Mapping[str, str]) -> Times | None:
    """Read any column as time, or None where a cell is none."""
    if pd.api.types.is_datetime64_any_dtype(column):
        return Times(column, "date-times")
    if isinstance(column.dtype, pd.PeriodDtype):
        return Times(column.dt.to_timestamp(), "periods")
    if column.dtype.kind == "m":
        return Times(column.dt.total_seconds(), "durations")
    if pd.api.types.is_bool_dtype(column) or column.dtype.kind == "c":
        return None
    if pd.api.types.is_numeric_dtype(column):
        finite = column.replace([np.inf, -np.inf], np.nan)
        return from_numbers(finite, unit_of(name, units.get(name)))
    return from_text(column)


def together(frame: pd.DataFrame, day: str, hour: str, units: Mapping[str, str]) -> Times | None:
    """Join a column of dates and one of times of day."""
    date_of, time_of = read(frame[day], day, units), read(frame[hour], hour, units)
    if date_of is None or time_of is None or not date_of.is_datetime or time_of.is_datetime:
        return None
    try:
        joined = date_of.values + pd.to_timedelta(time_of.values * time_of.scale, unit="s")
    except (ValueError, OverflowError):
        # Beyond the dates that pandas has.
        return None
    return Times(joined, f"{date_of.kind}, and times of day")


def year_month_day(frame: pd.DataFrame) -> tuple[str, Times] | None:
    """Join columns named year and month, and day, hour, minute, second where they are."""
    columns = {str(name).lower(): name for name in frame.columns}
    present = [part for part in YMD if part in columns]
    if present[:2] != list(YMD[:2]):
        return None
    try:
        table = frame[[columns[part] for part in present]].set_axis(present, axis=1)
        values = pd.to_datetime(table if "day" in present else table.assign(day=1))
    except (ValueError, TypeError):
        return None
    return " + ".join(str(columns[part]) for part in present), Times(values, "date-times")


def example(column: pd.Series, name: str, units: Mapping[str, str]) -> str:
    """Name the first cell that is no time, for an error."""
    if column.notna().sum() == 0:
        return "it is empty"
    for row, cell in islice(enumerate(column, start=1), 10_000):
        if pd.notna(cell) and read(pd.Series([cell]), name, units) is None:
            return f"row {row} is {str(cell)[:SHOWN]!r}"
    return "its cells do not share one format"
