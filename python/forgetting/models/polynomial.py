"""What `ARMA`, `ARMAX`, `OE` and `BJ` share: signals in, an estimator behind, coefficients out."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from forgetting._core import RLS, Bank, SignalModel
from forgetting.frames.channels import channel_names
from forgetting.models.estimator import new_estimator
from forgetting.models.mean_square import MEMORY, MeanSquare
from forgetting.models.polynomial_forecast import PolynomialForecast
from forgetting.models.signal_origin import first_values

Array = NDArray[np.float64]


class Polynomial(PolynomialForecast):
    """A model A y = sum of B/F u + C/D e with an estimator behind it.

    Subclasses say in their constructor which orders there are; what is said here holds for all.

    A sample with a missing value (NaN) is left out, with every later sample whose measured lags
    reach it; in the meantime the model runs on its own predictions and on the last input.
    """

    rule: Any = "auto"
    weighting: Any = None
    gate: Any = None
    initial_covariance: Any = None
    dtype: str = "float64"

    def fit(self, u: ArrayLike | None, y: ArrayLike) -> Polynomial:
        """Forget everything and identify from a whole record.

        Parameters
        ----------
        u : array_like or data frame, shape (T,) or (T, inputs), or None
            Inputs; None for a model without. NaN is a missing value.
        y : array_like or data frame, shape (T,) or (T, 1)
            The output. NaN is a missing value.

        Returns
        -------
        Polynomial
            This object.

        Raises
        ------
        forgetting.InvalidInput
            When shapes or indexes disagree, an order or parameter is out of range, or a value is
            infinite.
        """
        inputs, outputs = self._signals(u, y)
        model, estimator = self._start(inputs.shape[1])
        noise = MeanSquare(1, MEMORY, skip=model.parameters)
        used = self._learn(model, estimator, noise, inputs, outputs)
        # set only after success, so that a refused record leaves the model as it was
        self.estimator_, self._model, self._noise, self.used_ = estimator, model, noise, used
        self._first = first_values(np.column_stack([inputs, outputs]))
        self.n_inputs_ = inputs.shape[1]
        self._labels = channel_names("y", y, 1), channel_names("u", u, inputs.shape[1])
        self.names_ = self.terms(self._labels[1], self._labels[0][0])
        return self

    def partial_fit(self, u: ArrayLike | None, y: ArrayLike) -> Polynomial:
        """Go on with the next rows; any split of a record gives the same as one `fit`.

        Parameters and errors are those of `fit`; the first call is `fit`.
        """
        if not hasattr(self, "estimator_"):
            return self.fit(u, y)
        inputs, outputs = self._checked(u, y)
        self.used_ += self._learn(self._model, self.estimator_, self._noise, inputs, outputs)
        now = first_values(np.column_stack([inputs, outputs]))
        self._first = np.where(np.isnan(self._first), now, self._first)
        return self

    def course(
        self, u: ArrayLike | None, y: ArrayLike, outputs: str | Sequence[str] = "theta"
    ) -> dict[str, Array]:
        """Identify from a whole record as `fit` does, and return what happened at each sample.

        Parameters
        ----------
        u, y
            As those of `fit`. This object does not change.
        outputs : str or sequence of str
            Of "theta" (T, n), the estimate after each sample; "error" (T,), y less its one-step
            prediction; "phi" (T, n) and "y" (T,), the linear regression that the estimator was
            given; "scale" (T,), the root of the weight of each sample in it, below 1 at the
            start; "skipped" (T,), see `forgetting.SKIPPED`. NaN where a sample was left out.

        Returns
        -------
        dict of str to ndarray

        Notes
        -----
        The estimator that `fit` leaves is, to the last bit, one that took "phi" and "y" with
        ``missing="skip"``: whatever is known of linear regressions (excitation, windup,
        certificates) can be asked of them.
        """
        inputs, measured = self._signals(u, y)
        model, estimator = self._start(inputs.shape[1])
        kept = model.learn(estimator, inputs, measured, outputs)
        return {name: kept[name] for name in kept if name != "used"}

    def _start(self, inputs: int) -> tuple[SignalModel, RLS | Bank]:
        model = self.at_rest(inputs)
        estimator = new_estimator(
            model.parameters,
            self.rule,
            weighting=self.weighting,
            gate=self.gate,
            initial_covariance=self.initial_covariance,
            dtype=self.dtype,
        )
        return model, estimator

    def _learn(
        self, model: SignalModel, estimator: Any, noise: MeanSquare, inputs: Array, outputs: Array
    ) -> int:
        kept = model.learn(estimator, inputs, outputs, outputs=("error", "scale"))
        errors, known = kept["error"], ~np.isnan(kept["error"])
        noise.add(errors[known, None] ** 2, kept["scale"][known] ** 2)
        return int(kept["used"])
