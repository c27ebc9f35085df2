"""Rules over a whole record, side by side: of each only what it is ranked by is kept."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

import forgetting as fg
from forgetting.record.moved import Moved, as_run
from forgetting.record.samples import Samples, pieces
from forgetting.record.trace import USED, in_rows
from forgetting.tuning.baseline import rms, typical
from forgetting.tuning.candidate import Candidate
from forgetting.tuning.runner import Trial
from forgetting.tuning.signals import Signals

Array = NDArray[np.float64]
Marks = NDArray[np.bool_]
Codes = NDArray[np.uint8]
Learn = Callable[[Any], Iterator[tuple[Array, Codes]]]
"""Runs a new estimator over all samples; errors (T', m) and why samples were left out, (T',)."""


@dataclass(frozen=True)
class Whole:
    """What a rule did on a whole record.

    Attributes
    ----------
    error : float
        One-step root mean square error on the samples scored; of several outputs the geometric
        mean.
    left_out : int
        Samples that were not used.
    eigenvalues : ndarray, shape (n,)
        Of P at the end, ascending; for regressors in units of their typical size, where P before
        the first sample was not given.
    refused : str
        Why it did not get through the record; empty if it did.
    """

    error: float
    left_out: int
    eigenvalues: Array
    refused: str = ""


def over_all(
    chosen: Sequence[Trial], samples: Samples, learn: Learn, scored: Marks
) -> Iterator[Whole]:
    """What each of the rules chosen does on all samples; scored are those marked, (T,)."""

    def run(trial: Trial) -> Whole:
        try:
            return over(trial.candidate, samples, learn, scored)
        except fg.NumericalRange as error:
            return Whole(float("inf"), 0, np.empty(0), str(error))

    with ThreadPoolExecutor(os.cpu_count() or 1) as pool:
        try:
            yield from pool.map(run, chosen)
        except BaseException:
            pool.shutdown(cancel_futures=True)
            raise


def over(candidate: Candidate, samples: Samples, learn: Learn, scored: Marks) -> Whole:
    """What one rule does.

    Raises
    ------
    forgetting.NumericalRange
        When it runs out of the range of numbers; the message names the row.
    """
    n, m = samples.phi.shape[1], samples.y.shape[1]
    estimator = candidate.estimator(n, m)
    errors, used, start = [], 0, 0
    for error, skipped in learn(estimator):
        errors.append(error[scored[start : start + len(error)]])
        used += int((skipped == USED).sum())
        start += len(error)
    units = np.ones(n) if estimator.units is None else estimator.units
    values = np.linalg.eigvalsh(np.asarray(estimator.covariance) * np.outer(units, units))
    return Whole(typical(rms(np.concatenate(errors))), len(scored) - used, values)


def by_regressors(samples: Moved) -> Learn:
    """How estimators learn of regressors, a piece of the record after the other."""

    def learn(estimator: Any) -> Iterator[tuple[Array, Codes]]:
        for part in pieces(len(samples)):
            phi, y = as_run(*samples.rows(part), estimator.dtype)
            try:
                found = estimator.run(phi, y, outputs=("error", "skipped"), missing="skip")
            except fg.NumericalRange as error:
                raise type(error)(in_rows(str(error), part.start)) from None
            yield np.asarray(found.error).reshape(len(y), -1), found.skipped

    return learn


def by_signals(signals: Signals) -> Learn:
    """How estimators learn of a model that makes their regressors as it goes."""

    def learn(estimator: Any) -> Iterator[tuple[Array, Codes]]:
        found = signals.learn(estimator, ("error", "skipped"))
        yield found["error"][:, None], found["skipped"].astype(np.uint8)

    return learn
