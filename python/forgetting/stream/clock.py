"""The clock of a stream: gaps, late lines and repeated ones, told from the lines so far.

A gap is what it is in a record (`forgetting.record.clock`): a step that is longer than 1.5 usual
ones or than `gap`, that goes back, that does not go on, or one from or to a missing time. A record
knows all of its steps; here the usual one is the median of the last steps that went on.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import pandas as pd

from forgetting.record.clock.clock import GAP, SLACK
from forgetting.stream.rows import Array, Flags, Rows
from forgetting.stream.stamps import Stamps

WINDOW = 101
"""Steps whose median is the usual one."""


@dataclass(frozen=True)
class Marks:
    """What the clock says of T rows, each against the one before it.

    Attributes
    ----------
    gap : ndarray of bool, shape (T,)
        Lags do not reach across it.
    late : ndarray of bool, shape (T,)
        The time is before that of the row before; always a gap.
    repeated : ndarray of bool, shape (T,)
        Same time and same values: the row brings nothing and is no part of any lag.
    time : ndarray, shape (T,), or None
        Seconds that went by since the first row, as `forgetting.record.half_life` counts them; None
        without a clock.
    """

    gap: Flags
    late: Flags
    repeated: Flags
    time: Array | None = None


class StreamClock:
    """Follows the time from row to row; what it says does not depend on how lines are grouped."""

    def __init__(self, stamps: Stamps | None, gap: float | None) -> None:
        self.stamps, self.gap = stamps, gap
        self.start: Any = None
        """The first time stamp, which seconds are counted from."""
        self.last = np.nan
        self.elapsed = 0.0
        self.seen = False
        self.values: list[float] = []
        """The row before."""
        self.forward: Array = np.empty(0)
        """The last steps that went on."""
        self.still: Flags = np.empty(0, dtype=bool)
        """Whether the last steps were none."""

    def mark(self, rows: Rows) -> Marks:
        """Compare rows with those before them."""
        none = np.zeros(len(rows), dtype=bool)
        if self.stamps is None:
            return Marks(none, none, none)
        seconds = self._seconds(rows)
        steps = np.diff(seconds, prepend=self.last)
        limit, coarse = self._limits(steps), self._coarse(steps)
        repeated = (steps == 0) & ~coarse & self._same(rows.values)
        on = np.where(coarse, steps >= 0, steps > 0)
        gap = (~on | (steps > limit * SLACK)) & ~repeated
        if not self.seen:
            gap[0] = False
        time = self._went_by(steps)
        self.last, self.seen = float(seconds[-1]), True
        self.values = rows.values[-1].tolist()
        return Marks(gap, steps < 0, repeated, time)

    def _seconds(self, rows: Rows) -> Array:
        assert self.stamps is not None
        if self.start is None and rows.timed.any():
            self.start = rows.ticks[rows.timed][0].item()
        return self.stamps.seconds(rows.ticks, rows.timed, self.start or 0)

    def _went_by(self, steps: Array) -> Array:
        """Steps added up; one back, or at a missing time, takes no time."""
        onward = np.maximum(np.nan_to_num(steps, nan=0.0), 0.0)
        time = np.cumsum(np.concatenate([[self.elapsed], onward]))[1:]
        self.elapsed = float(time[-1])
        return time

    def _same(self, values: Array) -> Flags:
        before = np.array(self.values) if self.seen else np.full(values.shape[1], np.nan)
        shifted = np.vstack([before, values[:-1]])
        both_missing = np.isnan(values) & np.isnan(shifted)
        return np.asarray(((values == shifted) | both_missing).all(axis=1))

    def _limits(self, steps: Array) -> Array | float:
        """The longest step that is no gap, for each step from those before it."""
        went_on = steps > 0
        forward = np.concatenate([self.forward, steps[went_on]])
        before = len(self.forward) + np.cumsum(went_on) - went_on
        self.forward = forward[-WINDOW:]
        if self.gap is not None:
            return self.gap
        if not len(forward) or forward.max() <= GAP * forward.min():
            return np.inf
        medians = pd.Series(forward).rolling(WINDOW, min_periods=1).median().to_numpy()
        return np.where(before > 0, GAP * medians[np.maximum(before, 1) - 1], np.inf)

    def _coarse(self, steps: Array) -> Flags:
        """Whether most of the last steps before each repeat a stamp, as in a fast log."""
        still = np.concatenate([self.still, steps == 0])
        counts = np.concatenate([[0], np.cumsum(still)])
        ends = len(self.still) + np.arange(len(steps))
        begins = np.maximum(ends - WINDOW, 0)
        self.still = still[-WINDOW:]
        return np.asarray((counts[ends] - counts[begins]) * 2 > ends - begins)

    def state(self) -> dict[str, Any]:
        """As `restore` takes it."""
        return {
            "start": self.start,
            "last": self.last,
            "elapsed": self.elapsed,
            "seen": self.seen,
            "values": self.values,
            "forward": self.forward.tolist(),
            "still": self.still.astype(int).tolist(),
        }

    def restore(self, state: dict[str, Any]) -> None:
        """Go on from a saved state."""
        self.start, self.last, self.seen = state["start"], state["last"], state["seen"]
        self.elapsed, self.values = state["elapsed"], state["values"]
        self.forward = np.array(state["forward"], dtype=np.float64)
        self.still = np.array(state["still"], dtype=bool)
