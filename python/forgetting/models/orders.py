"""The orders of an ARX model, checked once."""

from __future__ import annotations

import operator
from dataclasses import dataclass
from typing import SupportsIndex

from forgetting._core import InvalidInput


@dataclass(frozen=True)
class Orders:
    """How far back an ARX model looks.

    Parameters
    ----------
    na : int
        Past outputs per output, >= 0.
    nb : int
        Inputs per input, >= 0; with `na` at least 1 in total.
    nk : int
        Delay of the newest input in samples, >= 0; 0 means that u(k) itself acts on y(k).

    Raises
    ------
    forgetting.InvalidInput
        When an order is not a whole number >= 0, or when na + nb is 0.

    Examples
    --------
    >>> Orders(1, 2, 0).reach
    1
    >>> Orders(2, 2, 3).reach
    4
    """

    na: int = 1
    nb: int = 2
    nk: int = 0

    def __post_init__(self) -> None:
        for name in ("na", "nb", "nk"):
            object.__setattr__(self, name, whole(name, getattr(self, name)))
        if self.na + self.nb == 0:
            raise InvalidInput("na and nb are both 0; an ARX model needs na + nb >= 1")

    @property
    def reach(self) -> int:
        """Rows that must come before a sample so that every lag exists."""
        oldest_input = self.nk + self.nb - 1 if self.nb else 0
        return max(self.na, oldest_input)

    def regressors(self, outputs: int, inputs: int) -> int:
        """Number of regressors, n = na·outputs + nb·inputs."""
        return self.na * outputs + self.nb * inputs


def whole(name: str, value: SupportsIndex) -> int:
    """Return `value` as an int >= 0 or say which parameter is wrong."""
    try:
        number = operator.index(value)
    except TypeError:
        number = -1
    if number < 0:
        raise InvalidInput(f"{name} is {value!r}; it must be a whole number >= 0")
    return number
