"""Which orders and delays of an ARX model are tried."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product
from math import prod
from typing import Any

import numpy as np
from numpy.typing import NDArray

from forgetting._core import InvalidInput
from forgetting.models.orders import Each, Orders, per_input

MOST_MODELS = 300
"""Models that one search may try."""
USUAL_NA, USUAL_NB, USUAL_NK = (1, 2, 3, 4), (1, 2, 3, 4), (0, 1, 2, 3)
"""What is tried when nothing is said."""


def order_grid(
    na: int | Sequence[int],
    nb: int | Sequence[Each] | None,
    nk: int | Sequence[Each] | None,
    inputs: int,
) -> list[Orders]:
    """Every combination of orders; one of them may be a tuple, with an order for each input.

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
    found = [Orders(na, nb, nk) for na, nb, nk in product(*wanted) if na or nb]
    if not found or any((each.nb != 0) != (inputs > 0) for each in found):
        raise InvalidInput(
            f"nb = {wanted[1]} with {inputs} inputs; nb is 0 where there is no input"
        )
    for each in found:
        each.input_lags(inputs)  # says when orders are for another number of inputs
    return found


def listed(values: int | Sequence[Each]) -> list[Any]:
    """One number or several, each once."""
    return [values] if isinstance(values, int) else list(dict.fromkeys(values))


def widest(models: Sequence[Orders], inputs: int) -> Orders:
    """Orders whose lags hold those of all models.

    Examples
    --------
    >>> str(widest([Orders(1, (2, 1), 0), Orders(2, (1, 1), (1, 3))], 2))
    '2,2/4,0'
    """
    na = max(each.na for each in models)
    if not any(each.nb for each in models):
        return Orders(na, 0, 0)
    nb = np.array([per_input("nb", each.nb, inputs) for each in models])
    nk = np.array([per_input("nk", each.nk, inputs) for each in models])
    newest = nk.min(axis=0)
    return Orders(na, as_order((nb + nk).max(axis=0) - newest), as_order(newest))


def as_order(each: NDArray[np.int64]) -> int | tuple[int, ...]:
    """One number where all inputs have the same, else one for each."""
    values = tuple(map(int, each))
    return values[0] if len(set(values)) == 1 else values
