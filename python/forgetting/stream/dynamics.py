"""ARX models and regressions of named columns, batch by batch."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from forgetting.models.lags import names, regressors
from forgetting.models.orders import Each
from forgetting.record.dynamics import CONSTANT, checked_orders, refuse_repeats
from forgetting.stream.history import History
from forgetting.stream.rows import Array, Flags
from forgetting.stream.samples import Samples


class Dynamics:
    """An ARX model of named columns; with the orders 0, 1, 0 a regression without lags."""

    def __init__(
        self, outputs: Sequence[str], inputs: Sequence[str], arx: Sequence[Each], offset: bool
    ) -> None:
        self.orders = checked_orders(arx, inputs)
        refuse_repeats(outputs, inputs)
        self.outputs, self.inputs = tuple(outputs), tuple(inputs)
        self.columns = self.outputs + self.inputs
        labels = tuple(names(outputs, inputs, self.orders))
        self.constant = len(labels) if offset else None
        self.regressors = (*labels, CONSTANT) if offset else labels
        self.history = History(self.orders.reach, len(self.columns))

    def samples(self, values: Array, gap: Flags) -> Samples:
        """See `Model`."""
        together, stretch, before = self.history.behind(values, gap)
        y, u = together[:, : len(self.outputs)], together[:, len(self.outputs) :]
        phi = regressors(u, y, self.orders)
        for lag in range(1, self.orders.reach + 1):
            across = np.flatnonzero(stretch[lag:] != stretch[:-lag]) + lag
            phi[across[:, None], self._columns_of(lag)] = np.nan
        if self.constant is not None:
            phi = np.column_stack([phi, np.where(np.isnan(phi).any(axis=1), np.nan, 1.0)])
        return Samples(phi[before:], y[before:])

    def _columns_of(self, lag: int) -> list[int]:
        """Places of the regressors with this lag."""
        outputs, orders = len(self.outputs), self.orders
        found: list[int] = []
        if lag <= orders.na:
            found += range((lag - 1) * outputs, lag * outputs)
        lags = enumerate(orders.input_lags(len(self.inputs)), orders.na * outputs)
        return found + [place for place, (own, _) in lags if own == lag]

    def state(self) -> dict[str, Any]:
        """See `Model`."""
        return self.history.state()

    def restore(self, state: dict[str, Any]) -> None:
        """See `Model`."""
        self.history.restore(state)
