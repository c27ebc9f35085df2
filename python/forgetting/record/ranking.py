"""Rules over a whole record, side by side: of each only what it is ranked by is kept."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

import forgetting as fg
from forgetting.record.moved import Moved, as_run
from forgetting.record.samples import pieces
from forgetting.record.trace import USED, in_rows
from forgetting.tuning.baseline import rms, typical
from forgetting.tuning.candidate import Candidate
from forgetting.tuning.runner import Trial

Array = NDArray[np.float64]
Marks = NDArray[np.bool_]


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


def over_all(chosen: Sequence[Trial], samples: Moved, scored: Marks) -> Iterator[Whole]:
    """What each of the rules chosen does on all samples; scored are those marked, (T,)."""

    def run(trial: Trial) -> Whole:
        try:
            return over(trial.candidate, samples, scored)
        except fg.NumericalRange as error:
            return Whole(float("inf"), 0, np.empty(0), str(error))

    with ThreadPoolExecutor(os.cpu_count() or 1) as pool:
        try:
            yield from pool.map(run, chosen)
        except BaseException:
            pool.shutdown(cancel_futures=True)
            raise


def over(candidate: Candidate, samples: Moved, scored: Marks) -> Whole:
    """What one rule does.

    Raises
    ------
    forgetting.NumericalRange
        When it runs out of the range of numbers; the message names the row.
    """
    estimator = candidate.estimator(samples.parameters, samples.targets)
    errors, used = [], 0
    for part in pieces(len(samples)):
        phi, y = as_run(*samples.rows(part), estimator.dtype)
        try:
            found = estimator.run(phi, y, outputs=("error", "skipped"), missing="skip")
        except fg.NumericalRange as error:
            raise type(error)(in_rows(str(error), part.start)) from None
        errors.append(np.asarray(found.error).reshape(len(y), -1)[scored[part]])
        used += int((found.skipped == USED).sum())
    units = np.ones(samples.parameters) if estimator.units is None else estimator.units
    values = np.linalg.eigvalsh(np.asarray(estimator.covariance) * np.outer(units, units))
    return Whole(typical(rms(np.concatenate(errors))), len(samples) - used, values)
