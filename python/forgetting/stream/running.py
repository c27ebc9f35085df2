"""Rows through an estimator that may refuse some: these are left out, and the others go on."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

import forgetting as fg
from forgetting.record.half_life import LastTime
from forgetting.stream.rows import Array, Flags

SAMPLE = re.compile(r"\bsample (\d+): ")


@dataclass(frozen=True)
class Brought:
    """What rows brought.

    Attributes
    ----------
    outputs : dict of str to ndarray
        Outputs of `run` by name, one entry per row.
    refused : ndarray of bool, shape (T,)
        Rows that the estimator cannot take without leaving the range of numbers; they count as
        missing.
    reason : str
        What it says of the first of them.
    """

    outputs: dict[str, NDArray[Any]]
    refused: Flags
    reason: str = ""


def run_all(
    estimator: Any,
    phi: Array,
    y: Array,
    names: tuple[str, ...],
    time: Array | None = None,
    last: LastTime | None = None,
    bounds: tuple[Array, Array] | None = None,
) -> Brought:
    """Run over (T, n) regressors and (T, m) outputs, NaN where something is missing.

    With the time of each row, (T,), and that of the last complete one before, forgetting counts
    time. The estimator keeps to `bounds`, (n,) each.

    Examples
    --------
    >>> est = fg.RLS(1)
    >>> run_all(est, np.array([[1.0], [1e200], [1.0]]), np.ones((3, 1)), ("error",)).refused
    array([False,  True, False])
    """
    dtype = np.dtype(estimator.dtype)
    # What float32 cannot hold becomes infinite, and is refused with the rest.
    with np.errstate(over="ignore"):
        phi = np.ascontiguousarray(phi, dtype=dtype)
        target = np.ascontiguousarray(y if y.shape[1] > 1 else y[:, 0], dtype=dtype)
    last = last or LastTime()
    run_of = estimator.run if bounds is None else partial(estimator.run, bounds=bounds)
    when = None if time is None else last.ahead_of(time)
    try:
        run = run_of(phi, target, outputs=names, missing="skip", time=when)
    except (fg.NumericalRange, fg.InvalidInput):
        return run_some(run_of, phi, target, names, time, last)
    if time is not None:
        last.note(time, complete(phi, target))
    outputs = {name: getattr(run, name) for name in names}
    return Brought(outputs, np.zeros(len(phi), dtype=bool))


def run_some(
    run_of: Callable[..., Any],
    phi: Array,
    y: Array,
    names: tuple[str, ...],
    time: Array | None,
    last: LastTime,
) -> Brought:
    """The same, where some row is refused: piece by piece, without those."""
    infinite = np.isinf(np.column_stack([phi, y]))
    refused: Flags = np.asarray(infinite.any(axis=1))
    phi = np.where(refused[:, None], np.nan, phi)
    y = np.where(np.isinf(y), np.nan, y)
    reason = "a value is beyond the range of numbers" if refused.any() else ""
    pieces, at, size = [], 0, len(phi)
    while at < len(phi):
        stop = min(at + size, len(phi))
        try:
            part = slice(at, stop)
            when = None if time is None else last.ahead_of(time[part])
            run = run_of(phi[part], y[part], outputs=names, missing="skip", time=when)
        except fg.NumericalRange as error:
            place = SAMPLE.search(str(error))
            if place is None:
                raise
            wrong = at + int(place[1])
            refused[wrong], reason = True, reason or str(error)[place.end() :]
            phi[wrong], size = np.nan, wrong + 1 - at
            continue
        if time is not None:
            last.note(time[part], complete(phi[part], y[part]))
        pieces.append(run)
        at, size = stop, 2 * size
    outputs = {name: np.concatenate([getattr(run, name) for run in pieces]) for name in names}
    return Brought(outputs, refused, reason)


def complete(phi: Array, y: Array) -> Flags:
    """Rows without a missing value."""
    return np.asarray(~np.isnan(np.column_stack([phi, y])).any(axis=1))
