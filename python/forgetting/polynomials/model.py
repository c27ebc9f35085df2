"""An identified linear model: its polynomials, and everything that follows from them."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from forgetting._core import InvalidInput
from forgetting.frames import read, shaped_like
from forgetting.frames.channels import channels, paired
from forgetting.polynomials import prediction
from forgetting.polynomials.checks import whole
from forgetting.polynomials.dynamics import Dynamics
from forgetting.polynomials.estimate import Array
from forgetting.polynomials.printed import printed
from forgetting.polynomials.residual_tests import ResidualTests, residual_tests


class PolynomialModel(Dynamics):
    """A(q) y(k) = Σ B_i(q)/F_i(q) u_i(k) + C(q)/D(q) e(k) + offset, with e white.

    q⁻¹ is the delay of one sample. A, C, D and F_i begin with 1, so that a first-order model
    y(k) = a1 y(k-1) + b1 u(k-1) + e(k) has A(q) = 1 - a1 q⁻¹ and its pole at a1: **as a parameter
    a1 has the sign of the difference equation, as a coefficient of A the other one.** So it is with
    d and f; b and c have the same sign in both.

    Standard errors follow from the covariance of the parameters to first order (the delta method).
    They are as good as that covariance: that of a forgetting rule supposes parameters that move as
    the rule does.

    Parameters
    ----------
    A, C, D : array_like
        Polynomials in powers of q⁻¹ that begin with 1.
    B : array_like, or sequence of array_like
        Coefficients b_nk, b_(nk+1), ... of each input, the delay not among them; one row of numbers
        for one input; nothing for no input.
    F : array_like, or sequence of array_like, optional
        Of each input, beginning with 1; 1 if not given.
    delay : int or sequence of int
        nk of each input, in samples.
    offset : float, optional
        If given it is a parameter, the last.
    sample_time : float
        > 0. Times, frequencies and time constants are in its unit.
    noise_variance : float, optional
        Of e, >= 0.
    covariance : array_like, shape (n, n), optional
        Of the parameters in the order and with the signs of `theta`: a1 ..., b ... of each input,
        c1 ..., d1 ..., f1 ... of each input, offset.
    input_names, input_units : sequence of str, optional
        Of each input.
    output_name, output_unit : str, optional

    Attributes
    ----------
    structure : Structure
        The orders.
    theta : ndarray, shape (n,)
    parameter_names : tuple of str
    covariance : ndarray, shape (n, n)
        NaN where it was not given.

    Raises
    ------
    forgetting.InvalidInput
        When a polynomial does not begin with 1, a shape does not fit, or a number is out of range.

    Examples
    --------
    >>> import forgetting as fg
    >>> model = fg.PolynomialModel([1, -0.8], [0.5], covariance=np.diag([1e-4, 4e-4]))
    >>> model
    A(q) y = B(q) u + e
      A(q) = 1 − 0.800(±0.010) q⁻¹
      B(q) = 0.500(±0.020) q⁻¹
      stable, sample time 1
    >>> float(model.poles().value[0].real), float(round(model.static_gain().value, 9))
    (0.8, 2.5)
    """

    def simulate(self, u: ArrayLike | int, y_start: ArrayLike = ()) -> Any:
        """Run the model freely, without noise.

        Parameters
        ----------
        u : array_like or data frame, shape (T,) or (T, inputs), or int
            Inputs without gaps; for a model without inputs the number of samples T.
        y_start : array_like, shape (r,)
            The first r outputs, of which the state at the first sample is estimated by least
            squares; NaN where missing. Without them the system was at rest before, with inputs of
            0 and the output that goes with that.

        Returns
        -------
        ndarray, shape (T,)
            Of pandas and xarray with its index.
        """
        given = np.empty((whole("u", u, 1), 0)) if isinstance(u, int) else channels("u", u)
        inputs, start = self._inputs(given), channels("y_start", y_start)[:, 0]
        if len(start) > len(inputs):
            raise InvalidInput(f"y_start has {len(start)} rows, allowed: {len(inputs)}, as u")
        table = None if isinstance(u, int) or np.ndim(u) != 1 else read("u", u)
        return shaped_like(table, prediction.free_run(self, inputs, start))

    def predict(self, u: ArrayLike | None, y: ArrayLike, steps: int | None = 1) -> Any:
        """The best prediction of each y(k) from the outputs up to y(k - steps), and all inputs.

        Parameters
        ----------
        u : array_like or data frame, shape (T,) or (T, inputs), or None
            Inputs without gaps; None for a model without inputs.
        y : array_like or data frame, shape (T,)
            Outputs; NaN where missing: the model then stands in for them.
        steps : int or None
            How many samples ahead, >= 1; None for a free run.

        Returns
        -------
        ndarray, shape (T,)
            Of pandas and xarray with its index. The state at the first sample is that which
            explains the record best.

        Raises
        ------
        forgetting.InvalidInput
            Also when C or F has a root that is not inside the unit circle.
        """
        inputs, outputs = self._data(u, y)
        if steps is None:
            made = prediction.free_run(self, inputs, outputs)
        else:
            made = prediction.predicted(self, inputs, outputs, whole("steps", steps, 1))
        return shaped_like(read("y", y), made if np.ndim(y) == 1 else made[:, None])

    def residuals(self, u: ArrayLike | None, y: ArrayLike) -> Any:
        """y minus its one-step prediction, (T,); NaN where y is missing. See `predict`."""
        inputs, outputs = self._data(u, y)
        made = prediction.residuals(self, inputs, outputs)
        return shaped_like(read("y", y), made if np.ndim(y) == 1 else made[:, None])

    def fit_percent(self, u: ArrayLike | None, y: ArrayLike, steps: int | None = None) -> float:
        """How much of y a free run (or a prediction) explains, 100 (1 - |y - ŷ|/|y - mean of y|).

        100 is perfect, 0 no better than the mean, and there is no lower limit: -inf for a free
        run that diverges. NaN where y is constant. Parameters are those of `predict`.
        """
        measured = self._data(u, y)[1]
        error = measured - np.asarray(self.predict(u, y, steps)).reshape(-1)
        known = ~np.isnan(measured)
        if not known.any():
            return float("nan")
        spread = np.linalg.norm(measured[known] - measured[known].mean())
        with np.errstate(over="ignore", invalid="ignore"):
            left = np.linalg.norm(error[known])
        if not np.isfinite(left):
            return float("-inf")
        return float(100 * (1 - left / spread)) if spread else float("nan")

    def residual_tests(
        self, u: ArrayLike | None, y: ArrayLike, lags: int | None = None, fitted: bool = True
    ) -> ResidualTests:
        """Whether the residuals are white, and independent of the inputs.

        Parameters
        ----------
        u, y : array_like or data frame
            As those of `predict`.
        lags : int, optional
            At most a quarter of the samples; 25 if not given.
        fitted : bool
            Whether the model was estimated from these data, which makes the residuals whiter than
            the noise; False for data that the model has not seen.
        """
        inputs, outputs = self._data(u, y)
        errors = prediction.residuals(self, inputs, outputs)
        errors[: prediction.System.of(self).order] = np.nan  # what the initial state explains
        of_noise = self.structure.na + self.structure.nc + self.structure.nd
        names = self.input_names, self.output_name
        return residual_tests(errors, inputs, *names, lags, of_noise if fitted else 0)

    def _data(self, u: ArrayLike | None, y: ArrayLike) -> tuple[Array, Array]:
        inputs, outputs = paired(u, y)
        if outputs.shape[1] != 1:
            raise InvalidInput(f"y has {outputs.shape[1]} columns, allowed: 1")
        if len(outputs) == 0:
            raise InvalidInput("y has no rows, allowed: at least 1")
        return self._inputs(inputs), outputs[:, 0]

    def _inputs(self, inputs: Array) -> Array:
        if inputs.shape[1] != self.structure.inputs:
            raise InvalidInput(
                f"u has {inputs.shape[1]} channels, allowed: {self.structure.inputs}"
            )
        if not len(inputs):
            raise InvalidInput("u has no rows, allowed: at least 1")
        if np.isnan(inputs).any():
            row = int(np.argwhere(np.isnan(inputs))[0][0])
            raise InvalidInput(f"u is missing in row {row}, allowed: inputs without gaps")
        return inputs

    def __repr__(self) -> str:
        return printed(self)
