"""Run an estimator over samples and keep its history."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

import forgetting as fg
from forgetting.record.half_life import LastTime
from forgetting.record.moved import Moved, as_run
from forgetting.record.samples import pieces

Array = NDArray[np.float64]
Progress = Callable[[int, int], None]
Hold = Callable[[Array, Array, int], None]
"""Changes estimates (K, n, m), with P (K, n, n) after the same samples and the row of the first."""

CHUNKS = 1000
"""Pieces a record is run in; the eigenvalues of P are taken after each, so at most this often."""
CHEAP = 200_000_000
"""Cubes of parameters that all eigenvalues together may cost: about a second."""
FEWEST = 20
"""Pieces however many parameters there are."""
AT_ONCE = 10
"""Parameters up to which a run over many samples is bit for bit that over one after the other."""
ROOM = 4_000_000
"""Numbers that P of all samples of a piece may be, where it is needed."""

CODES = {reason: code for code, reason in fg.SKIPPED.items()}
USED, DEAD_ZONE, MISSING = CODES[None], CODES["dead_zone"], CODES["missing"]
WITHIN_BOUND, HELD = CODES["within_bound"], CODES["gate"]
FROZEN = {word: code for code, word in fg.GATE.items()}["freeze"]
HISTORY = (
    "theta",
    "error",
    "forgetting_factor",
    "leverage",
    "skipped",
    "gate",
    "windup",
    "variance",
)


@dataclass(frozen=True)
class Trace:
    """History of one run over T samples with n regressors and m outputs.

    Attributes
    ----------
    theta : ndarray, shape (T, n, m)
        Estimate after each sample.
    error : ndarray, shape (T, m)
        One-step error y - phi theta, theta from before the sample; NaN where missing.
    forgetting_factor, leverage : ndarray, shape (T,)
        Rate of each sample, and phi P phi' with P after forgetting and before measuring.
    skipped : ndarray of uint8, shape (T,)
        0 where the sample was used, else the code of the reason, see `forgetting.SKIPPED`.
    gate : ndarray of uint8, shape (T,)
        Code of the gate's answer, see `forgetting.GATE`.
    windup : ndarray of bool, shape (T,)
        Whether the monitor reported windup.
    variance : ndarray, shape (T, n)
        Diagonal of P after each sample.
    rows : ndarray of int, shape (K,)
        Rows after which the eigenvalues were taken.
    eigenvalues : ndarray, shape (K, n)
        Eigenvalues of P, ascending; for regressors in units of their typical size, as known at the
        end, where P before the first sample was not given.
    covariances : ndarray, shape (K, n, n)
        P after these rows.
    memory : ndarray, shape (T,), or None
        Of a bank: over how many samples it remembers.
    weights : ndarray, shape (members,), or None
        Of a bank: how far each member is believed at the end.
    weights_path : ndarray, shape (K, members), or None
        Of a bank: the weights, on average over each piece of the record that ends with one of
        `rows`.
    covariance : ndarray, shape (n, n)
        P after the last sample.
    trust : ndarray, shape (T,), or None
        Of a model with coloured noise: what each sample counts, in (0, 1], less at the start; 1 if
        not given.
    """

    theta: Array
    error: Array
    forgetting_factor: Array
    leverage: Array
    skipped: NDArray[np.uint8]
    gate: NDArray[np.uint8]
    windup: NDArray[np.bool_]
    variance: Array
    rows: NDArray[np.int64]
    eigenvalues: Array
    covariances: Array
    covariance: Array
    memory: Array | None = None
    weights: Array | None = None
    weights_path: Array | None = None
    trust: Array | None = None


def run(
    estimator: Any,
    samples: Moved,
    progress: Progress | None = None,
    time: Array | None = None,
    hold: Hold | None = None,
    bounds: tuple[Array, Array] | None = None,
) -> Trace:
    """Run `estimator` over all samples in chunks; chunking changes no bit of the result.

    With the ``time`` of each, (T,), forgetting counts time in place of samples. `hold` keeps the
    estimates that are told within bounds; the estimator itself keeps to `bounds`, (n,) each.
    """
    total, n = len(samples), samples.parameters
    last = LastTime()
    history = History(total, n, samples.targets, isinstance(estimator, fg.Bank))
    parts = chunks(total, n, ROOM // n**2 if hold else total)
    at_once = len(parts) == total and n <= AT_ONCE and hold is None
    if at_once:  # a piece for every row: one call, and P after each from it
        parts = [(0, total)]
    wanted = (*history.outputs, "covariance") if hold or at_once else history.outputs
    more: dict[str, Any] = {} if bounds is None else {"bounds": bounds}
    rows: list[int] = []
    covariances: list[NDArray[Any]] = []
    for start, stop in parts:
        part = slice(start, stop)
        try:
            phi, y = as_run(*samples.rows(part), estimator.dtype)
            when = None if time is None else last.ahead_of(time[part])
            piece = estimator.run(phi, y, outputs=wanted, missing="skip", time=when, **more)
        except (fg.InvalidInput, fg.NumericalRange) as error:
            raise type(error)(in_rows(str(error), start)) from None
        if time is not None:
            last.note(time[part], samples.complete[part])
        history.put(start, stop, piece, at_once)
        if hold is not None:
            hold(history.arrays["theta"][start:stop], piece.covariance, start)
        rows += range(stop) if at_once else [stop - 1]
        covariances += list(piece.covariance) if at_once else [estimator.covariance]
        if progress is not None:
            progress(stop, total)
    # all in the units of the end: those of before would show as steps
    units = np.ones(n) if estimator.units is None else estimator.units
    path: NDArray[Any] = np.array(covariances, dtype=np.float64)
    return Trace(
        **history.arrays,
        weights=np.asarray(estimator.weights) if isinstance(estimator, fg.Bank) else None,
        weights_path=np.array(history.weights) if history.bank else None,
        rows=np.array(rows),
        eigenvalues=np.linalg.eigvalsh(path * np.outer(units, units)),
        covariances=path,
        covariance=path[-1],
    )


class History:
    """What a run keeps of every sample, filled piece by piece: nothing is there twice."""

    def __init__(self, total: int, n: int, outputs: int, bank: bool) -> None:
        shapes = {"theta": (total, n, outputs), "error": (total, outputs), "variance": (total, n)}
        kinds: dict[str, Any] = {"skipped": np.uint8, "gate": np.uint8, "windup": np.bool_}
        self.bank = bank
        self.names = (*HISTORY, "memory") if bank else HISTORY
        self.weights: list[Array] = []
        self.arrays: dict[str, Any] = {
            name: np.empty(shapes.get(name, (total,)), dtype=kinds.get(name, np.float64))
            for name in self.names
        }

    @property
    def outputs(self) -> tuple[str, ...]:
        """What a run is asked for."""
        return (*self.names, "weights") if self.bank else self.names

    def put(self, start: int, stop: int, piece: Any, at_once: bool = False) -> None:
        """Put what a piece of the run kept in its place; `at_once`, each row is a piece."""
        if self.bank:
            weights = np.asarray(piece.weights, dtype=np.float64)
            self.weights += list(weights) if at_once else [weights.mean(axis=0)]
        for name in self.names:
            place = self.arrays[name][start:stop]
            place[...] = getattr(piece, name).reshape(place.shape)


def in_rows(message: str, start: int) -> str:
    """Turn "sample 3" of a piece that begins after `start` rows into a row of the record."""
    return re.sub(
        r"\bsample (\d+)", lambda found: f"row {start + int(found[1]) + 1}", message, count=1
    )


def chunks(total: int, parameters: int, longest: int | None = None) -> list[tuple[int, int]]:
    """Cut `total` rows into pieces of equal length, fewer where eigenvalues are dear.

    None is longer than `longest`.

    Examples
    --------
    >>> len(chunks(2000, 4)), len(chunks(2000, 400)), len(chunks(2000, 400, longest=50))
    (1000, 20, 40)
    """
    most = min(CHUNKS, max(CHEAP // parameters**3, FEWEST))
    length = max(1, min(math.ceil(total / most), total if longest is None else longest))
    return [(start, min(start + length, total)) for start in range(0, total, length)]


def errors_without_forgetting(
    samples: Moved, settings: dict[str, Any], teach: Callable[[Any], None] | None = None
) -> Array:
    """One-step errors (T, m) of the same model with the rule that never forgets.

    `teach` tells the estimator what is known before the first sample.
    """
    estimator = fg.RLS(samples.parameters, rule=fg.rule("none"), **settings)
    if teach is not None:
        teach(estimator)
    return errors_of(estimator, samples)


def errors_of(estimator: Any, samples: Moved, time: Array | None = None) -> Array:
    """One-step errors (T, m) of an estimator over all samples; `time` (T,) if it counts."""
    errors, last = np.empty((len(samples), samples.targets)), LastTime()
    for part in pieces(len(samples)):
        phi, y = as_run(*samples.rows(part), estimator.dtype)
        when = None if time is None else last.ahead_of(time[part])
        found = estimator.run(phi, y, outputs=("error",), missing="skip", time=when)
        errors[part] = np.asarray(found.error).reshape(len(y), -1)
        if time is not None:
            last.note(time[part], samples.complete[part])
    return errors
