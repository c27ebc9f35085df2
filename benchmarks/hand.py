"""The covariance form as users write it in Python: NumPy, SciPy's BLAS, Numba."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from .record import LAMBDA, P0

Array = np.ndarray
Loop = Callable[[Array, Array], Array]


class NumpyFilter:
    """As a textbook has it, without needless copies."""

    def __init__(self, n: int) -> None:
        self.theta, self.p = np.zeros(n), np.zeros((n, n))
        self.reset()

    def reset(self) -> None:
        """Start afresh."""
        self.theta[:] = 0
        self.p[:] = P0 * np.eye(len(self.theta))

    def update(self, phi: Array, y: float) -> float:
        """One sample; returns the error."""
        h = self.p @ phi
        gain = h / (LAMBDA + phi @ h)
        error = y - phi @ self.theta
        self.theta += gain * error
        self.p -= np.outer(gain, h)
        self.p /= LAMBDA
        return error


class BlasFilter:
    """One dsymv and one dsyr a sample; the division by λ is left to one scalar."""

    def __init__(self, n: int) -> None:
        from scipy.linalg import blas

        self.dsymv, self.dsyr, self.ddot, self.daxpy = blas.dsymv, blas.dsyr, blas.ddot, blas.daxpy
        self.theta, self.h = np.zeros(n), np.zeros(n)
        self.reset()

    def reset(self) -> None:
        """Start afresh."""
        self.theta[:] = 0
        self.q, self.s = np.asfortranarray(P0 * np.eye(len(self.theta))), 1.0

    def update(self, phi: Array, y: float) -> float:
        """One sample; returns the error."""
        h = self.dsymv(1.0, self.q, phi, 0.0, self.h, overwrite_y=1)
        error = y - self.ddot(phi, self.theta)
        g = self.s / (LAMBDA + self.s * self.ddot(phi, h))
        self.daxpy(h, self.theta, a=g * error)
        self.dsyr(-g, h, a=self.q, overwrite_a=1)
        self.s /= LAMBDA
        return error


def loop_of(make: Callable[[int], Any]) -> Callable[[int], Loop]:
    """One `update` a sample, in a loop."""

    def sized(n: int) -> Loop:
        made = make(n)

        def run(phi: Array, y: Array) -> Array:
            made.reset()
            for k in range(len(y)):
                made.update(phi[k], y[k])
            return np.asarray(made.theta)

        return run

    return sized


def numba_full(n: int) -> Loop:
    """All of P."""
    from . import numba_loops

    return compiled(numba_loops.full)


def numba_triangle(n: int) -> Loop:
    """The lower half of P."""
    from . import numba_loops

    return compiled(numba_loops.triangle)


def compiled(loop: Any) -> Loop:
    """A loop over the whole record."""
    return lambda phi, y: loop(phi, y, LAMBDA, P0)
