"""Which orders and delays of a named structure are tried, such as ``armax:na=1-3,nb=1,nc=0-2``."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import product
from math import prod
from typing import Any

import numpy as np

from forgetting._core import InvalidInput, structures
from forgetting.models.named import NamedModel, Order, parts, value_of
from forgetting.models.orders import Orders, per_input
from forgetting.tuning.orders import MOST_MODELS, USUAL_NA, as_order, order_grid, widest

ModelOrders = Orders | NamedModel
"""Orders of an ARX model, or a structure with its orders."""

RANGE = re.compile(r"(\d{1,4})-(\d{1,4})")
USUAL: dict[str, tuple[int, ...]] = {
    "na": (1, 2, 3),
    "nb": (1, 2, 3),
    "nc": (1, 2),
    "nd": (1, 2),
    "nf": (1, 2),
    "nk": (0, 1, 2, 3),
}
"""What is tried of an order that is not named."""
FIXED: dict[str, dict[str, int]] = {"fir": {"na": 0}, "ar": {"nb": 0, "nk": 0}, "arx": {}}
"""Structures that are linear in their parameters, and the orders that ARX has beyond theirs."""


def models_of(text: str, inputs: int) -> list[Orders] | list[NamedModel]:
    """Every model that is meant by a structure and ranges of its orders.

    Raises
    ------
    InvalidInput
        Names the structure, the order or what is wrong with a range; for more than 300 models; or
        where orders do not go with the number of inputs.

    Examples
    --------
    >>> [str(model) for model in models_of("oe:nb=1-2,nf=1,nk=1", 1)]
    ['oe:nb=1,nf=1,nk=1', 'oe:nb=2,nf=1,nk=1']
    >>> models_of("fir:nb=2-3,nk=0", 1)
    [Orders(na=0, nb=2, nk=0), Orders(na=0, nb=3, nk=0)]
    """
    name, said = parts(text)
    ranges = {order: values_of(name, order, value) for order, value in said}
    if name in FIXED:
        return arx_grid(name, ranges, inputs)
    wanted = {order: ranges.get(order, USUAL[order]) for order in structures()[name][1]}
    count = prod(map(len, wanted.values()))
    if not 1 <= count <= MOST_MODELS:
        raise InvalidInput(f"{count} models are to be tried, allowed: 1 to {MOST_MODELS}")
    every = product(*([(order, each) for each in values] for order, values in wanted.items()))
    found = [made for made in (NamedModel(name, orders) for orders in every) if made.size[0]]
    if not found:
        raise InvalidInput(f"the model {text!r} has no coefficient; an order must be at least 1")
    for each in found:
        each.make().at_rest(inputs)  # says what does not go together
    return found


def arx_grid(name: str, ranges: dict[str, Sequence[Order]], inputs: int) -> list[Orders]:
    """The same for a model that is linear in its parameters, as ARX orders."""
    chosen: dict[str, Sequence[Any]] = {order: [value] for order, value in FIXED[name].items()}
    chosen |= ranges
    na = chosen.get("na", USUAL_NA)
    return order_grid(na, chosen.get("nb"), chosen.get("nk"), inputs)


def values_of(name: str, order: str, text: str) -> Sequence[Order]:
    """The values of an order that are tried: one, or a range.

    Examples
    --------
    >>> values_of("armax", "nb", "1-3"), values_of("armax", "nb", "2/1")
    ([1, 2, 3], [(2, 1)])
    """
    ends = RANGE.fullmatch(text)
    if ends is None:
        return [value_of(name, order, text)]
    first, last = int(ends[1]), int(ends[2])
    if first > last:
        raise InvalidInput(f"{order}={text} is no range; its first number must not be the larger")
    return list(range(first, last + 1))


def widest_of(models: Sequence[ModelOrders], inputs: int) -> ModelOrders:
    """A model whose lags hold those of all, which are of one structure."""
    named = [each for each in models if isinstance(each, NamedModel)]
    return widest_named(named, inputs) if named else widest(list(plain(models)), inputs)


def plain(models: Sequence[ModelOrders]) -> Iterator[Orders]:
    """Those that are orders of an ARX model."""
    return (each for each in models if isinstance(each, Orders))


def widest_named(models: Sequence[NamedModel], inputs: int) -> NamedModel:
    """The same for a structure that is not linear in its parameters.

    Examples
    --------
    >>> str(widest_of(models_of("oe:nb=1-2,nf=1-3,nk=1-4", 1), 1))
    'oe:nf=3,nb=5,nk=1'
    """
    each = [model.make() for model in models]
    wanted = structures()[models[0].name][1]
    found: dict[str, Order] = {
        order: max(getattr(made, order) for made in each)
        for order in wanted
        if order in ("na", "nc", "nd")
    }
    lags = {
        order: np.array([per_input(order, getattr(made, order), inputs) for made in each])
        for order in wanted
        if order in ("nb", "nf", "nk")
    }
    if "nf" in lags:
        found["nf"] = as_order(lags["nf"].max(axis=0))
    if "nb" in lags:
        newest = lags["nk"].min(axis=0)
        found["nb"] = as_order((lags["nb"] + lags["nk"]).max(axis=0) - newest)
        found["nk"] = as_order(newest)
    return NamedModel(models[0].name, tuple(found.items()))
