"""Columns that were measured at several rates, joined to one clock."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from forgetting.record.names import clean
from forgetting.words.duration import seconds_of
from forgetting.words.errors import RecordError

if TYPE_CHECKING:
    from forgetting.record.clock import Clock
    from forgetting.record.read import Record

Array = NDArray[np.float64]
ROUNDING = 1e-6
"""Share of a step by which a time may miss its tick."""
MOST = 100_000_000
"""Most ticks of a clock."""
HOW = {"hold": "the last value", "mean": "the mean since the last tick", "nearest": "the nearest"}


def at_one_rate(
    record: Record,
    every: str | float,
    *,
    hold: Sequence[str] = (),
    mean: Sequence[str] = (),
    nearest: Sequence[str] = (),
    age: str | float | None = None,
) -> Record:
    """Join the columns of a record to one clock.

    Parameters
    ----------
    record : Record
        With a clock. A column has values in some of its rows, at a rate of its own.
    every : str or float
        The step of the clock, such as "1s" or 0.5 (seconds), from the first row that has a time.
    hold, mean, nearest : sequence of str
        Columns of which a tick takes the last value at or before it, the mean of the values since
        the tick before, or the value nearest to it within half a step. All others are held.
    age : str or float, optional
        How old a held value, or how far a nearest one, may be. Without it a held value has no age.

    Returns
    -------
    Record
        One row a tick, NaN where a column has no such value; columns without numbers are left out.

    Raises
    ------
    RecordError
        When the record has no clock, a column does not exist or is named twice, or a duration is
        none.

    Examples
    --------
    >>> from forgetting.record import read
    >>> log = pd.DataFrame({"time": [0.0, 0.5, 1.0, 1.5, 2.0], "y": [1.0, 3.0, 5.0, 7.0, 9.0],
    ...                     "u": [2.0, np.nan, np.nan, 4.0, np.nan]})
    >>> at_one_rate(read(log), "1s", mean=["y"]).frame.to_numpy().tolist()
    [[0.0, 1.0, 2.0], [1.0, 4.0, 2.0], [2.0, 8.0, 4.0]]
    """
    clock = record.clock
    if clock is None:
        raise RecordError(f"{record.name} has no clock, so that its columns have no rates")
    step, oldest = length("every", every), None if age is None else length("age", age)
    how = chosen(record, {"hold": hold, "mean": mean, "nearest": nearest})
    seconds = clock.seconds()
    order = np.argsort(seconds, kind="stable")[: int(np.isfinite(seconds).sum())]
    ticks = ticks_of(seconds[order], step, record.name)
    columns: dict[str, object] = {clock.name: time_of(clock, ticks)}
    left_out = []
    for name in record.frame.columns:
        if name in clock.name.split(" + "):
            continue
        if not pd.api.types.is_numeric_dtype(record.frame[name]):
            left_out.append(f"{name!r}, which holds no numbers")
            continue
        values = record.frame[name].to_numpy(dtype=np.float64, na_value=np.nan)[order]
        there = np.isfinite(values)
        join = JOINS[how.get(name, "hold")]
        columns[name] = join(seconds[order][there], values[there], ticks, step, oldest)
    own = [f"{HOW[kind]} of {name}" for name, kind in how.items()]
    words = f"every {step:g} s" + f" ({', '.join(own)})" * bool(own)
    found = record.found
    details = {**found.details, "joined": words}
    found = replace(found, details=details, skipped=(*found.skipped, *left_out))
    frame = pd.DataFrame(columns)
    joined = replace(clock, values=frame[clock.name], daily=False)
    return replace(record, frame=frame, clock=joined, found=found)


def length(name: str, given: str | float) -> float:
    """A length of time in seconds, above zero."""
    try:
        seconds = seconds_of(given)
    except ValueError as error:
        raise RecordError(f"{name} is {given!r}: {error}") from None
    if not 0 < seconds < np.inf:
        raise RecordError(f"{name} is {given!r}; it must be a length of time above zero")
    return seconds


def chosen(record: Record, named: dict[str, Sequence[str]]) -> dict[str, str]:
    """How each column that is named is joined."""
    how: dict[str, str] = {}
    for kind, names in named.items():
        for name in map(clean, names):
            if name not in record.frame.columns:
                raise RecordError(f"{record.name} has no column {name!r} (named by {kind})")
            if name in how:
                raise RecordError(f"the column {name!r} is named by {how[name]} and by {kind}")
            how[name] = kind
    return how


def ticks_of(seconds: Array, step: float, name: str) -> Array:
    """The ticks from the first time to the last, in seconds."""
    if not len(seconds):
        raise RecordError(f"{name} has no row with a time")
    count = np.floor((seconds[-1] - seconds[0]) / step + ROUNDING) + 1
    if count > MOST:
        raise RecordError(f"{name} would have {count:.3g} rows every {step:g} s; at most {MOST}")
    return np.asarray(seconds[0] + step * np.arange(int(count)))


def time_of(clock: Clock, ticks: Array) -> pd.Series:
    """The ticks as the clock has its times."""
    first = clock.values.dropna().iloc[0]
    if clock.is_datetime:
        return pd.Series(first + pd.to_timedelta(ticks, unit="s"))
    return pd.Series(first + ticks / clock.scale)


def held(times: Array, values: Array, ticks: Array, step: float, age: float | None) -> Array:
    """The last value at or before each tick."""
    place = np.searchsorted(times, ticks + ROUNDING * step, side="right") - 1
    return taken(times, values, ticks, place, np.inf if age is None else age + ROUNDING * step)


def nearest_to(times: Array, values: Array, ticks: Array, step: float, age: float | None) -> Array:
    """The value nearest to each tick."""
    after = np.searchsorted(times, ticks)
    before = np.maximum(after - 1, 0)
    after = np.minimum(after, max(len(times) - 1, 0))
    if not len(times):
        return np.full(len(ticks), np.nan)
    closer = np.abs(times[after] - ticks) < np.abs(times[before] - ticks)
    limit = step / 2 if age is None else age
    return taken(times, values, ticks, np.where(closer, after, before), limit + ROUNDING * step)


def taken(
    times: Array, values: Array, ticks: Array, place: NDArray[np.intp], limit: float
) -> Array:
    """The values at these places where they are no further than `limit` from their ticks."""
    found = np.full(len(ticks), np.nan)
    there = place >= 0
    near = there & (np.abs(ticks - times[place]) <= limit) if len(times) else there
    found[near] = values[place[near]]
    return found


def averaged(times: Array, values: Array, ticks: Array, step: float, age: float | None) -> Array:
    """The mean of the values after the tick before and up to each tick."""
    place = np.ceil((times - ticks[0]) / step - ROUNDING).astype(np.int64)
    inside = (place >= 0) & (place < len(ticks))
    counts = np.bincount(place[inside], minlength=len(ticks))
    sums = np.bincount(place[inside], weights=values[inside], minlength=len(ticks))
    with np.errstate(invalid="ignore"):
        return np.asarray(sums / np.where(counts > 0, counts, np.nan))


JOINS: dict[str, Callable[[Array, Array, Array, float, float | None], Array]] = {
    "hold": held,
    "mean": averaged,
    "nearest": nearest_to,
}
