"""The theory of generalized forgetting on an identification: its conditions, and what follows.

It needs P after every sample, n² numbers each. Of a record for which that would be more than
`MOST` numbers the last part is examined; excitation, windup and errors are judged on all of it
by `forgetting.record.judge`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

import forgetting as fg
from forgetting.analysis import Certificate, certify
from forgetting.record.half_life import LastTime, with_time
from forgetting.record.identification import Identification
from forgetting.record.moved import Moved, as_run
from forgetting.record.origin import origin
from forgetting.record.samples import Samples, pieces
from forgetting.words.errors import RecordError

Array = NDArray[np.float64]

MOST = 5_000_000
"""Numbers in all P examined; the analysis needs some ten arrays of that size."""
SETTLING = 160
"""Samples a parameter after which those of a model with coloured noise count 95 % or more."""
PSEUDOLINEAR = (
    "The model is not linear in its parameters: its regressors are made from the estimates, and "
    "its errors are linear in the parameters only near the truth. What is said of P, excitation "
    "and windup holds for the linear regression that was run. What is said of the error of the "
    "estimates, and the intervals, hold near the truth alone: from far away convergence is not "
    "guaranteed, and a minimum may be one of several (Ljung 1999, chapter 11)."
)
"""What of the theory does not hold where regressors follow from the estimates."""
OUTPUTS = ("error", "forgetting_factor", "skipped", "covariance", "prior_covariance", "weight")


@dataclass(frozen=True)
class InUnits:
    """Outputs of a run with P in units of the regressors, so that no constant depends on those."""

    error: Any
    forgetting_factor: Any
    skipped: Any
    weight: Any
    covariance: Array
    prior_covariance: Array


def in_units(run: Any, scale: Array) -> InUnits:
    """The outputs of `run`, P times `scale`."""
    after, prior = run.covariance * scale, run.prior_covariance * scale
    # of several outputs as targets of one row, not as rows
    error = run.error[:, np.newaxis] if run.error.ndim == 2 else run.error
    return InUnits(error, run.forgetting_factor, run.skipped, run.weight, after, prior)


def reservation(samples: Samples) -> str | None:
    """What of the theory does not hold for the model of these samples; None where all of it does.

    Examples
    --------
    >>> phi, y = np.ones((3, 1)), np.ones((3, 1))
    >>> reservation(Samples(phi, y, ("1",), ("y",), "y ~ 1", None, "")) is None
    True
    """
    return PSEUDOLINEAR if samples.is_pseudolinear else None


def begin(samples: Samples) -> int:
    """The row from which on all samples count alike.

    A model that makes its own regressors lets its first samples count less, by what they were
    multiplied with; intervals would be judged by errors that are too small. At most half of the
    record is left out.
    """
    if not samples.is_pseudolinear:
        return 0
    settled = np.searchsorted(np.cumsum(samples.complete), SETTLING * samples.phi.shape[1])
    return min(int(settled), len(samples.y) // 2)


def with_units(samples: Moved) -> int:
    """Rows after which every regressor has been other than 0, but for those that never are.

    Where P follows the data, the prior of a parameter is set when its regressor first speaks: P
    jumps there, without anything being forgotten.

    Examples
    --------
    >>> phi = np.array([[1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 5.0, 0.0], [1.0, 6.0, 0.0]])
    >>> with_units(Moved(Samples(phi, phi[:, :1], ("1", "I", "T"), ("y",), "", None, "")))
    3
    """
    first = np.full(samples.parameters, -1)
    complete = samples.samples.complete
    for part in pieces(len(samples)):
        phi, _ = samples.rows(part)
        speaks = (phi != 0) & complete[part, None]
        new = (first < 0) & speaks.any(axis=0)
        first[new] = part.start + speaks[:, new].argmax(axis=0)
        if (first >= 0).all():
            break
    return int(first.max()) + 1


def theory(
    found: Identification,
    rule: Any,
    gate: Any = None,
    initial_covariance: ArrayLike | None = None,
    dtype: str = "float64",
    half_life: Any = None,
    by_clock: bool = False,
) -> tuple[Certificate, int]:
    """Run the identification again, and check the conditions of Theorem 2 along it.

    Parameters
    ----------
    found : Identification
    rule, gate, initial_covariance, dtype, half_life, by_clock
        As given to `forgetting.record.identify`; `rule` is no bank.

    Returns
    -------
    Certificate
        Of the rows from the second result on, constants in units of the regressors' typical size.
    int
        Rows of the record before those.
    """
    samples = origin(found.samples, moves=initial_covariance is None).moved(found.samples)
    n, total = samples.parameters, len(samples)
    rule, time = with_time(rule, half_life, by_clock, found.samples)
    start = max(begin(found.samples), total - max(MOST // n**2, 2 * n))
    if initial_covariance is None:
        start = max(start, min(with_units(samples), total - 2 * n))
    estimator = fg.RLS(
        n,
        rule=rule,
        gate=gate,
        targets=samples.targets,
        initial_covariance=initial_covariance,
        dtype=dtype,
    )
    last = LastTime()

    def learn(rows: slice, regressors: Array, outputs: Array, wanted: Sequence[str]) -> Any:
        phi, y = as_run(regressors, outputs, dtype)
        when = None if time is None else last.ahead_of(time[rows])
        run = estimator.run(phi, y, outputs=wanted, missing="skip", time=when)
        if time is not None:
            last.note(time[rows], found.samples.complete[rows])
        return run

    for part in pieces(start):
        learn(part, *samples.rows(part), ())
    known = start > 0 or initial_covariance is not None
    if total - start < 2 and not known:
        raise RecordError(
            f"{found.samples.source} has {total} row; to certify an estimate takes at least 2"
        )
    scale = np.outer(found.units, found.units)
    before = np.asarray(estimator.covariance, dtype=np.float64) * scale if known else None
    rest = slice(start, None)
    regressors, outputs = samples.rows(rest)
    made = certify(
        # of the run itself nothing is kept: all P are there in units alone
        in_units(learn(rest, regressors, outputs, OUTPUTS), scale),
        regressors / found.units,
        initial_covariance=before,
        # what a rule guarantees is stated for one step of time after the other
        rule=rule if initial_covariance is not None and time is None else None,
        names=list(samples.regressors),
    )
    return made, start
