"""Regressors of each stream's own past: the last rows of every stream are kept between batches."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from forgetting.models.lags import regressors
from forgetting.models.orders import Orders
from forgetting.tables.growing import Growing
from forgetting.tables.order import Groups

Array = NDArray[np.float64]


class Lags:
    """The last rows of each stream.

    Parameters
    ----------
    orders : Orders
    inputs : int
        Number of inputs.

    Attributes
    ----------
    kept : Growing
        For each stream (reach, 1 + inputs): y and the inputs of its last `Orders.reach` rows, the
        newest last; NaN before the first.
    """

    def __init__(self, orders: Orders, inputs: int) -> None:
        self.orders = orders
        self.kept = Growing(np.nan, np.float64, (orders.reach, 1 + inputs))

    def regressors(self, groups: Groups, signals: Array) -> tuple[Array, Array]:
        """The regressors of grouped rows, and what is to be kept after them.

        Parameters
        ----------
        groups : Groups
        signals : (r, 1 + inputs) ndarray
            y and the inputs, grouped.

        Returns
        -------
        phi : (r, n) ndarray
            NaN where a lag is missing.
        kept : (g, reach, 1 + inputs) ndarray
            The last rows of each group.
        """
        reach, count = self.orders.reach, len(groups.streams)
        before = reach * np.arange(1, count + 1)
        own = np.arange(len(signals)) + np.repeat(before, groups.counts)
        together = np.empty((len(signals) + reach * count, signals.shape[1]))
        together[own] = signals
        back = np.arange(reach)
        first = (groups.starts + before - reach)[:, None] + back
        together[first] = self.kept.of(groups.streams)
        phi = regressors(together[:, 1:], together[:, :1], self.orders)[own]
        last = (groups.starts + groups.counts + before - reach)[:, None] + back
        return phi, together[last]
