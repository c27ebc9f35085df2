"""Identify a model from a measured record."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

import forgetting as fg
from forgetting.record.dynamics import dynamics
from forgetting.record.identification import Identification
from forgetting.record.missing import Words
from forgetting.record.names import clean
from forgetting.record.read import Record, read
from forgetting.record.samples import Samples
from forgetting.record.scores import score
from forgetting.record.trace import Progress, errors_without_forgetting, run
from forgetting.record.verdicts import verdicts
from forgetting.words.errors import RecordError

if TYPE_CHECKING:
    from narwhals.typing import IntoDataFrame


def identify(
    record: str | Path | IntoDataFrame | Record,
    *,
    formula: str | None = None,
    output: str | Sequence[str] = (),
    input: str | Sequence[str] = (),
    arx: Sequence[int] | None = None,
    rule: Any = "subspace",
    gate: Any = None,
    initial_covariance: ArrayLike = 100.0,
    dtype: str = "float64",
    time: str | None = None,
    gap: str | float | None = None,
    missing: str | float | Words = (),
    progress: Progress | None = None,
) -> Identification:
    """Identify a regression or an ARX model recursively over a whole record.

    Parameters
    ----------
    record : path, data frame or Record
        See `forgetting.record.read`.
    formula : str, optional
        A regression such as ``"power ~ 0 + sun + sun:warmth"``; ``lag(x, k)`` is x, k rows ago.
    output, input : str or sequence of str, optional
        Columns of an ARX model; several outputs share one regressor.
    arx : sequence of three int, optional
        Orders na, nb, nk of the ARX model.
    rule : str or Rule
        Forgetting rule.
    gate : str, Gate or callable, optional
        Whether a sample is used; see `forgetting.gates`.
    initial_covariance : float or array_like
        P before the first sample: scalar, (n,) diagonal or (n, n), in units of 1/regressor².
    dtype : str
        "float64" or "float32".
    time, gap, missing
        The clock, its gaps, and what stands for missing values; see `forgetting.record.read`.
    progress : callable, optional
        Called with (rows done, rows in all) while the estimator runs.

    Returns
    -------
    Identification

    Raises
    ------
    RecordError
        When the file, a column, a cell or the model is at fault.
    forgetting.InvalidInput
        When a parameter of the estimator is out of range.
    forgetting.NumericalRange
        When a rule without a bounded covariance ran out of the range of numbers.

    Notes
    -----
    A sample with a missing value in a regressor or output is skipped and counted. A lag that
    crosses a missing cell or a gap of the clock is missing. A model without lags needs no clock.

    Examples
    --------
    >>> import numpy as np, pandas as pd
    >>> x = np.sin(np.arange(200.0))
    >>> found = identify(pd.DataFrame({"x": x, "y": 3 * x + 1}), formula="y ~ x")
    >>> found.parameters["value"].round(2).tolist()
    [1.0, 3.0]
    >>> found.used, found.missing
    (200, 0)
    """
    source = read(record, time, gap=gap, missing=missing)
    samples = build(source, formula, listed(output), listed(input), arx)
    estimator = fg.RLS(
        samples.phi.shape[1],
        rule=rule,
        gate=gate,
        targets=samples.y.shape[1],
        initial_covariance=initial_covariance,
        dtype=dtype,
        monitor=True,
    )
    initial = np.asarray(estimator.covariance, dtype=np.float64)
    trace = run(estimator, samples, progress)
    baseline = errors_without_forgetting(samples, initial_covariance, dtype)
    return Identification(
        samples=samples,
        trace=trace,
        rule=estimator.rule if isinstance(rule, str) else rule,
        scores=score(samples, trace.error, baseline),
        verdicts=verdicts(samples, trace, np.diag(initial)),
        initial_covariance=initial,
    )


def build(
    record: Record,
    formula: str | None,
    outputs: list[str],
    inputs: list[str],
    arx: Sequence[int] | None,
) -> Samples:
    """Choose between a formula and ARX, and refuse half of one with half of the other."""
    if formula is not None:
        if outputs or inputs or arx is not None:
            raise RecordError("say the model by a formula, or by output, input and arx; not both")
        # Imported here: a program that only wants ARX need not have formulaic.
        from forgetting.record.regression import regression

        return regression(record, formula)
    if arx is None or not outputs:
        raise RecordError("say the model: a formula, or output columns with ARX orders na,nb,nk")
    return dynamics(record, outputs, inputs, arx)


def listed(names: str | Sequence[str]) -> list[str]:
    """One name or several, as a list; numbers name columns, too."""
    several = isinstance(names, Sequence) and not isinstance(names, str)
    return [clean(name) for name in (names if several else [names])]
