"""Steps in time that only look like gaps: a repeated hour, midnight, a weekend."""

from __future__ import annotations

import numpy as np
import pandas as pd
from numpy.typing import NDArray

Array = NDArray[np.float64]

HOUR, DAY = 3600.0, 86400.0
CHANGES = (3, 4, 9, 10, 11)
"""Months in which clocks are put forward or back somewhere."""
NIGHT = 4
"""Clocks are changed before this hour, on a Sunday."""
DAYS = 5
"""Rows that a record must have at least before a missing weekend means something."""


def bridged(steps: Array, times: pd.Series | None, daily: bool) -> Array:
    """Steps as they were, where local time was changed or a time of day began again.

    Parameters
    ----------
    steps : ndarray, shape (T - 1,)
        Seconds as the column has them.
    times : pandas.Series or None
        The date-times, if they are some; those with a time zone have no repeated hour.
    daily : bool
        Whether the column holds times of day.
    """
    forward = steps[steps > 0]
    if not len(forward):
        return steps
    usual = float(np.median(forward))
    if daily:
        # From the last time of a day to the first of the next.
        return np.where((steps < 0) & (steps > -DAY), steps + DAY, steps)
    if times is None or times.dt.tz is not None:
        return steps
    changed = at_change(times)
    back = changed & near(steps, usual - HOUR)
    on = changed & near(steps, usual + HOUR)
    return np.where(back | on, usual, steps)


def near(steps: Array, value: float) -> NDArray[np.bool_]:
    """Whether steps have a value, to a second."""
    return np.asarray(np.abs(steps - value) < 1.0)


def at_change(times: pd.Series) -> NDArray[np.bool_]:
    """Whether both ends of a step lie in a night in which clocks may be changed, (T - 1,)."""
    when = times.dt
    night = (when.day_of_week == 6) & (when.hour < NIGHT) & when.month.isin(CHANGES)
    return np.asarray(night.iloc[1:].to_numpy() & night.iloc[:-1].to_numpy())


def business_days(times: pd.Series) -> Array | None:
    """Steps in business days, (T - 1,), of a record that has dates and no weekend; else None."""
    known = times.dropna()
    if len(known) < DAYS or len(known) < len(times):
        return None
    days = known.dt.tz_localize(None) if known.dt.tz is not None else known
    midnight = bool((days == days.dt.normalize()).all())
    if not midnight or bool((days.dt.day_of_week > 4).any()):
        return None
    dates = days.to_numpy().astype("datetime64[D]")
    if np.median(np.diff(dates).astype(np.float64)) != 1:
        return None
    return np.asarray(np.busday_count(dates[:-1], dates[1:]), dtype=np.float64)
