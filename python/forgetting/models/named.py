"""Models by a name and orders in one line, such as ``armax:na=2,nb=2,nc=1,nk=1``."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from forgetting._core import InvalidInput, structures
from forgetting.models.ar import AR
from forgetting.models.arma import ARMA
from forgetting.models.armax import ARMAX
from forgetting.models.arx import ARX
from forgetting.models.bj import BJ
from forgetting.models.fir import FIR
from forgetting.models.oe import OE
from forgetting.models.orders import Orders, from_text, in_text, total
from forgetting.models.polynomial import Polynomial

CLASSES: dict[str, type[Any]] = {
    each.__name__.lower(): each for each in (FIR, AR, ARX, ARMA, ARMAX, OE, BJ)
}
"""The class of each structure of the registry."""

ORDER = re.compile(r"(?P<name>n[abcdfk])=(?P<values>.+)")

OF_INPUTS = ("nb", "nf", "nk")
"""Orders that each input may have its own of."""

Order = int | tuple[int, ...]


@dataclass(frozen=True)
class NamedModel:
    """A structure and its orders.

    Attributes
    ----------
    name : str
        Of the structure, such as "armax"; see `CLASSES`.
    orders : tuple of (str, int or tuple of int)
        The orders that were said, each with its name; a tuple has one for each input. The others
        are those of the class.

    Examples
    --------
    >>> model = NamedModel.parse("oe:nb=2/1,nf=1,nk=1")
    >>> str(model), model.make(offset=True).nb
    ('oe:nb=2/1,nf=1,nk=1', [2, 1])
    """

    name: str
    orders: tuple[tuple[str, Order], ...] = ()

    @classmethod
    def parse(cls, text: str) -> NamedModel:
        """Read ``name:order=value,...``; ``nb=2/1`` has an order for each of two inputs.

        Raises
        ------
        forgetting.InvalidInput
            For a structure that does not exist, an order that it does not have, or no number.
        """
        if not isinstance(text, str):
            raise InvalidInput(f"model = {text!r}, allowed: a text such as 'arx:na=2,nb=2,nk=1'")
        name, orders = parts(text)
        return cls(name, tuple((order, value_of(name, order, said)) for order, said in orders))

    def make(self, **settings: Any) -> Any:
        """A new model of this structure and these orders, such as `forgetting.ARMAX`."""
        each = {name: list(v) if isinstance(v, tuple) else v for name, v in self.orders}
        return CLASSES[self.name](**each, **settings)

    @property
    def arx(self) -> Orders | None:
        """The orders of a model that is linear in its parameters; None for another.

        Examples
        --------
        >>> NamedModel.parse("fir:nb=3/1").arx, NamedModel.parse("oe").arx
        (Orders(na=0, nb=(3, 1), nk=0), None)
        """
        made = self.make()
        return None if isinstance(made, Polynomial) else Orders(made.na, made.nb, made.nk)

    @property
    def size(self) -> tuple[int, int]:
        """Coefficients, and the delay, of which the fewer are the simpler model.

        Examples
        --------
        >>> NamedModel.parse("armax:na=2,nb=2,nc=1,nk=3").size
        (5, 3)
        """
        made = self.make()
        each = (getattr(made, name, 0) for name in ("na", "nb", "nc", "nd", "nf"))
        return sum(map(total, each)), total(getattr(made, "nk", 0))

    def __str__(self) -> str:
        said = ",".join(f"{name}={in_text(value)}" for name, value in self.orders)
        return f"{self.name}:{said}" if said else self.name


def parts(text: str) -> tuple[str, list[tuple[str, str]]]:
    """The structure, and what is said of each of its orders.

    Raises
    ------
    forgetting.InvalidInput
        For a structure that does not exist, or an order that it does not have.

    Examples
    --------
    >>> parts("oe:nb=2/1,nf=1-3")
    ('oe', [('nb', '2/1'), ('nf', '1-3')])
    """
    name, _, orders = text.partition(":")
    name = name.strip().lower()
    if name not in CLASSES:
        raise InvalidInput(f"the model {name!r} is not known; there are: {', '.join(CLASSES)}")
    return name, list(said_of(name, orders))


def said_of(name: str, orders: str) -> Iterator[tuple[str, str]]:
    """Each order and the text of its value."""
    allowed, seen = structures()[name][1], set()
    for part in filter(None, (part.strip() for part in orders.split(","))):
        match = ORDER.fullmatch(part)
        if match is None:
            raise no_order(name, part)
        order = match["name"]
        if order not in allowed:
            raise InvalidInput(f"a model {name} has no {order}; it has {', '.join(allowed)}")
        if order in seen:
            raise InvalidInput(f"{order} is said twice in the model {name}; say each order once")
        seen.add(order)
        yield order, match["values"]


def value_of(name: str, order: str, text: str) -> Order:
    """A number, or one for each input."""
    value = from_text(text)
    if value is None:
        raise no_order(name, f"{order}={text}")
    if isinstance(value, tuple) and order not in OF_INPUTS:
        raise InvalidInput(
            f"{order}={text} in the model {name}; {order} is one number, and only "
            f"{', '.join(OF_INPUTS)} may be different for each input"
        )
    return value


def no_order(name: str, part: str) -> InvalidInput:
    """What is wrong with a part of the text that names no order."""
    return InvalidInput(
        f"{part!r} is not an order; write {example(name)}, "
        "with nb=2/1 for inputs of different orders"
    )


def example(name: str) -> str:
    """How a model of this structure is written.

    Examples
    --------
    >>> example("oe")
    'oe:nb=1,nf=1,nk=1'
    """
    return f"{name}:" + ",".join(f"{order}=1" for order in structures()[name][1])
