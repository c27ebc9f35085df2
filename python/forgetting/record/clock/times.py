"""What a column says of time: its values and how they were read."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pandas as pd


@dataclass(frozen=True)
class Times:
    """A column read as time.

    Attributes
    ----------
    values : pandas.Series
        Date-times, or numbers as float64.
    kind : str
        How they were read, in words.
    scale : float
        Seconds of one unit of numbers.
    daily : bool
        Whether they are times of day.
    """

    values: pd.Series
    kind: str
    scale: float = 1.0
    daily: bool = False

    @property
    def is_datetime(self) -> bool:
        """Whether the values are date-times."""
        return bool(pd.api.types.is_datetime64_any_dtype(self.values))

    @property
    def is_date(self) -> bool:
        """Whether they are dates without a time of day."""
        known = self.values.dropna()
        return self.is_datetime and bool((known == known.dt.normalize()).all())

    def forward(self) -> float:
        """Share of the steps that go forward; 1 for a single row."""
        steps = self.steps()
        return float((steps > 0).mean()) if len(steps) else 1.0

    def onward(self) -> float:
        """Share of the steps that do not go back; 0 where none goes forward."""
        steps = self.steps()
        if not len(steps):
            return 1.0
        return float((steps >= 0).mean()) if (steps > 0).any() else 0.0

    def steps(self) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
        """Differences of the known values, of date-times in seconds."""
        known = self.values.dropna()
        steps = known.diff().iloc[1:]
        if self.is_datetime:
            steps = steps.dt.total_seconds()
        return np.asarray(steps, dtype=np.float64)
