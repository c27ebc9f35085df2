"""The orders of an ARX model, checked once."""

from __future__ import annotations

import operator
from collections.abc import Sequence
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

    @property
    def size(self) -> tuple[int, int]:
        """Coefficients, and the delay, of which the fewer are the simpler model."""
        return self.na + self.nb, self.nk

    def input_lags(self, inputs: int) -> list[tuple[int, int]]:
        """Lag and input of each regressor that is an input, in their order: the newest first."""
        return [(lag, u) for lag in range(self.nk, self.nk + self.nb) for u in range(inputs)]

    def regressors(self, outputs: int, inputs: int) -> int:
        """Number of regressors, n = na·outputs + nb·inputs."""
        return self.na * outputs + self.nb * inputs


@dataclass(frozen=True)
class OrdersByInput:
    """Orders of an ARX model whose inputs have orders of their own.

    Parameters
    ----------
    na : int
        Past outputs per output, >= 0.
    nb, nk : sequence of int
        Values of each input, and the delay of its newest; at least one value in total.

    Examples
    --------
    >>> orders = OrdersByInput(1, [2, 1], [0, 1])
    >>> orders.input_lags(2), orders.reach
    ([(0, 0), (1, 0), (1, 1)], 1)
    """

    na: int
    nb: Sequence[int]
    nk: Sequence[int]

    def __post_init__(self) -> None:
        object.__setattr__(self, "na", whole("na", self.na))
        for name in ("nb", "nk"):
            orders = per_input(name, getattr(self, name), len(self.nb))
            object.__setattr__(self, name, tuple(orders))
        if not sum(self.nb):
            raise InvalidInput("nb is 0 for all inputs; it must be at least 1 for one of them")

    @property
    def reach(self) -> int:
        """Rows that must come before a sample so that every lag exists."""
        return max(self.na, *(lag for lag, _ in self.input_lags(len(self.nb))))

    def input_lags(self, inputs: int) -> list[tuple[int, int]]:
        """Lag and input of each regressor that is an input, in their order: the newest first."""
        nb, nk = per_input("nb", self.nb, inputs), per_input("nk", self.nk, inputs)
        each = enumerate(zip(nb, nk, strict=True))
        return sorted((k + lag, u) for u, (b, k) in each for lag in range(b))

    def regressors(self, outputs: int, inputs: int) -> int:
        """Number of regressors."""
        return self.na * outputs + len(self.input_lags(inputs))


def per_input(name: str, value: SupportsIndex | Sequence[SupportsIndex], inputs: int) -> list[int]:
    """Return an order for each input: the same for all if one number was given.

    Examples
    --------
    >>> per_input("nb", 2, 3), per_input("nk", [0, 1], 2)
    ([2, 2, 2], [0, 1])
    """
    if not isinstance(value, Sequence):
        return [whole(name, value)] * inputs
    if len(value) != inputs:
        raise InvalidInput(f"{name} has {len(value)} orders for {inputs} input(s)")
    return [whole(f"{name}[{i}]", order) for i, order in enumerate(value)]


def whole(name: str, value: SupportsIndex) -> int:
    """Return `value` as an int >= 0 or say which parameter is wrong."""
    try:
        number = operator.index(value)
    except TypeError:
        number = -1
    if number < 0:
        raise InvalidInput(f"{name} is {value!r}; it must be a whole number >= 0")
    return number
