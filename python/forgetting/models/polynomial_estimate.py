"""What `ARMA`, `ARMAX`, `OE` and `BJ` have found: estimate, covariance, and the model of both."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from forgetting._core import InvalidInput, SignalModel
from forgetting.frames.channels import paired
from forgetting.models.fitted import Fitted
from forgetting.models.identified import identified
from forgetting.models.mean_square import MeanSquare
from forgetting.models.polynomial_structure import PolynomialStructure
from forgetting.polynomials import PolynomialModel, Structure

Array = NDArray[np.float64]


class PolynomialEstimate(PolynomialStructure, Fitted):
    """The estimate of a model of polynomials, and the signals that fit it."""

    n_inputs_: int
    _first: Array
    _labels: tuple[list[str], list[str]]
    _model: SignalModel
    _noise: MeanSquare

    def model(self, theta: ArrayLike | None = None, *, sample_time: float = 1.0) -> PolynomialModel:
        """Return what was identified as a model: poles, gains, responses, tests of its residuals.

        Parameters
        ----------
        theta : (n,) array_like, optional
            The estimate at another sample, a row of ``course(...)["theta"]``; the last if not
            given. What is said of standard errors is that of the last sample.
        sample_time : float, default 1
            Time between samples, in which times and frequencies are told.
        """
        self._check_is_fitted()
        orders = self._orders(self.n_inputs_)
        each = np.array(orders["inputs"], dtype=int).reshape(-1, 3)
        structure = Structure(
            na=orders["na"],
            nb=each[:, 0].tolist(),
            nc=orders["nc"],
            nd=orders["nd"],
            nf=each[:, 1].tolist(),
            nk=each[:, 2].tolist(),
            offset=self.offset,
        )
        return identified(
            structure,
            self.theta_ if theta is None else theta,
            self.covariance_,
            self.noise_variance_,
            self._labels,
            sample_time=sample_time,
        )

    @property
    def theta_(self) -> Array:
        """Estimate after the last sample, (n,): a, b of each input, c, d, f of each input, offset.

        That of the estimator; or, where C or F of it is unstable, as far on the way there as they
        are stable.
        """
        return np.asarray(self._learned("theta_", "_model").theta)

    @property
    def covariance_(self) -> Array:
        """P after the last sample, (n, n); times `noise_variance_` the covariance of `theta_`."""
        covariance = np.asarray(self._learned("covariance_", "estimator_").covariance)
        origin = self.origin(self._first)
        return covariance if origin is None else origin.covariance(self.theta_, covariance)

    @property
    def noise_variance_(self) -> float:
        """Variance of e, over up to the last thousand samples; NaN while there are too few.

        The mean square of errors, each counting as much as its sample: less at the start.
        """
        return float(self._learned("noise_variance_", "_noise").value[0])

    @property
    def samples_(self) -> int:
        """Rows seen since `fit`."""
        return int(self._learned("samples_", "_model").samples)

    @property
    def reach(self) -> int:
        """Rows that must come before a sample so that every measured lag exists."""
        return self.reach_of(getattr(self, "n_inputs_", 1))

    def _signals(self, u: ArrayLike | None, y: ArrayLike) -> tuple[Array, Array]:
        inputs, outputs = paired(u, y)
        if outputs.shape[1] != 1:
            raise InvalidInput(
                f"y has {outputs.shape[1]} outputs; {type(self).__name__} has one, "
                "so make one model an output (ARX takes several)"
            )
        return inputs, np.ascontiguousarray(outputs[:, 0])

    def _checked(self, u: ArrayLike | None, y: ArrayLike) -> tuple[Array, Array]:
        self._check_is_fitted()
        inputs, outputs = self._signals(u, y)
        self._match(inputs)
        return inputs, outputs

    def _match(self, inputs: Array) -> None:
        if inputs.shape[1] != self.n_inputs_:
            raise InvalidInput(f"u has {inputs.shape[1]} channels; the model has {self.n_inputs_}")
