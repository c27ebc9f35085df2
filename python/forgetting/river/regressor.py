"""Recursive least squares with forgetting as a regressor of river."""

from __future__ import annotations

from collections import deque
from collections.abc import Hashable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray
from river import base

from forgetting._core import InvalidInput
from forgetting.models.linear import Linear
from forgetting.models.orders import whole
from forgetting.river.features import Columns, finite, row, with_new

Array = NDArray[np.float64]

SPARE = 10
"""Parameters of a bank at first: up to so many it is as fast as with one."""


class RecursiveRegressor(base.Regressor):
    """Linear regression that follows its coefficients over time, features by names.

    A name that is not in a sample counts as 0 there, so 0 should mean nothing (`preprocessing` has
    scalers and imputers for what has another zero). A new name gets a coefficient of its own from
    its first sample on, 0 with the covariance of the beginning:

    - With ``rule="auto"`` there is room for names to come, ten parameters at first. A regressor
      that has always been 0 disturbs no other. When the room is full it is doubled, and the last
      `history` samples are learned once more: up to so many samples that gives exactly what a
      regressor with the larger room would have learned; of longer streams the rest is lost.
    - With a rule and an `initial_covariance`, P gets one row and column, 0 but for the diagonal,
      and nothing is lost but what rules and rates remember beside P.
    - With a rule and without a covariance, the last `history` samples are learned once more.

    Parameters
    ----------
    rule : str, Rule or None, default "auto"
        How to forget: "auto" mixes random walks of all speeds, `forgetting.Bank`; else a rule by
        its name or as an object, ``forgetting.Subspace(0.98)``, or None for that of
        `forgetting.RLS`. Where features stay away for long, choose one that bounds P; with
        exponential forgetting it grows for ever.
    fit_intercept : bool, default True
        Whether there is a constant, which may change over time as coefficients do.
    weighting : str or Weighting, optional
        How far to trust a sample, by its innovation: ``forgetting.Huber()`` for outliers.
    initial_covariance : float, optional
        Variance of each coefficient and of the constant before the first sample, in units of 1/x².
        If not given it follows the data, and units need no scaling.
    history : int, default 1000
        Samples that are kept in case that a name comes for which there is no room.

    Examples
    --------
    >>> from river import datasets, evaluate, metrics
    >>> from forgetting.river import RecursiveRegressor
    >>> record, model = datasets.TrumpApproval(), RecursiveRegressor()
    >>> evaluate.progressive_val_score(record, model, metrics.MAE())
    MAE: 0.19...
    """

    def __init__(
        self,
        rule: Any = "auto",
        fit_intercept: bool = True,
        weighting: Any = None,
        initial_covariance: float | None = None,
        history: int = 1000,
    ) -> None:
        self.rule = rule
        self.fit_intercept = fit_intercept
        self.weighting = weighting
        self.initial_covariance = initial_covariance
        self.history = history
        self._columns: Columns = {}
        self._model: Linear | None = None
        self._past: deque[tuple[Array, float, float]] = deque(maxlen=whole("history", history))

    def learn_one(self, x: Mapping[Hashable, Any], y: float, w: float = 1.0) -> None:
        """Take one sample.

        Parameters
        ----------
        x : dict
            Features by their names: finite numbers.
        y : float
        w : float, default 1
            Its weight >= 0, which divides the variance of its noise; 0 leaves it out.

        Raises
        ------
        InvalidInput, NumericalRange
            Names the feature or parameter; nothing has changed.
        """
        weight, target = finite("w", w), finite("y", y)
        if weight < 0:
            raise InvalidInput(f"w = {w!r}, allowed: numbers >= 0")
        columns = with_new(self._columns, x)
        model = self._model
        if model is None or len(columns) > model.features:
            model = self._with_room(len(columns))
        phi = row(x, columns, model.features)
        if weight > 0:
            model.learn(phi[None], np.array([[target]]), np.array([weight]))
            # set only after success, so that a sample that is refused leaves all as it was
            self._columns, self._model = columns, model
            self._past.append((phi, target, weight))

    def predict_one(self, x: Mapping[Hashable, Any]) -> float:
        """The prediction with the coefficients of now; names without one are left out."""
        if self._model is None:
            return 0.0
        return float(self._model.predict(row(x, self._columns, self._model.features)[None])[0, 0])

    @property
    def weights(self) -> dict[Hashable, float]:
        """The coefficients by name."""
        if self._model is None:
            return {}
        coefficients = self._model.coefficients[:, 0]
        return {name: float(coefficients[column]) for name, column in self._columns.items()}

    @property
    def intercept(self) -> float:
        """The constant; 0 without one."""
        return 0.0 if self._model is None else float(self._model.constant[0])

    def _with_room(self, names: int) -> Linear:
        """A model for so many names, which knows what this one does."""
        if self.rule == "auto":
            before = SPARE - self.fit_intercept if self._model is None else self._model.features
            while before < names:
                before = max(2 * before, 1)
            return self._replayed(before)
        if self.initial_covariance is not None and self._model is not None:
            return self._widened(self._model, names)
        return self._replayed(names)

    def _replayed(self, features: int) -> Linear:
        model = self._fresh(features)
        if self._past:
            phi, y, weight = zip(*self._past, strict=True)
            x = np.zeros((len(phi), features))
            for k, known in enumerate(phi):
                x[k, : len(known)] = known
            model.learn(x, np.array(y)[:, None], np.array(weight))
        return model

    def _widened(self, model: Linear, features: int) -> Linear:
        old, more = model.estimator, features - model.features
        covariance = np.diag([*np.zeros(old.parameters), *[self.initial_covariance] * more])
        covariance[: old.parameters, : old.parameters] = old.covariance
        theta = np.append(old.theta, np.zeros(more))
        return self._fresh(features, initial_covariance=covariance, initial_theta=theta)

    def _fresh(self, features: int, **settings: Any) -> Linear:
        covariance = self.initial_covariance
        if covariance is not None:
            settings.setdefault("initial_covariance", finite("initial_covariance", covariance))
        return Linear(
            features,
            1,
            self.rule,
            constant=self.fit_intercept,
            moves=False,  # 0 means absent, and stays 0
            noise=False,
            **{"weighting": self.weighting, **settings},
        )
