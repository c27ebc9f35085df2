"""Polynomials as given, checked, and back to parameters."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from forgetting._core import InvalidInput, numbers
from forgetting.polynomials.checks import real
from forgetting.polynomials.structure import SIGN, Structure

Array = NDArray[np.float64]


def parameters_of(
    A: ArrayLike, B: Any, C: ArrayLike, D: ArrayLike, F: Any, delay: Any, offset: float | None
) -> tuple[Structure, Array]:
    """The structure and theta of polynomials, as `PolynomialModel` takes them.

    Examples
    --------
    >>> structure, theta = parameters_of([1, -0.8], [0.5, 0.2], [1], [1], None, 1, None)
    >>> structure.names(), theta
    (('a1', 'b1', 'b2'), array([0.8, 0.5, 0.2]))
    """
    one = {name: monic(name, given) for name, given in (("A", A), ("C", C), ("D", D))}
    above = [row("B", each, least=0) for each in of_inputs("B", B)]
    below = [np.ones(1)] * len(above) if F is None else [monic("F", f) for f in of_inputs("F", F)]
    if len(below) != len(above):
        raise InvalidInput(f"F has {len(below)} polynomials, allowed: {len(above)}, as B")
    na, nc, nd = (len(one[name]) - 1 for name in "ACD")
    nb, nf = [len(b) for b in above], [len(f) - 1 for f in below]
    structure = Structure(na, nb, nc, nd, nf, delay, offset is not None)
    parts = [SIGN["a"] * one["A"][1:], *above, one["C"][1:], SIGN["d"] * one["D"][1:]]
    parts += [SIGN["f"] * f[1:] for f in below]
    if offset is not None:
        parts.append(np.array([real("offset", offset, -np.inf, np.inf)]))
    return structure, np.concatenate(parts)


def of_inputs(name: str, given: Any) -> Sequence[Any]:
    """The polynomials of all inputs; one row of numbers is that of one input."""
    try:
        rows = list(given)
    except TypeError:
        raise InvalidInput(f"{name} = {given!r}, allowed: one polynomial for each input") from None
    return [rows] if rows and all(np.ndim(each) == 0 for each in rows) else rows


def row(name: str, given: ArrayLike, least: int = 1) -> Array:
    """A polynomial: a row of finite numbers, at least so many."""
    made = numbers(name, given)
    if made.ndim != 1 or made.size < least or not np.isfinite(made).all():
        raise InvalidInput(f"{name} = {made.tolist()}, allowed: a row of finite coefficients")
    return np.array(made, dtype=np.float64)


def monic(name: str, given: ArrayLike) -> Array:
    """A polynomial that begins with 1."""
    made = row(name, given)
    if made[0] != 1.0:
        raise InvalidInput(f"{name} = {made.tolist()}, allowed: a polynomial that begins with 1")
    return made


def covariance_of(given: ArrayLike | None, parameters: int) -> Array:
    """A covariance of the parameters (n, n), checked; NaN where it is not known."""
    if given is None:
        return np.full((parameters, parameters), np.nan)
    made = np.array(numbers("covariance", given), dtype=np.float64)
    if made.shape != (parameters, parameters):
        raise InvalidInput(
            f"covariance has shape {made.shape}, allowed: {(parameters, parameters)}"
        )
    if np.isnan(made).all():
        return made
    if not np.isfinite(made).all() or (np.diagonal(made) < 0).any():
        raise InvalidInput("covariance is not finite, or has a variance below 0")
    if not np.allclose(made, made.T, rtol=1e-6, atol=1e-12 * np.abs(made).max()):
        raise InvalidInput("covariance is not symmetric")
    return (made + made.T) / 2


def labels(name: str, given: Any, default: Sequence[str]) -> tuple[str, ...]:
    """Names or units, one a channel."""
    made = tuple(default) if given is None else (given,) if isinstance(given, str) else tuple(given)
    if len(made) != len(default):
        raise InvalidInput(f"{name} has {len(made)} entries, allowed: {len(default)}")
    return tuple(str(each) for each in made)
