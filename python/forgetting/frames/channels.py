"""Inputs and outputs as (T, channels) arrays, checked with the caller's words."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from forgetting._core import InvalidInput, numbers
from forgetting.frames.table import Table, aligned, read

Array = NDArray[np.float64]


def channels(name: str, given: ArrayLike | Table) -> Array:
    """Return (T,) or (T, c) as (T, c) float64; NaN and a mask mean missing, Inf is refused."""
    values = read(name, given) or given
    if isinstance(values, Table):
        array = values.values
    elif isinstance(values, np.ma.MaskedArray):
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
    tables = {"u": read("u", u), "y": read("y", y)}
    aligned(**tables)
    outputs = channels("y", tables["y"] or y)
    inputs = np.empty((len(outputs), 0)) if u is None else channels("u", tables["u"] or u)
    if len(inputs) != len(outputs):
        raise InvalidInput(f"u has {len(inputs)} rows and y has {len(outputs)}; they must match")
    return inputs, outputs


def channel_names(letter: str, values: ArrayLike | None, count: int) -> list[str]:
    """What the channels are called: as the columns of a data frame, else u, or u1, u2, ...

    Examples
    --------
    >>> channel_names("y", np.zeros(3), 1), channel_names("u", np.zeros((3, 2)), 2)
    (['y'], ['u1', 'u2'])
    """
    table = read(letter, values)
    numbered = [letter] if count == 1 else [f"{letter}{k + 1}" for k in range(count)]
    return (
        [own or other for own, other in zip(table.names, numbered, strict=True)]
        if table
        else numbered
    )
