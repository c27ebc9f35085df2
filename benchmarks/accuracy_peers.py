"""Packages that predict one step ahead, each used as its documentation shows, at its defaults.

Each takes regressors (T, n) and outputs (T,) and gives the T one-step errors, every prediction from
before its sample was learned. A package that is not installed raises ImportError.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

RATE = 0.99
"""Forgetting factor of a package that has no default for it."""


def padasip(phi: Array, y: Array, **settings: float) -> Array:
    """`FilterRLS(n).run(d, x)`; mu = 0.1 and random first weights are its defaults."""
    from padasip.filters import FilterRLS

    np.random.seed(0)  # noqa: NPY002 (the package draws its first weights by this generator)
    _, error, _ = FilterRLS(phi.shape[1], **settings).run(y, phi)
    return np.asarray(error, dtype=np.float64)


def padasip_slow(phi: Array, y: Array) -> Array:
    """With mu = 0.99, which its documentation advises for measured data."""
    return padasip(phi, y, mu=RATE)


def river_linear(phi: Array, y: Array) -> Array:
    """`StandardScaler() | LinearRegression()`, which is gradient descent by its default."""
    from river.linear_model import LinearRegression
    from river.preprocessing import StandardScaler

    return progressive(StandardScaler() | LinearRegression(), phi, y)


def river_bayesian(phi: Array, y: Array) -> Array:
    """`BayesianLinearRegression()`, which does not forget by default."""
    from river.linear_model import BayesianLinearRegression

    return progressive(BayesianLinearRegression(), phi, y)


def progressive(model: Any, phi: Array, y: Array) -> Array:
    """Predict, then learn, a sample at a time, as `river.evaluate` does."""
    error = np.empty(len(y))
    for k, (row, target) in enumerate(zip(phi.tolist(), y.tolist(), strict=True)):
        x = dict(enumerate(row))
        error[k] = target - model.predict_one(x)
        model.learn_one(x, target)
    return error


def statsmodels(phi: Array, y: Array) -> Array:
    """`RecursiveLS(y, X).fit()`, whose fitted values are predictions one step ahead."""
    from statsmodels.regression.recursive_ls import RecursiveLS

    return np.asarray(y - RecursiveLS(y, phi).fit().fittedvalues, dtype=np.float64)


def bayesianbandits(phi: Array, y: Array) -> Array:
    """`NormalRegressor(1, 1, forgetting=SiftForgetting(0.99))`; none of these has a default."""
    from bayesianbandits import NormalRegressor, SiftForgetting

    model = NormalRegressor(alpha=1.0, beta=1.0, forgetting=SiftForgetting(RATE))
    error = np.empty(len(y))
    for k in range(len(y)):
        x, target = phi[k : k + 1], y[k : k + 1]
        error[k] = (target - model.predict(x))[0]
        model.partial_fit(x, target)
    return error


PEERS = {
    "padasip FilterRLS": ("padasip", padasip),
    "padasip FilterRLS, 0.99": ("padasip", padasip_slow),
    "river LinearRegression": ("river", river_linear),
    "river BayesianLinearRegression": ("river", river_bayesian),
    "statsmodels RecursiveLS": ("statsmodels", statsmodels),
    "bayesianbandits SIFt, 0.99": ("bayesianbandits", bayesianbandits),
}
"""What a peer is called, its package, and how it is used."""
