"""Free runs, predictions and innovations of a model on data.

Inputs with an F of their own are filtered first, v = Σ B_i/F_i u_i. The rest is one difference
equation,

    D A y = C e + r,   r = D v + Σ D B_i u_i + D offset,

with the second sum over the inputs without F. It gives the innovation e where y is known, and y
with e = 0 where it is not. Its state, kept as that of `scipy.signal.lfilter` (transposed direct
form), is the same for both, so a gap in y only changes which signal is solved for. The best
prediction of y(k) from y(k-h), y(k-h-1), ... is

    y(k) - e(k) - h_1 e(k-1) - ... - h_(h-1) e(k-h+1),   C/(D A) = 1 + h_1 q⁻¹ + ...

The states at the first sample are unknown. The innovations are linear in them, so least squares
finds them from the first samples, as many as their influence lasts.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any

import numpy as np

from forgetting._core import InvalidInput
from forgetting.extras import extra
from forgetting.polynomials.estimate import Array

FADED = 1e-12
"""Share of an initial state of which nothing is left worth knowing."""


@dataclass(frozen=True, eq=False)
class System:
    """The filters of a model, in powers of q⁻¹.

    Attributes
    ----------
    filters : dict of int to (B, F)
        By the number of the input, of those with an F of their own.
    direct : dict of int to D B
        Of the other inputs.
    DA, C : ndarray
        As long as one another, and as any D B.
    D : ndarray
    offset : float
    """

    filters: dict[int, tuple[Array, Array]]
    direct: dict[int, Array]
    DA: Array
    C: Array
    D: Array
    offset: float

    @classmethod
    def of(cls, model: Any, *, noise: bool = True) -> System:
        """The filters of a model; without noise C = D = 1."""
        C, D = (model.C, model.D) if noise else (np.ones(1), np.ones(1))
        pairs = dict(enumerate(zip(model.B, model.F, strict=True)))
        filters = {i: pair for i, pair in pairs.items() if len(pair[1]) > 1}
        direct = {i: np.convolve(D, b) for i, (b, f) in pairs.items() if len(f) == 1}
        DA = np.convolve(D, model.A)
        length = max(len(DA), len(C), *(len(each) for each in direct.values()), 1)
        DA, C = padded(DA, length), padded(C, length)
        return cls(filters, direct, DA, C, D, model.offset or 0.0)

    @property
    def orders(self) -> list[int]:
        """Lengths of the states: of each filter of an input, then of the equation of y."""
        return [*(max(len(b), len(f)) - 1 for b, f in self.filters.values()), len(self.C) - 1]

    @property
    def order(self) -> int:
        """Length n of all states together."""
        return sum(self.orders)

    def split(self, state: Array) -> list[Array]:
        """The states (n, c) of all filters, apart."""
        return np.split(state, np.cumsum(self.orders)[:-1])


def padded(polynomial: Array, length: int) -> Array:
    """The polynomial with zeros behind it."""
    return np.pad(polynomial, (0, length - len(polynomial)))


def brought(system: System, u: Array, state: Array) -> Array:
    """What inputs and offset bring, r, (T, c): they act in the first of c columns."""
    lfilter = extra("scipy.signal", "a prediction").lfilter
    v = np.zeros((len(u), state.shape[1]))
    states = system.split(state)
    for (i, (b, f)), own in zip(system.filters.items(), states[:-1], strict=True):
        signal = np.zeros_like(v)
        signal[:, 0] = u[:, i]
        v += lfilter(b, f, signal, axis=0, zi=own)[0]
    r = lfilter(system.D, np.ones(1), v, axis=0)
    r[:, 0] += system.offset * system.D.sum()
    for i, b in system.direct.items():
        r[:, 0] += lfilter(b, np.ones(1), u[:, i])
    return np.asarray(r)


def innovations(system: System, u: Array, y: Array, state: Array) -> tuple[Array, Array]:
    """Outputs and innovations from initial states, (T, c) each.

    Parameters
    ----------
    system : System
    u : ndarray, shape (T, inputs)
    y : ndarray, shape (T,)
        NaN where missing: the innovation is then 0 and the output that of the model.
    state : ndarray, shape (n, c)
        Initial states; u and y act in the first column only.
    """
    lfilter = extra("scipy.signal", "a prediction").lfilter
    r, current = brought(system, u, state), system.split(state)[-1]
    outputs, errors = np.zeros_like(r), np.zeros_like(r)
    missing, one = np.isnan(y), np.eye(1, len(system.C))[0]
    outputs[:, 0] = np.where(missing, 0.0, y)
    cuts = np.flatnonzero(np.diff(missing)) + 1
    for start, stop in pairwise([0, *cuts.tolist(), len(y)]):
        part = slice(start, stop)
        if missing[start]:
            outputs[part], new = lfilter(one, system.DA, r[part], axis=0, zi=-current)
            current = -new
        else:
            known, new = lfilter(system.DA, system.C, outputs[part], axis=0, zi=current)
            expected, taken = lfilter(one, system.C, r[part], axis=0, zi=np.zeros_like(current))
            errors[part], current = known - expected, new - taken
    return outputs, errors


def initial_state(system: System, u: Array, y: Array) -> Array:
    """The state (n, 1) at the first sample that leaves the smallest squared innovations."""
    size = system.order
    rows = lasting(size, [system.C, *(f for _, f in system.filters.values())], y)
    start = np.hstack([np.zeros((size, 1)), np.eye(size)])
    _, errors = innovations(system, u[:rows], y[:rows], start)
    errors = errors[~np.isnan(y[:rows])]
    found = np.linalg.lstsq(errors[:, 1:], -errors[:, 0], rcond=None)[0]
    return np.asarray(found[:, None])


def lasting(order: int, polynomials: Sequence[Array], y: Array) -> int:
    """Rows over which an initial state matters, so that as many outputs are known in them.

    With a root outside the unit circle: over which its growth leaves other digits.
    """
    largest = max(largest_root(each) for each in polynomials)
    needed = len(y) if largest == 1.0 else order
    if largest not in (0.0, 1.0):
        needed += int(abs(np.log(FADED) / np.log(largest))) + 1
    known = np.cumsum(~np.isnan(y))
    return int(np.searchsorted(known, needed) + 1)


def predicted(model: Any, u: Array, y: Array, steps: int) -> Array:
    """The best prediction of every y(k) from the outputs up to y(k - steps), (T,)."""
    lfilter = extra("scipy.signal", "a prediction").lfilter
    system = checked(System.of(model))
    outputs, errors = innovations(system, u, y, initial_state(system, u, y))
    impulse = np.eye(1, min(steps, max(len(y), 1)))[0]
    unknown = lfilter(system.C, system.DA, impulse)
    return np.asarray(outputs[:, 0] - lfilter(unknown, np.ones(1), errors[:, 0]))


def residuals(model: Any, u: Array, y: Array) -> Array:
    """The one-step prediction errors, (T,); NaN where y is missing."""
    system = checked(System.of(model))
    _, errors = innovations(system, u, y, initial_state(system, u, y))
    return np.where(np.isnan(y), np.nan, errors[:, 0])


def checked(system: System) -> System:
    """Refuse a predictor that is not stable: its errors would grow without end."""
    for name, polynomial in [("C", system.C), *(("F", f) for _, f in system.filters.values())]:
        largest = largest_root(polynomial)
        if largest >= 1.0:
            raise InvalidInput(
                f"{name} has a root of modulus {largest:.6g}, allowed: below 1; "
                f"predictions with this model grow without bound"
            )
    return system


def largest_root(polynomial: Array) -> float:
    """The largest modulus of the roots in the z plane."""
    return float(np.abs(np.roots(polynomial)).max(initial=0.0))


def free_run(model: Any, u: Array, y_start: Array) -> Array:
    """The output without noise, (T,), from the state that the first outputs suggest, or at rest."""
    system = System.of(model, noise=False)
    missing = np.full(len(u), np.nan)
    if len(y_start):
        state = suggested_state(system, u, y_start)
        return np.asarray(innovations(system, u, missing, state)[0][:, 0])
    rest, level = np.zeros((system.order, 1)), at_rest(model)
    moving = replace(system, offset=0.0) if level else system
    return np.asarray(innovations(moving, u, missing, rest)[0][:, 0] + level)


def suggested_state(system: System, u: Array, y: Array) -> Array:
    """The state (n, 1) at the first sample from which a free run comes nearest to outputs."""
    size = system.order
    rows = lasting(size, [system.DA, *(f for _, f in system.filters.values())], y)
    start = np.hstack([np.zeros((size, 1)), np.eye(size)])
    y = y[:rows]
    outputs, _ = innovations(system, u[: len(y)], np.full(len(y), np.nan), start)
    known = ~np.isnan(y)
    found = np.linalg.lstsq(outputs[known, 1:], (y - outputs[:, 0])[known], rcond=None)[0]
    return np.asarray(found[:, None])


def at_rest(model: Any) -> float:
    """The output at rest without input, offset/A(1); 0 where there is no such level."""
    total = float(np.sum(model.A))
    return float((model.offset or 0.0) / total) if total != 0.0 else 0.0
