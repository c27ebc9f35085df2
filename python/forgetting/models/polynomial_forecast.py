"""What `ARMA`, `ARMAX`, `OE` and `BJ` say of outputs: a step ahead, to come, of a free run."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from forgetting._core import InvalidInput
from forgetting.frames import read, shaped_like
from forgetting.frames.channels import channels
from forgetting.models.fitted import inputs_of_run
from forgetting.models.gradient import Coefficients
from forgetting.models.interval import Learned
from forgetting.models.polynomial_estimate import PolynomialEstimate
from forgetting.prediction import Prediction, around, quantile

Array = NDArray[np.float64]


class PolynomialForecast(PolynomialEstimate):
    """The outputs of a model of polynomials, predicted from measured ones or from its own."""

    def predict(self, u: ArrayLike | None, y: ArrayLike, level: float | None = None) -> Any:
        """Predict each y(k) one step ahead, from everything before it and the final theta.

        The run starts at rest. Returns an array shaped like y, of pandas and xarray with their
        index; NaN in the first rows, whose lags are from before the record. With a level a
        `Prediction` of three, the interval that holds this share of y(k): see `forecast`. Where
        outputs before are missing it is as wide as they leave it.
        """
        inputs, outputs = self._checked(u, y)
        predicted = np.asarray(self._model.predict(inputs, outputs))
        shown = predicted.copy()
        shown[: self.reach] = np.nan

        def like(values: Array) -> Any:
            return shaped_like(read("y", y), values if np.ndim(y) == 1 else values[:, None])

        if level is None:
            return like(shown)
        z = quantile(level)
        deviation = self._known().of_record(inputs, outputs, predicted)
        return Prediction(*map(like, around(shown, deviation, z)))

    def simulate(self, u: ArrayLike | int, y_start: ArrayLike | None = None) -> Array:
        """Run the model freely from rest: no measured output, no noise.

        Parameters
        ----------
        u : array_like, shape (T,) or (T, inputs), or int
            Inputs without gaps; for a model without inputs the number of samples T.
        y_start : array_like, shape (r,), optional
            Outputs of the first r rows, from which the run starts.

        Returns
        -------
        ndarray, shape (T,)
        """
        self._check_is_fitted()
        inputs = self._inputs_of_run(u)
        outputs = np.full(len(inputs), np.nan)
        start = np.empty(0) if y_start is None else channels("y_start", y_start)[:, 0]
        if len(start) > len(outputs):
            raise InvalidInput(f"y_start has {len(start)} rows, more than the {len(outputs)} of u")
        outputs[: len(start)] = start
        simulated = np.asarray(self._model.predict(inputs, outputs))
        simulated[: len(start)] = start
        return simulated

    def forecast(self, u: ArrayLike | int, level: float | None = None) -> Any:
        """Predict the outputs of the next samples, going on from the last one that was learned.

        Parameters
        ----------
        u : array_like, shape (steps,) or (steps, inputs), or int
            The inputs to come; for a model without inputs how many steps.
        level : float, optional
            Share of outputs that an interval about each is to hold, between 0 and 1.

        Returns
        -------
        ndarray, shape (steps,)
            With a level a `Prediction` of three such arrays, value, lower and upper.

        Raises
        ------
        InvalidInput
            For a missing value in u; with a level also for one in the last rows that were learned.

        Notes
        -----
        The interval has the noise to come, normal and white before C/(A D), and the uncertainty of
        the parameters by the delta method, their covariance being that of P; of a bank
        (``rule="auto"``) the mean square of its errors alone. Inputs are supposed to be known.
        """
        self._check_is_fitted()
        inputs = self._inputs_of_run(u)
        nothing = np.full(len(inputs), np.nan)
        value = np.asarray(self._model.predict(inputs, nothing, from_rest=False))
        if level is None:
            return value
        z = quantile(level)
        return around(value, self._known().to_come(inputs, value), z)

    def _known(self) -> Learned:
        """What was learned, in the signals that the estimator was given."""
        theta, origin = self.theta_, self.origin(self._first)
        measured = theta if origin is None else origin.take(theta)
        first = np.nan_to_num(self._first) * self.offset
        own = Coefficients.of(measured, self._orders(self.n_inputs_), self.offset)
        known = self._model, self.estimator_, self.noise_variance_
        return Learned(*known, measured, first, own)

    def _inputs_of_run(self, u: ArrayLike | int) -> Array:
        inputs = inputs_of_run(u)
        self._match(inputs)
        if np.isnan(inputs).any():
            row = int(np.argwhere(np.isnan(inputs))[0][0])
            raise InvalidInput(f"u is missing in row {row}; a free run needs every value")
        return inputs
