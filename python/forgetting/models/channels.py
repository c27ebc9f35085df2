"""Inputs and outputs as (T, channels) arrays, checked with the caller's words."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from forgetting._core import InvalidInput, numbers

Array = NDArray[np.float64]


def channels(name: str, values: ArrayLike) -> Array:
    """Return (T,) or (T, c) as (T, c) float64; NaN and a mask mean missing, Inf is refused."""
    if isinstance(values, np.ma.MaskedArray):
        array = np.ma.masked_array(numbers(name, values.data), values.mask).filled(np.nan)
    else:
        array = numbers(name, values)
    if array.ndim == 1:
        array = array[:, None]
    if array.ndim != 2:
        raise InvalidInput(f"{name} has shape {array.shape}; it must be (T,) or (T, channels)")
    if np.isinf(array).any():
        row = int(np.argwhere(np.isinf(array))[0][0])
        raise InvalidInput(f"{name} is infinite in row {row}; it must be finite, or NaN")
    return array


def paired(u: ArrayLike | None, y: ArrayLike) -> tuple[Array, Array]:
    """Return u and y with equally many rows; no input at all is u of shape (T, 0)."""
    outputs = channels("y", y)
    inputs = np.empty((len(outputs), 0)) if u is None else channels("u", u)
    if len(inputs) != len(outputs):
        raise InvalidInput(f"u has {len(inputs)} rows and y has {len(outputs)}; they must match")
    return inputs, outputs
