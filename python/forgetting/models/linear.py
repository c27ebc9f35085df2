"""A linear model, with a constant or without, learned sample by sample."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from forgetting._core import Bank
from forgetting.models.estimator import new_estimator
from forgetting.models.mean_square import MEMORY, MeanSquare

Array = NDArray[np.float64]

SHORT_MEMORY = 100
"""Samples over which the squared errors of a bank are averaged; they change as its weights do."""


class Linear:
    """y = constant + x @ coefficients, an estimator and the point that it measures from.

    A model with a constant says the same of x - x0 and y - y0, with another constant. Measured from
    its first sample, columns that are large and vary little (a temperature in kelvin, a time stamp)
    lose no digits, and what is believed beforehand does not depend on where a unit has its zero.
    Where an initial covariance is given, it is about x as it is, and nothing is moved.

    Parameters
    ----------
    features : int
        Columns of x.
    targets : int
        Columns of y.
    rule : str or Rule
        "auto" or the rule; see `forgetting.models.estimator.new_estimator`.
    constant : bool
        Whether there is a constant; it is the first parameter.
    moves : bool
        Whether a model with a constant measures from its first sample.
    noise : bool
        Whether to average squared errors, which `deviation` needs.
    initial_covariance : optional
        As that of `forgetting.RLS`, the constant first.
    **settings
        Others of `forgetting.RLS` and `forgetting.Bank`.

    Attributes
    ----------
    features : int
    estimator : RLS or Bank

    Examples
    --------
    >>> x = np.array([[300.0], [301.0], [303.0]])
    >>> line = Linear(1, 1, "none", constant=True)
    >>> line.learn(x, 2.0 * x)
    >>> line.predict(np.array([[310.0]])).round(3).tolist()
    [[620.0]]
    """

    def __init__(
        self,
        features: int,
        targets: int,
        rule: Any,
        *,
        constant: bool,
        moves: bool = True,
        noise: bool = True,
        initial_covariance: Any = None,
        **settings: Any,
    ) -> None:
        self.features = features
        self._constant, self._targets = constant, targets
        self._moves = moves and constant and initial_covariance is None
        self._origin = np.zeros(features), np.zeros(targets)
        settings = {"initial_covariance": initial_covariance, "targets": targets, **settings}
        self.estimator = new_estimator(features + constant, rule, **settings)
        self._is_bank = isinstance(self.estimator, Bank)
        memory = SHORT_MEMORY if self._is_bank else MEMORY
        self._noise = MeanSquare(targets, memory, skip=features + constant) if noise else None

    def learn(self, x: Array, y: Array, weight: Array | None = None) -> None:
        """Take samples in their order: x (T, features), y (T, targets), weight (T,) > 0.

        The weight of a sample divides the variance of its noise. Only the ratios of weights matter
        where no initial covariance is given.

        Raises
        ------
        InvalidInput, NumericalRange
            As `RLS.run`; the model is then as it was before.
        """
        if not len(x):
            return
        before = self._origin
        if self._moves and not self.estimator.samples:
            self._origin = x[0].copy(), y[0].copy()
        phi, y = self._phi(x), y - self._origin[1]
        if weight is not None:
            # noise of variance 1/w is one of variance 1 in a sample that is root w times as large;
            # told as a covariance of the noise, weights in other units would be another model
            root = np.sqrt(weight)[:, None]
            phi, y = root * phi, root * y
        try:
            self._learn(phi, y)
        except Exception:
            self._origin = before
            raise

    def _learn(self, phi: Array, y: Array) -> None:
        if self._noise is not None:
            run = self.estimator.run(phi, y, outputs=("error", "leverage", "skipped"))
            squares = np.asarray(run.error).reshape(y.shape) ** 2
            if not self._is_bank:
                squares /= 1.0 + np.asarray(run.leverage)[:, None]
            self._noise.add(squares[run.skipped == 0])
        elif len(phi) == 1:  # a record of one sample costs more
            self.estimator.update(phi[0], y[0])
        else:
            self.estimator.run(phi, y, outputs=())

    def predict(self, x: Array) -> Array:
        """The prediction (T, targets) for x (T, features)."""
        predicted = np.asarray(self.estimator.predict(self._phi(x)))
        return np.asarray(predicted.reshape(len(x), self._targets) + self._origin[1])

    def deviation(self, x: Array) -> Array:
        """The standard deviation (T, targets) of a measurement of weight 1 at x (T, features).

        Of one rule sqrt(s² (1 + φPφᵀ)), s² the mean of e²/(1 + leverage) over up to the last
        thousand samples. Of a bank the root of the mean of e² over the last hundred, the same for
        every x: members that are hardly believed may know so little that they rule the covariance
        of the mixture, but not its predictions. NaN until more samples than parameters were used.
        """
        if self._noise is None:
            return np.full((len(x), self._targets), np.nan)
        phi = self._phi(x)
        leverage = np.zeros(len(x))
        if not self._is_bank:
            leverage = np.einsum("ti,ij,tj->t", phi, self.estimator.covariance, phi)
        return np.asarray(np.sqrt(np.outer(1.0 + leverage, self._noise.value)))

    @property
    def coefficients(self) -> Array:
        """Coefficients, (features, targets)."""
        theta = np.asarray(self.estimator.theta).reshape(-1, self._targets)
        return theta[1:] if self._constant else theta

    @property
    def constant(self) -> Array:
        """The constant of each target, (targets,); 0 in a model without."""
        if not self._constant:
            return np.zeros(self._targets)
        theta = np.asarray(self.estimator.theta).reshape(-1, self._targets)
        return np.asarray(theta[0] + self._origin[1] - self._origin[0] @ theta[1:])

    def _phi(self, x: Array) -> Array:
        phi = np.ones((len(x), self.estimator.parameters))
        np.subtract(x, self._origin[0], out=phi[:, int(self._constant) :])
        return phi
