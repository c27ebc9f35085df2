"""A model as one text: its structure and its orders, as in ``armax:na=2,nb=2,nc=1,nk=1``."""

from __future__ import annotations

import re
from typing import Any

from forgetting._core import structures
from forgetting.models.ar import AR
from forgetting.models.arma import ARMA
from forgetting.models.armax import ARMAX
from forgetting.models.arx import ARX
from forgetting.models.bj import BJ
from forgetting.models.fir import FIR
from forgetting.models.oe import OE
from forgetting.models.polynomial import Polynomial
from forgetting.words.errors import RecordError

CLASSES: dict[str, type[Any]] = {
    made.__name__.lower(): made for made in (FIR, AR, ARX, ARMA, ARMAX, OE, BJ)
}
"""The class of each structure of the registry."""

ORDER = re.compile(r"^(?P<name>n[abcdfk])=(?P<values>\d+(/\d+)*)$")


def parse(text: str) -> tuple[str, dict[str, Any]]:
    """Read a structure and its orders.

    Examples
    --------
    >>> parse("armax:na=2,nb=2,nc=1,nk=1")
    ('armax', {'na': 2, 'nb': 2, 'nc': 1, 'nk': 1})
    >>> parse("oe:nb=2/1,nf=2/0,nk=1")
    ('oe', {'nb': [2, 1], 'nf': [2, 0], 'nk': 1})
    """
    name, _, orders = text.partition(":")
    name = name.strip().lower()
    if name not in CLASSES:
        raise RecordError(f"the model {name!r} is not known; there are: {', '.join(CLASSES)}")
    allowed, found = structures()[name][1], {}
    for part in filter(None, (part.strip() for part in orders.split(","))):
        match = ORDER.match(part)
        if match is None:
            raise RecordError(
                f"{part!r} is not an order; write {example(name)}, "
                "with nb=2/1 for inputs of different orders"
            )
        if match["name"] not in allowed:
            raise RecordError(f"a model {name} has no {match['name']}; it has {', '.join(allowed)}")
        values = [int(value) for value in match["values"].split("/")]
        found[match["name"]] = values[0] if len(values) == 1 else values
    return name, found


def example(name: str) -> str:
    """How a model of this structure is written.

    Examples
    --------
    >>> example("oe")
    'oe:nb=1,nf=1,nk=1'
    """
    return f"{name}:" + ",".join(f"{order}=1" for order in structures()[name][1])


def linear(model: str) -> list[int] | None:
    """The orders na, nb, nk of a model that is linear in its parameters; None for another.

    Examples
    --------
    >>> linear("fir:nb=3"), linear("arx:na=2,nb=1,nk=1"), linear("oe:nb=1,nf=1,nk=1")
    ([0, 3, 0], [2, 1, 1], None)
    """
    name, orders = parse(model)
    made = CLASSES[name](**orders)
    if isinstance(made, Polynomial):
        return None
    if not all(isinstance(order, int) for order in (made.nb, made.nk)):
        raise RecordError(f"a model {name} has the same orders for all inputs here, as in nb=2")
    return [made.na, made.nb, made.nk]
