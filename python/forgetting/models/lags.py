"""The regressor of an ARX model: which past value stands in which column.

    phi(k) = [y(k-1) ... y(k-na)   u(k-nk) ... u(k-nk-nb+1)]

so that y(k) = a1 y(k-1) + ... + b1 u(k-nk) + ...: a model of first order has its pole at a1. The
literature often has the output lags negated (equations (1)-(2) of Zhu, Yu and Wan 2022,
"Variable-direction forgetting via oblique projection decomposition"), for coefficients of the
polynomial A(q) = 1 + a1 q^-1 + ...; those are these with the other sign.

With several outputs (inputs) every y (u) above is the block of all outputs (inputs), in order.
Where inputs have orders of their own, those that have no such lag are left out of a block.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from forgetting.models.orders import Orders

Array = NDArray[np.float64]


def regressors(u: Array, y: Array, orders: Orders) -> Array:
    """Build every regressor of a record without gaps in time.

    Parameters
    ----------
    u : ndarray, shape (T, inputs)
        Inputs; a missing value is NaN.
    y : ndarray, shape (T, outputs)
        Outputs; a missing value is NaN.
    orders : Orders
        Orders na, nb, nk.

    Returns
    -------
    ndarray, shape (T, n)
        Row k is phi(k); lags from before the record are NaN.

    Examples
    --------
    >>> import numpy as np
    >>> u, y = np.array([[1.0], [2.0], [3.0]]), np.array([[10.0], [20.0], [30.0]])
    >>> regressors(u, y, Orders(1, 2, 0))
    array([[nan,  1., nan],
           [10.,  2.,  1.],
           [20.,  3.,  2.]])
    """
    blocks = [delayed(y, lag) for lag in range(1, orders.na + 1)]
    blocks += [delayed(u[:, [own]], lag) for lag, own in orders.input_lags(u.shape[1])]
    return np.ascontiguousarray(np.hstack(blocks))


def delayed(signal: Array, lag: int) -> Array:
    """Shift (T, c) down by `lag` rows; the first `lag` rows are NaN."""
    shifted = np.full_like(signal, np.nan)
    shifted[lag:] = signal[: max(len(signal) - lag, 0)]
    return shifted


def names(outputs: Sequence[str], inputs: Sequence[str], orders: Orders) -> list[str]:
    """Name each column of `regressors`.

    Examples
    --------
    >>> names(["V"], ["I"], Orders(1, 2, 0))
    ['V(k-1)', 'I(k)', 'I(k-1)']
    """
    past = [f"{y}(k-{lag})" for lag in range(1, orders.na + 1) for y in outputs]
    lags = orders.input_lags(len(inputs))
    return past + [f"{inputs[u]}(k-{lag})" if lag else f"{inputs[u]}(k)" for lag, u in lags]
