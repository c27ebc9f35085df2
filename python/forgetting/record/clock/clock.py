"""The clock of a record and the stretches between its gaps."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from forgetting.record.clock.steps import bridged, business_days
from forgetting.words.rounding import brief

GAP = 1.5
"""A step longer than this many median steps is a gap: lags do not reach across it."""
SLACK = 1 + 1e-6
"""One part in a million forgives the rounding of time stamps such as 0.1, 0.2, 0.30000001."""


@dataclass(frozen=True)
class Clock:
    """When each row was measured.

    Attributes
    ----------
    values : pandas.Series
        Date-times, or numbers as float64; missing where a row has no time.
    name : str
        Column name, or both names of a date and a time.
    kind : str
        How the column was read, in words.
    scale : float
        Seconds of one unit of numbers.
    daily : bool
        Whether times of day start again at midnight.
    gap : float, optional
        Seconds above which a step is a gap; without it `GAP` median steps.
    """

    values: pd.Series
    name: str
    kind: str = "numbers, taken as seconds"
    scale: float = 1.0
    daily: bool = False
    gap: float | None = None

    @property
    def is_datetime(self) -> bool:
        """Whether the column held date-times (else numbers)."""
        return bool(pd.api.types.is_datetime64_any_dtype(self.values))

    def seconds(self) -> NDArray[np.float64]:
        """Seconds since the first row that has a time, (T,); NaN where there is none."""
        known = self.values.dropna()
        if known.empty:
            return np.full(len(self.values), np.nan)
        elapsed = self.values - known.iloc[0]
        if self.is_datetime:
            return np.asarray(elapsed.dt.total_seconds(), dtype=np.float64)
        return np.asarray(elapsed, dtype=np.float64) * self.scale

    @cached_property
    def steps(self) -> NDArray[np.float64]:
        """Seconds from row to row, (T − 1,); over a repeated hour and midnight as they were."""
        steps = np.diff(self.seconds())
        return bridged(steps, self.values if self.is_datetime else None, self.daily)

    @cached_property
    def is_gap(self) -> NDArray[np.bool_]:
        """Whether there is a gap between a row and the next, (T − 1,).

        A step that is too long, that goes back or that does not go on at all, and one from or to a
        missing time. Where most rows repeat the stamp before them, as in a fast log with stamps of
        whole seconds, a repeated stamp says nothing.
        """
        limit, steps = self.limit, self.steps
        long = steps > limit * SLACK
        if self.gap is None and self.is_datetime:
            days = business_days(self.values)
            long = long if days is None else days > GAP
        on = steps >= 0 if self.is_coarse else steps > 0
        return np.asarray(~on | long)

    @property
    def is_coarse(self) -> bool:
        """Whether most rows repeat the stamp of the row before."""
        return bool(np.mean(self.steps == 0) > 0.5) if len(self.steps) else False

    @property
    def limit(self) -> float:
        """Seconds above which a step is a gap."""
        if self.gap is not None:
            return self.gap
        return GAP * self.usual_step

    @cached_property
    def usual_step(self) -> float:
        """Median of the steps that go on, in seconds; infinite without any."""
        forward = self.steps[self.steps > 0]
        return float(np.median(forward)) if len(forward) else np.inf

    @property
    def runs_forward(self) -> bool:
        """Whether every row has a time that is later than that of the row before."""
        return bool((np.diff(self.seconds()) > 0).all())

    def segments(self) -> NDArray[np.int64]:
        """Number the stretches between gaps, (T,): 0, 0, ..., 1, 1, ..."""
        if len(self.values) == 0:
            return np.zeros(0, dtype=np.int64)
        return np.concatenate([[0], np.cumsum(self.is_gap)]).astype(np.int64)

    def __str__(self) -> str:
        return f"{self.name!r} ({self.kind}), {self.gaps()}"

    def gaps(self) -> str:
        """How many gaps there are and of what kind, in words."""
        back = int((self.steps < 0).sum())
        still = 0 if self.is_coarse else int((self.steps == 0).sum())
        unknown = int(np.isnan(self.steps).sum())
        longer = int(self.is_gap.sum()) - back - still - unknown
        of = "the business days" if self._counts_business_days else f"{brief(self.limit)} s"
        parts = [
            (longer, f"step{'s' * (longer != 1)} over {of}"),
            (back, f"step{'s' * (back != 1)} back"),
            (still, f"repeated stamp{'s' * (still != 1)}"),
            (unknown, f"step{'s' * (unknown != 1)} at a missing time"),
        ]
        told = ", ".join(f"{count} {words}" for count, words in parts if count)
        if self.is_coarse:
            told += ", " * bool(told) + "most rows share a stamp, so that repeating one is no gap"
        total = int(self.is_gap.sum())
        return f"{total} gap{'s' * (total != 1)}" + (f": {told}" if told else "")

    @property
    def _counts_business_days(self) -> bool:
        given = self.gap is not None or not self.is_datetime
        return not given and business_days(self.values) is not None
