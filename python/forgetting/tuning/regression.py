"""A model that is linear in its parameters: its regressors are known before it is run."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from forgetting.models.lags import regressors
from forgetting.models.orders import Orders
from forgetting.tuning.problem import Array, Mask


@dataclass(frozen=True)
class Regression:
    """Regressors and outputs, NaN where a value is missing; see `forgetting.tuning.problem`.

    Attributes
    ----------
    phi : ndarray, shape (T, n)
        Regressors as they are.
    y : ndarray, shape (T, m)
        Outputs as they are.
    moved : tuple of two ndarrays
        Both as an estimator gets them whose prior follows the data: measured from the first sample
        where the model has a constant, see `forgetting.record.identify`.
    """

    phi: Array
    y: Array
    moved: tuple[Array, Array]

    @property
    def parameters(self) -> int:
        """Number n of regressors."""
        return int(self.phi.shape[1])

    @property
    def complete(self) -> Mask:
        """Rows without a missing value, (T,)."""
        missing = np.isnan(self.phi).any(axis=1) | np.isnan(self.y).any(axis=1)
        return np.asarray(~missing, dtype=np.bool_)

    def errors(self, estimator: Any, stop: int | None = None, follows: bool = True) -> Array:
        """See `Problem`."""
        phi, y = self.moved if follows else (self.phi, self.y)
        phi, y = phi[:stop], y[:stop]
        target = y if y.shape[1] > 1 else y[:, 0]
        found = estimator.run(phi, target, outputs=("error",), missing="skip")
        return np.asarray(found.error, dtype=np.float64).reshape(y.shape)

    def mean_squares(self, stop: int) -> Array:
        """See `Problem`."""
        return np.asarray(np.nanmean(np.square(self.phi[:stop]), axis=0))

    def part(self, rows: slice) -> Regression:
        """See `Problem`."""
        phi, y = self.moved
        return Regression(self.phi[rows], self.y[rows], (phi[rows], y[rows]))


def of_lags(orders: Orders, inputs: Array, outputs: Array, offset: bool = False) -> Regression:
    """The regression of an ARX model on arrays (T, inputs) and (T, outputs).

    Examples
    --------
    >>> of_lags(Orders(1, 1, 0), np.ones((3, 1)), np.ones((3, 1)), offset=True).parameters
    3
    """
    phi = regressors(inputs, outputs, orders)
    phi = np.hstack([phi, np.ones((len(phi), 1))]) if offset else phi
    return Regression(phi, outputs, (phi, outputs))
