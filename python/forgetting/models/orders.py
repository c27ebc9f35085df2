"""The orders of an ARX model, checked once."""

from __future__ import annotations

import operator
import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, SupportsIndex

from forgetting._core import InvalidInput

Each = int | Sequence[int]
"""An order: the same for all inputs, or one for each."""
MOST = 100_000
"""The largest order, of whatever kind: P of so many parameters has 80 GB."""


@dataclass(frozen=True)
class Orders:
    """How far back an ARX model looks.

    Parameters
    ----------
    na : int
        Past outputs per output, from 0 to 100 000.
    nb : int or sequence of int
        Values of each input, from 0 to 100 000: the same for all inputs, or one for each; with
        `na` at least 1 in total.
    nk : int or sequence of int
        Delay of the newest value of each input in samples, from 0 to 100 000; 0 means that u(k)
        itself acts on y(k).

    Raises
    ------
    forgetting.InvalidInput
        When an order is not a whole number from 0 to 100 000, when na + nb is 0, when nb is 0 for
        each input, or when nb and nk are for different numbers of inputs.

    Examples
    --------
    >>> Orders(1, 2, 0).reach
    1
    >>> Orders(2, 2, 3).reach
    4
    >>> orders = Orders(1, [2, 1], [0, 1])
    >>> orders.input_lags(2), orders.reach, str(orders)
    ([(0, 0), (1, 0), (1, 1)], 1, '1,2/1,0/1')
    """

    na: int = 1
    nb: Each = 2
    nk: Each = 0

    def __post_init__(self) -> None:
        object.__setattr__(self, "na", an_order("na", self.na))
        for name in ("nb", "nk"):
            object.__setattr__(self, name, same_or_each(name, getattr(self, name)))
        if isinstance(self.nb, tuple) and not any(self.nb):
            raise InvalidInput("nb is 0 for all inputs; it must be at least 1 for one of them")
        if self.na == 0 and self.nb == 0:
            raise InvalidInput("na and nb are both 0; an ARX model needs na + nb >= 1")
        self.input_lags(self._inputs)  # says when nb and nk do not go together

    @classmethod
    def of(cls, orders: Sequence[Each]) -> Orders:
        """The orders na, nb, nk, in this order."""
        na, nb, nk = orders
        return cls(an_order("na", na), nb, nk)

    @property
    def reach(self) -> int:
        """Rows that must come before a sample so that every lag exists."""
        return max(self.na, *(lag for lag, _ in self.input_lags(self._inputs)), 0)

    @property
    def size(self) -> tuple[int, int]:
        """Coefficients, and the delay, of which the fewer are the simpler model."""
        return self.na + total(self.nb), total(self.nk)

    def input_lags(self, inputs: int) -> list[tuple[int, int]]:
        """Lag and input of each regressor that is an input, in their order: the newest first.

        Raises
        ------
        forgetting.InvalidInput
            When there are orders for another number of inputs.
        """
        nb, nk = per_input("nb", self.nb, inputs), per_input("nk", self.nk, inputs)
        each = enumerate(zip(nb, nk, strict=True))
        return sorted((k + lag, u) for u, (b, k) in each for lag in range(b))

    def regressors(self, outputs: int, inputs: int) -> int:
        """Number of regressors, n = na·outputs + nb·inputs, or the sum of nb over inputs."""
        return self.na * outputs + len(self.input_lags(inputs))

    @property
    def _inputs(self) -> int:
        """Inputs that there are orders for; 1 where they are the same for all."""
        return next((len(each) for each in (self.nb, self.nk) if isinstance(each, tuple)), 1)

    def __str__(self) -> str:
        return ",".join(map(in_text, (self.na, self.nb, self.nk)))


def same_or_each(
    name: str, value: SupportsIndex | Sequence[SupportsIndex]
) -> int | tuple[int, ...]:
    """Return an order for all inputs, or those of each, checked."""
    if isinstance(value, Sequence):
        return tuple(per_input(name, value, len(value)))
    return an_order(name, value)


def total(order: Each) -> int:
    """The sum over inputs; an order that is the same for all counts once."""
    return order if isinstance(order, int) else sum(order)


def in_text(order: Each) -> str:
    """An order as it is written.

    Examples
    --------
    >>> in_text(2), in_text((2, 1))
    ('2', '2/1')
    """
    return str(order) if isinstance(order, int) else "/".join(map(str, order))


def from_text(text: str) -> int | tuple[int, ...] | None:
    """An order that is written as a number, or as one for each input; None for anything else.

    Examples
    --------
    >>> from_text("2"), from_text("2/1"), from_text("2/")
    (2, (2, 1), None)
    """
    if re.fullmatch(r"\d+(/\d+)*", text, re.ASCII) is None:
        return None
    values = tuple(map(int, text.split("/")))
    return values[0] if len(values) == 1 else values


def per_input(name: str, value: SupportsIndex | Sequence[SupportsIndex], inputs: int) -> list[int]:
    """Return an order for each input: the same for all if one number was given.

    Examples
    --------
    >>> per_input("nb", 2, 3), per_input("nk", [0, 1], 2)
    ([2, 2, 2], [0, 1])
    """
    if not isinstance(value, Sequence):
        return [an_order(name, value)] * inputs
    if len(value) != inputs:
        raise InvalidInput(f"{name} has {len(value)} orders for {inputs} input(s)")
    return [an_order(f"{name}[{i}]", order) for i, order in enumerate(value)]


def an_order(name: str, value: Any) -> int:
    """Return an order as an int from 0 to `MOST` or say which one is wrong."""
    number = whole(name, value)
    if number > MOST:
        raise InvalidInput(f"{name} is {number}; it must be a whole number from 0 to {MOST}")
    return number


def whole(name: str, value: Any) -> int:
    """Return `value` as an int >= 0 or say which parameter is wrong."""
    try:
        number = operator.index(value)
    except TypeError:
        number = -1
    if number < 0:
        raise InvalidInput(f"{name} is {value!r}; it must be a whole number >= 0")
    return number
