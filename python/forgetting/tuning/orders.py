"""Which orders and delays of an ARX model are tried."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product
from math import prod

from forgetting._core import InvalidInput
from forgetting.models.orders import Orders

MOST_MODELS = 300
"""Models that one search may try."""
USUAL_NA, USUAL_NB, USUAL_NK = (1, 2, 3, 4), (1, 2, 3, 4), (0, 1, 2, 3)
"""What is tried when nothing is said."""


def order_grid(
    na: int | Sequence[int],
    nb: int | Sequence[int] | None,
    nk: int | Sequence[int] | None,
    inputs: int,
) -> list[Orders]:
    """Every combination of orders.

    Raises
    ------
    InvalidInput
        When there are none or too many, or they do not go with the number of inputs.
    """
    usual = (USUAL_NB, USUAL_NK) if inputs else ((0,), (0,))
    wanted = [
        listed(na),
        listed(usual[0] if nb is None else nb),
        listed(usual[1] if nk is None else nk),
    ]
    count = prod(len(each) for each in wanted)
    if not 1 <= count <= MOST_MODELS:
        raise InvalidInput(f"{count} models are to be tried, allowed: 1 to {MOST_MODELS}")
    found = [Orders(*each) for each in product(*wanted) if each[0] + each[1]]
    if not found or any((each.nb > 0) != (inputs > 0) for each in found):
        raise InvalidInput(
            f"nb = {wanted[1]} with {inputs} inputs; nb is 0 where there is no input"
        )
    return found


def listed(values: int | Sequence[int]) -> list[int]:
    """One number or several, each once."""
    return [values] if isinstance(values, int) else list(dict.fromkeys(values))


def widest(models: Sequence[Orders]) -> Orders:
    """Orders whose lags hold those of all models."""
    oldest = max(each.nk + each.nb for each in models)
    newest = min(each.nk for each in models)
    nb = oldest - newest if any(each.nb for each in models) else 0
    return Orders(max(each.na for each in models), nb, newest)
