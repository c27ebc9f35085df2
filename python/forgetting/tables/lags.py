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

    def regressors(
        self, groups: Groups, signals: Array, breaks: NDArray[np.bool_]
    ) -> tuple[Array, Array]:
        """The regressors of grouped rows, and what is to be kept after them.

        Parameters
        ----------
        groups : Groups
        signals : (r, 1 + inputs) ndarray
            y and the inputs, grouped.
        breaks : (r,) ndarray of bool
            Rows before which lags end.

        Returns
        -------
        phi : (r, n) ndarray
            NaN where a lag is missing.
        kept : (g, reach, 1 + inputs) ndarray
            The last rows of each group.
        """
        reach = self.orders.reach
        first = breaks.copy()
        first[groups.starts] = True
        starts = np.flatnonzero(first)  # of pieces that lags stay within
        counts = np.diff(starts, append=len(signals))
        before = reach * np.arange(1, len(starts) + 1)
        own = np.arange(len(signals)) + np.repeat(before, counts)
        together = np.empty((len(signals) + reach * len(starts), signals.shape[1]))
        together[own] = signals
        back = np.arange(reach)
        together[(starts + before - reach)[:, None] + back] = self._before(groups, starts, breaks)
        phi = regressors(together[:, 1:], together[:, :1], self.orders)[own]
        last = np.searchsorted(starts, groups.starts + groups.counts) - 1
        ends = (starts + counts + before - reach)[last]
        return phi, together[ends[:, None] + back]

    def _before(
        self, groups: Groups, starts: NDArray[np.int64], breaks: NDArray[np.bool_]
    ) -> Array:
        """The rows before each piece: those kept of the stream, or none after a break."""
        found = np.full((len(starts), *self.kept.values.shape[1:]), np.nan)
        kept = self.kept.of(groups.streams)
        kept[breaks[groups.starts]] = np.nan
        found[np.searchsorted(starts, groups.starts)] = kept
        return found
