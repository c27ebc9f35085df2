"""What `ARMA`, `ARMAX`, `OE` and `BJ` say of outputs: a step ahead, to come, of a free run."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from forgetting._core import InvalidInput
from forgetting.frames import read, shaped_like
from forgetting.frames.channels import channels
from forgetting.models.fitted import inputs_of_run
from forgetting.models.polynomial_estimate import PolynomialEstimate

Array = NDArray[np.float64]


class PolynomialForecast(PolynomialEstimate):
    """The outputs of a model of polynomials, predicted from measured ones or from its own."""

    def predict(self, u: ArrayLike | None, y: ArrayLike) -> Any:
        """Predict each y(k) one step ahead, from everything before it and the final theta.

        The run starts at rest. Returns an array shaped like y, of pandas and xarray with their
        index; NaN in the first rows, whose lags are from before the record.
        """
        inputs, outputs = self._checked(u, y)
        predicted = np.asarray(self._model.predict(inputs, outputs))
        predicted[: self.reach] = np.nan
        return shaped_like(read("y", y), predicted if np.ndim(y) == 1 else predicted[:, None])

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

    def forecast(self, u: ArrayLike | int) -> Array:
        """Predict the outputs of the next samples, going on from the last one that was learned.

        Parameters
        ----------
        u : array_like, shape (steps,) or (steps, inputs), or int
            The inputs to come; for a model without inputs how many steps.

        Returns
        -------
        ndarray, shape (steps,)
        """
        self._check_is_fitted()
        inputs = self._inputs_of_run(u)
        nothing = np.full(len(inputs), np.nan)
        return np.asarray(self._model.predict(inputs, nothing, from_rest=False))

    def _inputs_of_run(self, u: ArrayLike | int) -> Array:
        inputs = inputs_of_run(u)
        self._match(inputs)
        if np.isnan(inputs).any():
            row = int(np.argwhere(np.isnan(inputs))[0][0])
            raise InvalidInput(f"u is missing in row {row}; a free run needs every value")
        return inputs
