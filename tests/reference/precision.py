"""The rounding unit that definitions with a rank or a cluster tolerance refer to.

The arithmetic here is exact by comparison; this is the epsilon of the numbers under test.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from .linalg import Real

_epsilon = [2.0**-52]


@contextmanager
def working(epsilon: float) -> Iterator[None]:
    """Inside: the tolerances of a package that computes with this epsilon."""
    _epsilon.append(epsilon)
    try:
        yield
    finally:
        _epsilon.pop()


def epsilon() -> Real:
    return Real(_epsilon[-1])


def tolerance() -> Real:
    """tau = sqrt(epsilon): 2^-26 in double, 2^-11.5 in single precision."""
    return epsilon().sqrt()
