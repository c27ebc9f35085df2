"""Free run of an ARX model."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

import forgetting as fg
from forgetting.models.orders import Orders

Array = NDArray[np.float64]


def free_run(u: Array, start: Array, theta: Array, orders: Orders) -> Array:
    """Simulate y(k) = phi(k) theta with simulated outputs in the lags.

    Parameters
    ----------
    u : ndarray, shape (T, inputs)
        Inputs without gaps.
    start : ndarray, shape (r, outputs)
        First r <= T outputs, copied; before row 0 everything is zero.
    theta : ndarray, shape (n, outputs)
        Coefficients in the order of `forgetting.models.lags.regressors`.
    orders : Orders
        Orders na, nb, nk.
    """
    for name, values in (("u", u), ("y_start", start)):
        if np.isnan(values).any():
            row = int(np.argwhere(np.isnan(values))[0][0])
            raise fg.InvalidInput(f"{name} is missing in row {row}; a free run needs every value")
    if len(start) > len(u):
        raise fg.InvalidInput(f"y_start has {len(start)} rows, more than the {len(u)} of u")
    outputs = theta.shape[1]
    # Zeros in front of the record are the system at rest, and make every lag an index.
    rest = orders.reach
    inputs = np.vstack([np.zeros((rest, u.shape[1])), u])
    simulated = np.zeros((rest + len(u), outputs))
    simulated[rest : rest + len(start)] = start
    for k in range(rest + len(start), rest + len(u)):
        past = [-simulated[k - lag] for lag in range(1, orders.na + 1)]
        past += [inputs[k - lag] for lag in range(orders.nk, orders.nk + orders.nb)]
        simulated[k] = np.concatenate(past) @ theta
    return simulated[rest:]
