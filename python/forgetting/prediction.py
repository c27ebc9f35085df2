"""Predictions with the interval that the next measurement falls into."""

from __future__ import annotations

from copy import copy
from statistics import NormalDist
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ._core import RLS, Bank, InvalidInput

RECENT = 100
"""Errors of a bank whose mean square counts; it changes as the weights of the members do."""


class Prediction(NamedTuple):
    """A prediction and its interval.

    Attributes
    ----------
    value, lower, upper : float or ndarray
        As the prediction without an interval is shaped; NaN where it is not known.
    """

    value: Any
    lower: Any
    upper: Any


def predict(
    estimator: RLS | Bank, phi: ArrayLike, level: float = 0.95, *, errors: ArrayLike | None = None
) -> Prediction:
    """Predict phi @ theta, with the interval that holds the next measurement.

    Parameters
    ----------
    estimator : RLS or Bank
        Of one target and row. An RLS needs ``monitor=True``, which tracks its noise variance.
    phi : (n,) or (T, n) array
    level : float, default 0.95
        Share of measurements that the interval holds, between 0 and 1.
    errors : (T,) array, optional
        One-step errors of the estimator so far, such as ``run.error``; a bank needs them. The mean
        square of the last hundred is then the variance of the next, wherever phi is; NaN is left
        out.

    Returns
    -------
    Prediction
        Of floats, or of (T,) arrays. NaN for the interval before there is a noise variance.

    Raises
    ------
    InvalidInput
        For a level out of range, several targets or rows, an RLS without monitor and errors, or a
        bank without errors: P of its mixture holds what members say that are hardly believed, and
        with it an interval of 95 % would hold about 92.

    Notes
    -----
    Without errors the half-width is t √(σ² (1 + φ P̄ φᵀ)): σ² the noise variance, weighted as the
    rule forgets, t the quantile of Student's t for the samples behind it, and P̄ the covariance
    after forgetting for this sample. It is right for normal noise of one size (a measurement with
    gamma = 1) and for parameters that drift as the rule supposes. `Intervals` suppose neither.

    Examples
    --------
    >>> import numpy as np
    >>> import forgetting as fg
    >>> rng = np.random.default_rng(0)
    >>> phi = np.column_stack([np.ones(500), rng.normal(size=500)])
    >>> y = phi @ [1.0, 2.0] + 0.1 * rng.normal(size=500)
    >>> estimator = fg.RLS(2, monitor=True)
    >>> run = estimator.run(phi, y)
    >>> there = fg.predict(estimator, [1.0, 3.0], level=0.95)
    >>> round(there.value), round(there.upper - there.lower, 1)
    (7, 0.5)
    """
    check_level(level)
    if estimator.targets != 1:
        raise InvalidInput(
            f"the estimator has {estimator.targets} targets; an interval is told of one, as the "
            "noise of each is not tracked"
        )
    if estimator.rows != 1:
        raise InvalidInput(f"the estimator has {estimator.rows} rows; an interval is told of one")
    value = estimator.predict(phi)
    if errors is not None:
        return around(value, root_mean_square(errors) * np.ones(np.shape(value)), quantile(level))
    if isinstance(estimator, Bank):
        raise InvalidInput("errors is None; a bank needs its one-step errors for an interval")
    watched = estimator.watched()
    if watched is None:
        raise InvalidInput(
            "the estimator tracks no noise variance, which an interval needs; "
            "make it with monitor=True, or give its errors"
        )
    deviation = np.sqrt(watched["noise_variance"] * (1.0 + leverage(estimator, phi, value)))
    return around(value, deviation, quantile(level, watched["weight"]))


def around(value: Any, deviation: Any, z: float) -> Prediction:
    """A value with so many standard deviations on both sides.

    Examples
    --------
    >>> around(1.0, 0.5, 2.0)
    Prediction(value=1.0, lower=0.0, upper=2.0)
    """
    half_width = z * deviation
    lower, upper = value - half_width, value + half_width
    if np.ndim(value) == 0:
        return Prediction(value, float(lower), float(upper))
    return Prediction(value, lower, upper)


def leverage(estimator: RLS, phi: ArrayLike, value: Any) -> Any:
    """φ P̄ φᵀ of each sample, were it the next one: P̄ is P after forgetting for it.

    A copy of the estimator is given the sample, with the measurement that it predicts.
    """
    if np.ndim(phi) == 1:
        return copy(estimator).update(phi, value).leverage
    return np.array(
        [leverage(estimator, *each) for each in zip(np.asarray(phi), value, strict=True)]
    )


def root_mean_square(errors: ArrayLike) -> float:
    """Of the last hundred errors; NaN where there are none."""
    given = np.asarray(errors, dtype=np.float64)
    if given.ndim != 1 or np.isinf(given).any():
        raise InvalidInput(f"errors has shape {given.shape}, allowed: (T,), finite or NaN")
    known = given[~np.isnan(given)][-RECENT:]
    return float(np.sqrt(np.mean(known**2))) if len(known) else float("nan")


def check_level(level: float) -> None:
    """Refuse a share that no interval can hold."""
    if not 0.0 < level < 1.0:
        raise InvalidInput(f"level = {level}, allowed: between 0 and 1")


def quantile(level: float, freedom: float = np.inf) -> float:
    """How many standard deviations on both sides hold so much, of Student's t with this freedom.

    By the expansion about the normal quantile (Abramowitz and Stegun 1964, 26.7.5), which is within
    1 % from five degrees of freedom on for levels up to 0.95.

    Examples
    --------
    >>> round(quantile(0.95), 2), round(quantile(0.95, 10.0), 2)
    (1.96, 2.23)
    """
    check_level(level)
    z = NormalDist().inv_cdf(0.5 + level / 2)
    if not freedom > 0:
        return float("nan")
    first = (z**3 + z) / 4
    second = (5 * z**5 + 16 * z**3 + 3 * z) / 96
    return z + first / freedom + second / freedom**2
