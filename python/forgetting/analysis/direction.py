"""A direction in parameter space, in words."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from .validation import Array, numbers, refuse


def describe_direction(
    direction: ArrayLike, names: Sequence[str] | None = None, least: float = 0.1
) -> str:
    """Write a direction as a combination of the parameters in it.

    Parameters
    ----------
    direction : (n,)
        Any length, any sign.
    names : sequence of n str, optional
        Default: theta[0], theta[1], ...
    least : float
        Parameters with a smaller share of the unit vector are left out.

    Examples
    --------
    >>> describe_direction([1.0, -1.0, 0.001], ["a1", "b0", "b1"])
    '0.71 a1 - 0.71 b0'
    >>> describe_direction([0.0, 2.0])
    'theta[1]'
    """
    values = numbers("direction", direction)
    labels = [f"theta[{i}]" for i in range(values.size)] if names is None else list(names)
    if len(labels) != values.size:
        raise refuse("names", labels, f"{values.size} names")
    length = float(np.linalg.norm(values))
    if length == 0:
        return "no direction"
    unit = oriented(values[:, np.newaxis] / length)[:, 0]
    text = ""
    for share, label in zip(unit, labels, strict=True):
        if abs(share) >= least:
            size = "" if abs(share) > 0.995 else f"{abs(share):.2f} "
            sign = ("-" if share < 0 else "") if not text else (" - " if share < 0 else " + ")
            text += f"{sign}{size}{label}"
    return text


def oriented(directions: Array) -> Array:
    """Flip each column so that the first of its largest entries is positive.

    Entries within 1e-6 of the largest count as largest: rounding must not pick the sign.
    """
    size = np.abs(directions)
    first = (size >= (1 - 1e-6) * size.max(axis=0)).argmax(axis=0)
    lead = directions[first, np.arange(directions.shape[1])]
    return directions * np.where(lead < 0, -1.0, 1.0)
