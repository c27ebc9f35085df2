"""Free run of an ARX model.

With its own outputs in the lags, y(k) - A_1 y(k-1) - ... - A_na y(k-na) = f(k), f(k) what the
inputs bring. All samples together are one linear system, lower triangular with ones on the
diagonal and nothing but the -A_l in a narrow band below it: one forward substitution solves it,
however many outputs act on one another.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from forgetting._core import InvalidInput
from forgetting.extras import extra
from forgetting.models.lags import regressors
from forgetting.models.orders import Orders

Array = NDArray[np.float64]


def free_run(
    u: Array,
    start: Array,
    theta: Array,
    orders: Orders,
    offset: Array | float = 0.0,
) -> Array:
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
    offset : ndarray, shape (outputs,), optional
        The constant of each output.

    Raises
    ------
    InvalidInput
        For a missing value, or a start longer than the inputs.
    ImportError
        Without SciPy.
    """
    blas = extra("scipy.linalg.blas", "a free run")
    check(u, start)
    outputs = theta.shape[1]
    right = forced(u, theta, orders) + offset
    right[: len(start)] = start
    if not right.size:
        return right
    matrix = band(theta[: orders.na * outputs], len(u), len(start))
    below = len(matrix) - 1
    solution = blas.dtbsv(below, matrix, right.ravel(), lower=1, diag=1)
    return np.asarray(solution).reshape(right.shape)


def check(u: Array, start: Array) -> None:
    """Refuse gaps, and a start that is longer than the run."""
    for name, values in (("u", u), ("y_start", start)):
        if np.isnan(values).any():
            row = int(np.argwhere(np.isnan(values))[0][0])
            raise InvalidInput(f"{name} is missing in row {row}; a free run needs every value")
    if len(start) > len(u):
        raise InvalidInput(f"y_start has {len(start)} rows, more than the {len(u)} of u")


def forced(u: Array, theta: Array, orders: Orders) -> Array:
    """What the inputs bring, (T, outputs); before row 0 they are zero."""
    past_outputs = orders.na * theta.shape[1]
    inputs = regressors(u, np.empty((len(u), 0)), orders)
    return np.asarray(np.nan_to_num(inputs, nan=0.0) @ theta[past_outputs:])


def band(feedback: Array, samples: int, copied: int) -> Array:
    """The system by its diagonals, as BLAS keeps them: row d, column j is the element (j + d, j).

    `feedback` (na·outputs, outputs) has the transposes of A_1, A_2, ... below one another. The
    first `copied` samples are the right side itself, so there is nothing left of their diagonal.
    """
    rows, outputs = feedback.shape
    columns = np.zeros((samples, outputs, rows + outputs))
    columns[:, :, 0] = 1.0
    for (row, target), coefficient in np.ndenumerate(feedback):
        lag, source = row // outputs + 1, row % outputs
        below = lag * outputs + target - source
        columns[max(copied - lag, 0) :, source, below] = -coefficient
    return columns.reshape(samples * outputs, rows + outputs).T
