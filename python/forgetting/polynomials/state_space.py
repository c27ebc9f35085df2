"""A polynomial model as a state space in innovation form."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from forgetting.polynomials.estimate import Array
from forgetting.polynomials.prediction import System, padded


class StateSpace(NamedTuple):
    """x(k+1) = A x(k) + B u(k) + K e(k), y(k) = C x(k) + D u(k) + e(k), e white.

    Attributes
    ----------
    A : ndarray, shape (n, n)
    B : ndarray, shape (n, inputs)
    C : ndarray, shape (1, n)
    D : ndarray, shape (1, inputs)
    K : ndarray, shape (n, 1)
        The gain of the stationary Kalman filter.
    """

    A: Array
    B: Array
    C: Array
    D: Array
    K: Array


def state_space(model: Any) -> StateSpace:
    """The filters of a model, each in observer form, one behind the other.

    Inputs with an F of their own are filtered first, v = Σ B_i/F_i u_i; the last filter is
    D A y = D v + Σ D B_i u_i + C e. An offset is no part of it: with `offset / A(1)` taken from y,
    where A(1) is not 0, there is none.
    """
    system = System.of(model)
    orders, inputs = system.orders, model.structure.inputs
    starts = np.cumsum([0, *orders]).tolist()
    n, last = starts[-1], slice(starts[-2], starts[-1])
    A, B, C, D, K = (np.zeros(s) for s in ((n, n), (n, inputs), (1, n), (1, inputs), (n, 1)))
    A[last, last] = observer(system.DA)
    K[last, 0] = (system.C - system.DA)[1:]
    C[0, last] = first(orders[-1])
    for i, direct in system.direct.items():
        D[0, i] = direct[0]
        B[last, i] = (padded(direct, len(system.DA)) - direct[0] * system.DA)[1:]
    passed = (padded(system.D, len(system.DA)) - system.DA)[1:]  # what v adds to the last state
    for (i, (b, f)), start, order in zip(system.filters.items(), starts, orders, strict=False):
        own = slice(start, start + order)
        b, f = padded(b, order + 1), padded(f, order + 1)
        A[own, own], B[own, i] = observer(f), (b - f * b[0])[1:]
        A[last, own.start], C[0, own] = passed, first(order)
        B[last, i], D[0, i] = passed * b[0], b[0]
    return StateSpace(A, B, C, D, K)


def first(order: int) -> Array:
    """1, 0, 0, ..."""
    return np.asarray(np.eye(1, order)[0])


def observer(polynomial: Array) -> Array:
    """The matrix of the observer form: minus the coefficients in the first column, ones above."""
    order = len(polynomial) - 1
    made = np.eye(order, k=1)
    if order:
        made[:, 0] = -polynomial[1:]
    return made
