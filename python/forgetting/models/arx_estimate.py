"""What an `ARX` model has found: its estimate, and the polynomial model that it stands for."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from forgetting._core import InvalidInput
from forgetting.frames.channels import paired
from forgetting.models.fitted import Fitted
from forgetting.models.identified import identified
from forgetting.models.mean_square import MeanSquare
from forgetting.models.orders import Orders, per_input
from forgetting.polynomials import PolynomialModel, Structure

Array = NDArray[np.float64]


class ARXEstimate(Fitted):
    """The estimate of an `ARX` model, and the signals that fit it."""

    na: int
    nb: int | Sequence[int]
    nk: int | Sequence[int]
    offset: bool
    n_inputs_: int
    n_outputs_: int
    _labels: tuple[list[str], list[str]]
    _noise: MeanSquare

    def model(self, theta: ArrayLike | None = None, *, sample_time: float = 1.0) -> PolynomialModel:
        """Return what was identified of one output as a model: poles, gains, responses, tests.

        Parameters
        ----------
        theta : (n,) array_like, optional
            The estimate at another sample; the last if not given. What is said of standard errors
            is that of the last sample.
        sample_time : float, default 1
            Time between samples, in which times and frequencies are told.
        """
        self._check_is_fitted()
        if self.n_outputs_ != 1:
            raise InvalidInput(f"the model has {self.n_outputs_} outputs; only one can be shown so")
        nb, nk = (per_input(name, getattr(self, name), self.n_inputs_) for name in ("nb", "nk"))
        return identified(
            Structure(na=self.na, nb=nb, nk=nk, offset=self.offset),
            np.ravel(self.theta_ if theta is None else theta),
            self.covariance_,
            float(self.noise_variance_[0]),
            self._labels,
            by_lag=True,
            sample_time=sample_time,
        )

    @property
    def theta_(self) -> Array:
        """Estimate after the last sample, (n,) or (n, outputs)."""
        return np.asarray(self._learned("theta_").theta)

    @property
    def covariance_(self) -> Array:
        """P after the last sample, (n, n)."""
        return np.asarray(self._learned("covariance_").covariance)

    @property
    def noise_variance_(self) -> Array:
        """Variance of the noise of each output, (outputs,), over up to the last thousand samples.

        Of a rule the mean of e²/(1 + leverage), of a bank that of e². NaN while there are too few.
        """
        self._learned("noise_variance_")
        return self._noise.value

    def _theta(self) -> Array:
        return np.asarray(self.estimator_.theta, dtype=np.float64).reshape(-1, self.n_outputs_)

    def _orders(self, inputs: Array) -> Orders:
        orders = Orders(self.na, self.nb, self.nk)
        if (orders.nb != 0) != (inputs.shape[1] > 0):
            given = f"{inputs.shape[1]} input(s)"
            raise InvalidInput(f"nb is {orders.nb} but u has {given}; nb = 0 goes with u = None")
        return orders

    def _checked(self, u: ArrayLike | None, y: ArrayLike) -> tuple[Array, Array]:
        self._check_is_fitted()
        inputs, outputs = paired(u, y)
        self._match(inputs, outputs)
        return inputs, outputs

    def _match(self, inputs: Array, outputs: Array) -> None:
        for name, given, expected in (
            ("u", inputs.shape[1], self.n_inputs_),
            ("y", outputs.shape[1], self.n_outputs_),
        ):
            if given != expected:
                raise InvalidInput(f"{name} has {given} channels; the model has {expected}")
