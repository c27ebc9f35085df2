"""The point from which a model with a constant measures its signals, and what that makes of P.

Such a model says the same of u - u0 and y - y0, their first values, with another constant. Of
signals as they are the constant is

    offset = constant + y0 (1 - Σ a) - Σᵢ uᵢ0 Σ bᵢ / (1 - Σ fᵢ)

and its variance that of its gradient along all parameters: to first order exact, as for all that
is said of standard errors here.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from forgetting.models.layout import Layout

Array = NDArray[np.float64]


@dataclass(frozen=True)
class SignalOrigin:
    """First values of the signals of a model with the parameters a, b, c, d, f and a constant.

    Attributes
    ----------
    inputs : ndarray, shape (inputs,)
        First value of each input that is not missing; 0 before there is one.
    output : float
        That of the output.
    layout : Layout
        Where the parameters stand.
    fixed : dict of int to float
        Places and values of parameters that are not estimated: all others are what is called
        theta here.

    Examples
    --------
    >>> origin = SignalOrigin(np.array([20.0]), 300.0, Layout.of(1, [(1, 0)], noise=0))
    >>> origin.express(np.array([0.9, 1.0, 0.0])).round(6).tolist()
    [0.9, 1.0, 10.0]
    >>> origin.change(np.array([0.9, 1.0, 0.0])).tolist()
    [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-300.0, -20.0, 1.0]]
    """

    inputs: Array
    output: float
    layout: Layout
    fixed: Mapping[int, float] = field(default_factory=dict)

    @classmethod
    def of(
        cls, first: Array, layout: Layout, fixed: Mapping[int, float] | None = None
    ) -> SignalOrigin:
        """By the first values of all inputs and of the output, (inputs + 1,); NaN counts as 0."""
        known = np.nan_to_num(first)
        return cls(known[:-1], float(known[-1]), layout, fixed or {})

    def express(self, theta: Array) -> Array:
        """Parameters (..., n) of signals less their first values, for signals as they are."""
        found, theta = theta.copy(), self._all(theta)
        found[..., -1] += self.output * (1.0 - theta[..., self.layout.a].sum(axis=-1))
        for u, b, f in self._of_inputs():
            found[..., -1] -= u * theta[..., b].sum(axis=-1) / (1.0 - theta[..., f].sum(axis=-1))
        return found

    def take(self, theta: Array) -> Array:
        """Parameters (n,) of signals as they are, for signals less their first values."""
        found = theta.copy()
        found[-1] -= self.express(theta)[-1] - theta[-1]
        return found

    def gradient(self, theta: Array) -> Array:
        """Of the constant of signals as they are along all parameters, (..., n)."""
        theta = self._all(theta)
        found = np.zeros_like(theta)
        found[..., -1] = 1.0
        found[..., self.layout.a] = -self.output
        for u, b, f in self._of_inputs():
            slow = 1.0 - theta[..., f].sum(axis=-1, keepdims=True)
            found[..., b] = -u / slow
            found[..., f] = -u * theta[..., b].sum(axis=-1, keepdims=True) / slow**2
        return np.delete(found, list(self.fixed), axis=-1) if self.fixed else found

    def change(self, theta: Array) -> Array:
        """What makes of P (n, n) that of parameters for signals as they are, at `theta` (n,)."""
        change = np.eye(len(theta))
        change[-1] = self.gradient(theta)
        return change

    def _all(self, theta: Array) -> Array:
        """With the parameters that are fixed, each in its place."""
        if not self.fixed:
            return theta
        count = theta.shape[-1] + len(self.fixed)
        found = np.empty((*theta.shape[:-1], count))
        found[..., [i for i in range(count) if i not in self.fixed]] = theta
        found[..., list(self.fixed)] = list(self.fixed.values())
        return found

    def _of_inputs(self) -> Iterator[tuple[float, slice, slice]]:
        """First value, and places of B and F, of each input."""
        return zip(self.inputs.tolist(), self.layout.b, self.layout.f, strict=True)

    def covariance(self, theta: Array, covariance: Array) -> Array:
        """P (n, n) of parameters for signals as they are."""
        change = self.change(theta)
        return np.asarray(change @ covariance @ change.T)


def first_values(signals: Array) -> Array:
    """The first value of each column that is not missing, (c,); NaN where there is none.

    Examples
    --------
    >>> first_values(np.array([[np.nan, 1.0], [3.0, 2.0]])).tolist()
    [3.0, 1.0]
    """
    known = ~np.isnan(signals)
    rows = known.argmax(axis=0) if len(signals) else np.zeros(signals.shape[1], dtype=int)
    columns = np.arange(signals.shape[1])
    found = signals[rows, columns] if len(signals) else np.full(signals.shape[1], np.nan)
    return np.asarray(found)
