"""Packages with recursive least squares, each called as its documentation shows."""

from __future__ import annotations

import numpy as np

from .hand import Array, Loop
from .record import LAMBDA, P0, solution


class PadasipFilter:
    """`adapt`, with its arguments in the order of all others."""

    def __init__(self, n: int) -> None:
        from padasip.filters import FilterRLS

        self.make = lambda: FilterRLS(n, mu=LAMBDA, eps=1 / P0, w="zeros")
        self.reset()

    def reset(self) -> None:
        """Start afresh: R starts as 1/eps."""
        self.peer = self.make()

    def update(self, phi: Array, y: float) -> None:
        """One sample."""
        self.peer.adapt(y, phi)

    @property
    def theta(self) -> Array:
        """The estimate."""
        return self.peer.w


def delayed(x: Array, n: int) -> Array:
    """The regressors of an FIR filter: the newest value first, zeros before the first."""
    padded = np.concatenate([np.zeros(n - 1), x])
    return np.lib.stride_tricks.sliding_window_view(padded, n)[:, ::-1]


def pyroomacoustics(n: int) -> Loop:
    """One `update` a sample: it takes no regressors, only the newest value of an FIR filter."""
    from pyroomacoustics.adaptive import RLS

    def run(phi: Array, y: Array) -> Array:
        peer = RLS(n, lmbd=LAMBDA, delta=1 / P0, dtype=np.float64)
        for value, target in zip(phi[:, 0], y, strict=True):
            peer.update(value, target)
        return np.asarray(peer.w, float)

    return run


def fir_solution(phi: Array, y: Array) -> Array:
    """Of the FIR filter."""
    return solution(delayed(phi[:, 0], phi.shape[1]), y)


def statsmodels(n: int) -> Loop:
    """The whole record in one `fit`; it cannot forget."""
    from statsmodels.regression.recursive_ls import RecursiveLS

    return lambda phi, y: np.asarray(RecursiveLS(y, phi).fit().params)


def ordinary(phi: Array, y: Array) -> Array:
    """Least squares without forgetting or prior."""
    return np.linalg.lstsq(phi, y, rcond=None)[0]


def river(n: int) -> Loop:
    """`predict_one` and `learn_one` a sample, which takes a dictionary."""
    from river.linear_model import BayesianLinearRegression

    def run(phi: Array, y: Array) -> Array:
        peer = BayesianLinearRegression(smoothing=LAMBDA)
        for row, target in zip(phi.tolist(), y.tolist(), strict=True):
            x = dict(enumerate(row))
            peer.predict_one(x)
            peer.learn_one(x, target)
        return np.array([peer.predict_one({i: 1.0}) for i in range(n)])

    return run


def river_solution(phi: Array, y: Array) -> Array:
    """It weighs a sample with 1 - λ, so that its unit prior counts as one of 1 / (1 - λ)."""
    return solution(phi, y, p0=1 - LAMBDA)
