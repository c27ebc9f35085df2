"""The function `lag` of formulas: it does not reach across a gap of the clock."""

from __future__ import annotations

import numpy as np
import pandas as pd
from numpy.typing import NDArray


class Lag:
    """``lag(x, k)``: x, k rows ago, within a stretch between gaps of the clock.

    Parameters
    ----------
    rows : int
        Rows of the table.
    segments : ndarray of int, shape (T,), optional
        The stretch that each row belongs to; None without a clock.
    """

    def __init__(self, rows: int, segments: NDArray[np.int64] | None = None) -> None:
        self.segments = segments
        self.cut: NDArray[np.bool_] = np.zeros(rows, dtype=bool)
        """Rows in which a value was there, but on the other side of a gap."""

    def __call__(self, column: pd.Series, steps: int = 1) -> pd.Series:
        """Shift, and note what was cut."""
        column = pd.Series(column)
        plain = column.shift(steps)
        if self.segments is None:
            return plain
        within = column.groupby(self.segments).shift(steps)
        self.cut |= (plain.notna() & within.isna()).to_numpy()
        return within
