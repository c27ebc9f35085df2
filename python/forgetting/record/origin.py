"""Where a model with a constant measures from: the first sample in place of zero.

A model y = c + phi theta says the same of y - y0 and phi - phi0 for any y0 and phi0, with
another c. Measured from their first values, columns that are large and vary little (a temperature
in kelvin, a time stamp, a plant about its operating point) become of the size by which they vary:
no digits are lost, and what is believed beforehand does not depend on where a unit has its zero.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from forgetting.record.moved import Moved
from forgetting.record.samples import Samples, pieces
from forgetting.record.trace import Trace

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Origin:
    """The point that regressors and outputs are measured from.

    Attributes
    ----------
    constant : int or None
        The column that is the constant; None where there is none, and nothing is moved.
    level : float
        Its value.
    phi : ndarray, shape (n,)
        What is taken from each regressor; 0 for the constant.
    y : ndarray, shape (m,)
        What is taken from each output.
    """

    constant: int | None
    level: float
    phi: Array
    y: Array

    def moved(self, samples: Samples) -> Moved:
        """The samples, measured from here."""
        return Moved(samples) if self.constant is None else Moved(samples, self.phi, self.y)

    def theta(self, theta: Array) -> Array:
        """Estimates (T, n, m) over `moved` samples in terms of the samples; changed in place."""
        if self.constant is not None:
            at_zero = self.y - weighted_sum(self.phi, theta)
            theta[:, self.constant] += at_zero / self.level
        return theta

    def change(self) -> Array:
        """What makes of parameters over `moved` samples those of the samples, (n, n)."""
        change = np.eye(len(self.phi))
        if self.constant is not None:
            change[self.constant] -= self.phi / self.level
        return change

    def covariance(self, covariance: Array) -> Array:
        """P (K, n, n) of an estimator over `moved` samples for the samples as they are."""
        if self.constant is None:
            return covariance
        return at_zero(covariance, self.change()[self.constant], self.constant)

    def back(self, trace: Trace) -> Trace:
        """What a run over `moved` samples found, in the terms of the samples; changed in place.

        The variance of the constant is exact after each piece of the run, and drawn straight in
        between.
        """
        if self.constant is None:
            return trace
        c, change = self.constant, self.change()
        ends = np.einsum("i,kij,j->k", change[c], trace.covariances, change[c])
        trace.variance[:, c] = np.interp(np.arange(len(trace.variance)), trace.rows, ends)
        covariance = change @ trace.covariance @ change.T
        return replace(trace, theta=self.theta(trace.theta), covariance=covariance)


def origin(samples: Samples, moves: bool = True) -> Origin:
    """The first complete sample, if the model has a constant and `moves`; else zero.

    Examples
    --------
    >>> import numpy as np
    >>> phi = np.array([[1.0, 300.0], [1.0, 301.0]])
    >>> here = origin(Samples(phi, np.array([[5.0], [6.0]]), ("1", "T"), ("y",), "", None, ""))
    >>> here.constant, here.phi.tolist(), here.y.tolist()
    (0, [0.0, 300.0], [5.0])
    """
    constant, level = constant_of(samples) if moves else (None, 1.0)
    if constant is None:
        return nowhere(samples)
    row = int(samples.complete.argmax())
    first = samples.phi[row].copy()
    first[constant] = 0.0
    return Origin(constant, level, first, samples.y[row].copy())


def nowhere(samples: Samples) -> Origin:
    """Zero, where nothing is moved."""
    return Origin(None, 1.0, np.zeros(samples.phi.shape[1]), np.zeros(samples.y.shape[1]))


def constant_of(samples: Samples) -> tuple[int | None, float]:
    """The column that is a constant, and its value; (None, 1.0) if there is none.

    A model that makes its own regressors has measured its signals from their first values already.
    """
    if samples.is_pseudolinear:
        return None, 1.0
    first = samples.phi[samples.complete.argmax()]
    same = np.flatnonzero(constants(Moved(samples)) & (first != 0))
    if samples.complete.sum() < 2 or not len(same):
        return None, 1.0
    return int(same[0]), float(first[same[0]])


def constants(samples: Moved) -> NDArray[np.bool_]:
    """Which regressors are the same in all complete rows, (n,)."""
    row = int(samples.complete.argmax())
    (first,), _ = samples.rows(slice(row, row + 1))
    same = np.ones(samples.parameters, dtype=bool)
    for part in pieces(len(samples)):
        same &= (samples.known_rows(part) == first).all(axis=0)
    return same


def at_zero(covariance: Array, change: Array, constant: int) -> Array:
    """P (K, n, n) where the constant is that of regressors measured from zero.

    `change` (n,) makes that constant of the parameters; the others stay as they are.

    Examples
    --------
    >>> at_zero(np.eye(2)[None], np.array([1.0, -3.0]), 0)[0].tolist()
    [[10.0, -3.0], [-3.0, 1.0]]
    """
    made = np.array(covariance, dtype=np.float64)
    row = weighted_sum(change, covariance)
    made[:, constant] = made[:, :, constant] = row
    made[:, constant, constant] = weighted_sum(change, row)
    return made


def weighted_sum(weights: Array, values: Array) -> Array:
    """Sum of weights[i] times values[:, i], in this order: every grouping of rows rounds alike.

    Examples
    --------
    >>> weighted_sum(np.array([1.0, 2.0]), np.array([[[3.0], [4.0]]]))
    array([[11.]])
    """
    # of values that no estimator takes the sum may be infinite
    with np.errstate(over="ignore", invalid="ignore"):
        total = weights[0] * values[:, 0]
        for i in range(1, len(weights)):
            total = total + weights[i] * values[:, i]
    return np.asarray(total)
