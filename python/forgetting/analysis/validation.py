"""Argument checks: every refusal names the parameter, the value and the allowed range."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from forgetting._core import InvalidInput
from forgetting._core import numbers as numbers

Array = NDArray[np.float64]


def refuse(name: str, value: object, allowed: str) -> InvalidInput:
    """Return the error to raise for parameter `name`."""
    return InvalidInput(f"{name} = {value!s}, allowed: {allowed}")


def whole(name: str, value: int, low: int, high: int | None = None) -> int:
    """Return `value` as an int in [low, high]."""
    allowed = f"an integer in [{low}, {'...' if high is None else high}]"
    try:
        number = int(value)
    except (TypeError, ValueError) as error:
        raise refuse(name, value, allowed) from error
    if number != value or number < low or (high is not None and number > high):
        raise refuse(name, value, allowed)
    return number


def real(name: str, value: float, low: float, high: float, *, open_low: bool = False) -> float:
    """Return `value` as a float in [low, high], or in (low, high] with `open_low`."""
    allowed = f"a number in {'(' if open_low else '['}{low:g}, {high:g}]"
    try:
        number = float(value)
    except (TypeError, ValueError) as error:
        raise refuse(name, value, allowed) from error
    if not low <= number <= high or (open_low and number == low):
        raise refuse(name, value, allowed)
    return number


def regressors(value: ArrayLike) -> Array:
    """Return regressors as (T, rows, n); (T, n) means one row a sample."""
    array = numbers("regressors", value)
    if array.ndim == 2:
        array = array[:, np.newaxis, :]
    if array.ndim != 3 or min(array.shape) == 0:
        raise refuse("regressors", array.shape, "shape (T, n) or (T, rows, n), nothing empty")
    if np.isinf(array).any():
        raise refuse("regressors", "inf", "finite numbers, NaN for a missing sample")
    return array


def stack(name: str, value: ArrayLike, samples: int, parameters: int) -> Array:
    """Return `value` as a stack of `samples` square matrices."""
    array = numbers(name, value)
    if array.shape != (samples, parameters, parameters):
        raise refuse(name, array.shape, f"shape {(samples, parameters, parameters)}")
    return array


def positive_matrix(name: str, value: ArrayLike, parameters: int) -> Array:
    """Return a positive-definite matrix from a scalar, a diagonal or a full matrix."""
    array = numbers(name, value)
    if array.ndim == 0:
        array = float(array) * np.eye(parameters)
    elif array.shape == (parameters,):
        array = np.diag(array)
    allowed = f"a positive scalar, {parameters} of them, or a positive-definite matrix"
    if array.shape != (parameters, parameters):
        raise refuse(name, array.shape, allowed)
    try:
        np.linalg.cholesky(array)
    except np.linalg.LinAlgError as error:
        raise refuse(name, "not positive definite", allowed) from error
    return array


def present(run: Any, output: str) -> Any:
    """Return a named output of `run`, or say how to obtain it."""
    value = getattr(run, output, None)
    if value is None:
        raise refuse(f"run.{output}", None, f"a run made with outputs=(..., {output!r})")
    return value
