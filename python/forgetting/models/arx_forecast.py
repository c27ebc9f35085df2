"""What an `ARX` model says of outputs: one step ahead, of those to come, and of a free run."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from forgetting._core import InvalidInput
from forgetting.frames import read, shaped_like
from forgetting.frames.channels import channels
from forgetting.models.arx_estimate import ARXEstimate
from forgetting.models.fitted import inputs_of_run
from forgetting.models.lags import regressors
from forgetting.models.orders import Orders
from forgetting.models.simulation import free_run
from forgetting.models.uncertainty import leverage, of_noise, of_parameters, root_of
from forgetting.prediction import Prediction, around, quantile

Array = NDArray[np.float64]


class ARXForecast(ARXEstimate):
    """The outputs of an `ARX` model, predicted from measured ones or from its own."""

    _tail: tuple[Array, Array]
    _single: bool

    def predict(self, u: ArrayLike | None, y: ArrayLike, level: float | None = None) -> Any:
        """Predict each y(k) one step ahead, from measured y(k-1), y(k-2), ... and the final theta.

        Returns an array shaped like y, of pandas and xarray with their index; NaN where a lag is
        missing, so always in the first `Orders.reach` rows. With a level a `Prediction` of three,
        the interval that holds this share of y(k): see `forecast`.
        """
        inputs, outputs = self._checked(u, y)
        phi = self._phi(inputs, outputs, self._orders(inputs))
        value = phi @ self._theta()
        if level is None:
            return self._like(y, value)
        spread = 1.0 + leverage(phi, root_of(self.estimator_))
        deviation = np.sqrt(np.outer(spread, self.noise_variance_))
        made = around(value, deviation, quantile(level))
        return Prediction(*(self._like(y, each) for each in made))

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
        ndarray, shape (steps,) or (steps, outputs)
            With a level a `Prediction` of three such arrays, value, lower and upper.

        Raises
        ------
        InvalidInput
            For a missing value in u or in the last rows that were learned.

        Notes
        -----
        The interval has the noise to come, normal and white, and the uncertainty of the parameters
        by the delta method, their covariance being that of P; of a bank (``rule="auto"``) the mean
        square of its errors, in which it shows as far as it does one step ahead. Inputs are
        supposed to be known.

        Examples
        --------
        >>> import numpy as np
        >>> import forgetting as fg
        >>> rng = np.random.default_rng(0)
        >>> y = np.zeros(1000)
        >>> for k in range(1, 1000):
        ...     y[k] = 0.9 * y[k - 1] + rng.normal()
        >>> ahead = fg.AR(1, rule="none").fit(None, y).forecast(20, level=0.95)
        >>> (ahead.upper - ahead.lower)[[0, 19]].round()  # twice 1.96 times 1 and 2.3
        array([4., 9.])
        """
        self._check_is_fitted()
        inputs = inputs_of_run(u)
        before, start = self._tail
        self._match(inputs, start)
        if np.isnan(before).any() or np.isnan(start).any():
            raise InvalidInput("a value in the last rows is missing; a forecast begins behind them")
        both = np.vstack([before, inputs])
        orders = self._orders(inputs)

        def run(theta: Array) -> Array:
            constant = theta[-1] if self.offset else 0.0
            coefficients = theta[: len(theta) - self.offset]
            return free_run(both, start, coefficients, orders, constant)[len(start) :]

        theta, outputs = self._theta(), self.n_outputs_
        value = run(theta)
        if level is None:
            return self._plain(value)
        feedback = theta[: self.na * outputs].reshape(self.na, outputs, outputs)
        share = of_noise(feedback.transpose(0, 2, 1), len(value))
        share = share + of_parameters(run, theta, root_of(self.estimator_))
        made = around(value, np.sqrt(share @ self.noise_variance_), quantile(level))
        return Prediction(*map(self._plain, made))

    def simulate(self, u: ArrayLike | int, y_start: ArrayLike | None = None) -> Array:
        """Run the model freely: its own past outputs stand in the lags, never measured ones.

        Parameters
        ----------
        u : array_like, shape (T,) or (T, inputs), or int
            Inputs without gaps; for a model without inputs the number of samples T.
        y_start : array_like, shape (r,) or (r, outputs), optional
            Outputs of the first r rows, copied into the result, from which the run starts.
            Everything before the record is zero (the system was at rest).

        Returns
        -------
        ndarray, shape (T,) or (T, outputs)
            Simulated outputs, shaped like the y given to `fit`.
        """
        self._check_is_fitted()
        inputs = inputs_of_run(u)
        start = np.empty((0, self.n_outputs_)) if y_start is None else channels("y_start", y_start)
        self._match(inputs, start)
        theta = self._theta()
        constant = theta[-1] if self.offset else 0.0
        coefficients = theta[: len(theta) - self.offset]
        simulated = free_run(inputs, start, coefficients, self._orders(inputs), constant)
        return self._plain(simulated)

    def _phi(self, inputs: Array, outputs: Array, orders: Orders) -> Array:
        phi = regressors(inputs, outputs, orders)
        return np.hstack([phi, np.ones((len(phi), 1))]) if self.offset else phi

    def _plain(self, values: Array) -> Array:
        """Values (T, outputs) in the shape of the y that was learned."""
        return values[:, 0] if self._single else values

    def _like(self, y: ArrayLike, values: Array) -> Any:
        """Values (T, outputs) shaped and indexed like y."""
        return shaped_like(read("y", y), values[:, 0] if np.ndim(y) == 1 else values)
