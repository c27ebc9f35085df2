"""Responses in time and over frequency, with confidence bands."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from forgetting._core import InvalidInput, numbers
from forgetting.polynomials.estimate import Array, Estimate, deviation, quantile
from forgetting.polynomials.transfer import Transfer, at_points, filtered

FREQUENCIES = 400
"""Points of a frequency response where none are given."""
LOWEST = 1e-3
"""The lowest of them, as a share of the highest, π/sample_time."""


@dataclass(frozen=True, eq=False)
class TimeResponse:
    """What the output does after a step or an impulse.

    Attributes
    ----------
    time : ndarray, shape (T,)
        Of each sample, in the unit of the sample time.
    value, standard_error : ndarray, shape (T,)
    title : str
        From what to what.
    """

    time: Array
    value: Array
    standard_error: Array
    title: str = ""

    def band(self, level: float = 0.95) -> tuple[Array, Array]:
        """Both ends of the confidence interval at each time, (T,) each; `level` in (0, 1)."""
        return Estimate(self.value, self.standard_error).interval(level)


@dataclass(frozen=True, eq=False)
class FrequencyResponse:
    """Gain and phase over frequency.

    Attributes
    ----------
    frequency : ndarray, shape (T,)
        In radians per unit of time.
    value : ndarray of complex, shape (T,)
    log_error, phase_error : ndarray, shape (T,)
        Standard errors of log|G| and of the phase in radians.
    title : str
        From what to what.
    """

    frequency: Array
    value: NDArray[np.complex128]
    log_error: Array
    phase_error: Array
    title: str = ""

    @property
    def magnitude(self) -> Array:
        """|G|, (T,)."""
        return np.abs(self.value)

    @property
    def phase(self) -> Array:
        """The phase in radians, without jumps, (T,)."""
        return np.unwrap(np.angle(self.value))

    def magnitude_band(self, level: float = 0.95) -> tuple[Array, Array]:
        """Both ends of the confidence interval of |G|, normal on a logarithmic scale."""
        factor = np.exp(quantile(level) * self.log_error)
        return self.magnitude / factor, self.magnitude * factor

    def phase_band(self, level: float = 0.95) -> tuple[Array, Array]:
        """Both ends of the confidence interval of the phase in radians."""
        return Estimate(self.phase, self.phase_error).interval(level)


def time_response(
    transfer: Transfer, covariance: Array, signal: Array, sample_time: float, title: str
) -> TimeResponse:
    """The response to a signal (T,), the system at rest before."""
    value, gradient = transfer.response(filtered, signal)
    time = np.asarray(sample_time * np.arange(len(signal)))
    return TimeResponse(time, value, deviation(gradient, covariance), title)


def frequency_response(
    transfer: Transfer, covariance: Array, frequency: Array, sample_time: float, title: str
) -> FrequencyResponse:
    """The response at frequencies (T,) in radians per unit of time."""
    z = np.exp(1j * frequency * sample_time)
    value, gradient = transfer.response(at_points(z), np.ones(len(z), complex))
    with np.errstate(divide="ignore", invalid="ignore"):
        relative = gradient / value  # the derivative of log G = log|G| + i phase
    errors = deviation(relative.real, covariance), deviation(relative.imag, covariance)
    return FrequencyResponse(frequency, value, *errors, title)


def static_gain(transfer: Transfer, covariance: Array) -> Estimate:
    """The response at rest, G(1); infinite with an integrator."""
    value, gradient = transfer.response(at_points(np.ones(1)), np.ones(1))
    with np.errstate(invalid="ignore"):
        return Estimate(value[0], deviation(gradient, covariance)[0])


def frequencies(given: ArrayLike | None, sample_time: float) -> Array:
    """The frequencies given, checked, or equal steps of a logarithm up to π/sample_time."""
    highest = np.pi / sample_time
    if given is None:
        return np.geomspace(LOWEST * highest, highest, FREQUENCIES)
    made = np.atleast_1d(numbers("frequency", given))
    good = (made > 0) & (made <= highest * (1 + 1e-12))
    if made.ndim != 1 or not good.all():
        wrong = made.shape if made.ndim != 1 else made[~good][0]
        raise InvalidInput(
            f"frequency = {wrong}, allowed: one row of numbers in (0, {highest:.6g}], π/sample_time"
        )
    return made
