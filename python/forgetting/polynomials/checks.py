"""Single numbers as arguments: every refusal names the parameter, its value and the range."""

from __future__ import annotations

import operator
from typing import Any

from forgetting._core import InvalidInput


def whole(name: str, value: Any, low: int = 0) -> int:
    """Return `value` as an int >= `low`.

    Examples
    --------
    >>> whole("na", 1.5)
    Traceback (most recent call last):
    ...
    forgetting.InvalidInput: na = 1.5, allowed: a whole number >= 0
    """
    try:
        number = operator.index(value)
    except TypeError:
        number = low - 1
    if number < low:
        raise InvalidInput(f"{name} = {value!r}, allowed: a whole number >= {low}")
    return number


def real(name: str, value: Any, low: float, high: float, *, closed: bool = False) -> float:
    """Return `value` as a float in (low, high), or in [low, high) if `closed`.

    Examples
    --------
    >>> real("level", 2, 0, 1)
    Traceback (most recent call last):
    ...
    forgetting.InvalidInput: level = 2, allowed: a number in (0, 1)
    """
    try:
        number = float(value)
    except (TypeError, ValueError):
        number = float("nan")
    if not (low < number < high or (closed and number == low)):
        bracket = "[" if closed else "("
        raise InvalidInput(f"{name} = {value!r}, allowed: a number in {bracket}{low:g}, {high:g})")
    return number
