"""The theory of generalized forgetting on an identification: its conditions, and what follows.

It needs P after every sample, n² numbers each. Of a record for which that would be more than
`MOST` numbers the last part is examined; excitation, windup and errors are judged on all of it
by `forgetting.record.judge`.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

import forgetting as fg
from forgetting.analysis import Certificate, certify
from forgetting.record.identification import Identification
from forgetting.record.moved import as_run
from forgetting.record.origin import origin
from forgetting.record.samples import pieces

Array = NDArray[np.float64]

MOST = 5_000_000
"""Numbers in all P examined; the analysis needs some ten arrays of that size."""
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


def theory(
    found: Identification,
    rule: Any,
    gate: Any = None,
    initial_covariance: ArrayLike | None = None,
    dtype: str = "float64",
) -> tuple[Certificate, int]:
    """Run the identification again, and check the conditions of Theorem 2 along it.

    Parameters
    ----------
    found : Identification
    rule, gate, initial_covariance, dtype
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
    start = max(0, total - max(MOST // n**2, 2 * n))
    estimator = fg.RLS(
        n,
        rule=rule,
        gate=gate,
        targets=samples.targets,
        initial_covariance=initial_covariance,
        dtype=dtype,
    )
    for part in pieces(start):
        phi, y = as_run(*samples.rows(part), dtype)
        estimator.run(phi, y, outputs=(), missing="skip")
    known = start > 0 or initial_covariance is not None
    scale = np.outer(found.units, found.units)
    before = np.asarray(estimator.covariance, dtype=np.float64) * scale if known else None
    regressors, outputs = samples.rows(slice(start, None))
    phi, y = as_run(regressors, outputs, dtype)
    made = certify(
        # of the run itself nothing is kept: all P are there in units alone
        in_units(estimator.run(phi, y, outputs=OUTPUTS, missing="skip"), scale),
        regressors / found.units,
        initial_covariance=before,
        rule=rule if initial_covariance is not None else None,
        names=list(samples.regressors),
    )
    return made, start
