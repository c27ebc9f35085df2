"""The noise variance of a stream so far."""

from __future__ import annotations

from typing import Any

import numpy as np

from forgetting.stream.rows import Array, Flags


class RunningNoise:
    """The mean of e² / (1 + leverage) over the used samples but the first n.

    The same as `forgetting.record.uncertainty` says of a record; the sums go on from rows to rows.

    Parameters
    ----------
    regressors, outputs : int
    """

    def __init__(self, regressors: int, outputs: int) -> None:
        self.n = regressors
        self.used = 0
        self.total = np.zeros(outputs)
        self.counted = 0.0
        """What the samples in `total` count."""

    def take(self, error: Array, leverage: Array, used: Flags, trust: Array | float = 1.0) -> Array:
        """Noise variance (T, m) after each of T rows.

        Parameters
        ----------
        error : ndarray, shape (T, m)
        leverage : ndarray, shape (T,)
        used : ndarray of bool, shape (T,)
            Rows that the estimator has used.
        trust : ndarray, shape (T,), or float
            What each of them counts.
        """
        order = self.used + np.cumsum(used)
        counts = np.where(used & (order > self.n), trust, 0.0)[:, None]
        each = error**2 / (1.0 + leverage[:, None]) * counts
        each[counts[:, 0] == 0] = 0.0
        sums = np.cumsum(np.vstack([self.total, each]), axis=0)[1:]
        counted = np.cumsum(np.vstack([[self.counted], counts]), axis=0)[1:]
        self.used, self.total = int(order[-1]), sums[-1].copy()
        self.counted = float(counted[-1, 0])
        with np.errstate(invalid="ignore"):
            return np.asarray(sums / counted)  # 0/0 before the first

    def state(self) -> dict[str, Any]:
        """As `restore` takes it."""
        return {"used": self.used, "total": self.total.tolist(), "counted": self.counted}

    def restore(self, state: dict[str, Any]) -> None:
        """Go on from a saved state."""
        self.used, self.counted = state["used"], state["counted"]
        self.total = np.array(state["total"])
