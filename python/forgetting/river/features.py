"""Features by names, in columns that are given out as names come."""

from __future__ import annotations

import math
from collections.abc import Hashable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from forgetting._core import InvalidInput

Columns = dict[Hashable, int]


def with_new(columns: Columns, x: Mapping[Hashable, Any]) -> Columns:
    """The columns with one more for each name of `x` that has none.

    New names of one sample come in the order of their text, so that the order in a dictionary
    changes nothing.

    Examples
    --------
    >>> with_new({"b": 0}, {"d": 1.0, "c": 2.0, "b": 3.0})
    {'b': 0, 'c': 1, 'd': 2}
    """
    new = [name for name in x if name not in columns]
    if not new:
        return columns
    return {**columns, **{name: len(columns) + k for k, name in enumerate(sorted(new, key=repr))}}


def row(x: Mapping[Hashable, Any], columns: Columns, width: int) -> NDArray[np.float64]:
    """The features of one sample as (width,) numbers; a name that is absent is 0.

    Names that have no column are left out.

    Raises
    ------
    InvalidInput
        For a value that is no finite number; it names the feature.
    """
    values = np.zeros(width)
    for name, value in x.items():
        number = finite(f"x[{name!r}]", value)
        if name in columns:
            values[columns[name]] = number
    return values


def finite(name: str, value: Any) -> float:
    """`value` as a finite number, or a sentence that says whose it is."""
    try:
        number = float(value) if not isinstance(value, str | bytes) else math.nan
    except (TypeError, ValueError):
        number = math.nan
    if not math.isfinite(number):
        raise InvalidInput(f"{name} = {value!r}, allowed: finite numbers")
    return number
