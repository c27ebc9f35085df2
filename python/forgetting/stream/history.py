"""The last rows of a stream, which lags of later ones reach."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from forgetting.stream.rows import Array, Flags


class History:
    """The last rows, and the stretch between gaps that each belongs to."""

    def __init__(self, reach: int, columns: int) -> None:
        self.reach = reach
        self.values = np.empty((0, columns))
        self.stretch: NDArray[np.int64] = np.empty(0, dtype=np.int64)

    def behind(self, values: Array, gap: Flags) -> tuple[Array, NDArray[np.int64], int]:
        """Rows with those before them, their stretches, and how many were before."""
        before = len(self.values)
        latest = int(self.stretch[-1]) if before else 0
        stretch = np.concatenate([self.stretch, latest + np.cumsum(gap)])
        together = np.vstack([self.values, values])
        start = max(len(together) - self.reach, 0)
        self.values, self.stretch = together[start:].copy(), stretch[start:].copy()
        return together, stretch, before

    def state(self) -> dict[str, Any]:
        """As `restore` takes it; stretches count from that of the last row."""
        latest = self.stretch[-1] if len(self.stretch) else 0
        return {"values": self.values.tolist(), "stretch": (self.stretch - latest).tolist()}

    def restore(self, state: dict[str, Any]) -> None:
        """Go on from a saved state."""
        self.values = np.array(state["values"], dtype=np.float64).reshape(-1, self.values.shape[1])
        self.stretch = np.array(state["stretch"], dtype=np.int64)
