"""Forgetting rules side by side on a record, each with its own best factor."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

import forgetting as fg
from forgetting.record.comparison import Compared, Comparison
from forgetting.record.identification import Identification
from forgetting.record.identify import build, identify, listed
from forgetting.record.read import Record
from forgetting.record.samples import Samples
from forgetting.record.tune import problem
from forgetting.tuning.baseline import rms, typical
from forgetting.tuning.candidate import Candidate, tuned
from forgetting.tuning.choose import SHARE
from forgetting.tuning.grid import MEMORIES
from forgetting.tuning.problem import Split, split
from forgetting.tuning.runner import Progress, Runner, Trial
from forgetting.tuning.search import ROUNDS, best_of_each

MOST_RUNS = MEMORIES + 2 * ROUNDS
"""Runs in which a rule finds its factor; for the progress bar."""


def compare(
    record: Record,
    rules: Sequence[str],
    *,
    formula: str | None = None,
    output: str | Sequence[str] = (),
    input: str | Sequence[str] = (),
    arx: Sequence[int] | None = None,
    initial_covariance: ArrayLike | None = None,
    forgetting_factor: float | None = None,
    share: float = SHARE,
    progress: Progress | None = None,
) -> Comparison:
    """Run rules over a record and rank them by their one-step error.

    Every rule gets the factor (a random walk its process noise) with which it predicts the first
    part best, and is ranked by its error on the rest; see `forgetting.tune`.

    Parameters
    ----------
    record, formula, output, input, arx
        The record and the model, see `forgetting.record.identify`.
    initial_covariance : float or array_like of shape (n,), optional
        P before the first sample, or its diagonal; follows the data if not given.
    rules : sequence of str
        Registry names.
    forgetting_factor : float, optional
        One for all rules that have one: nothing is chosen, and all samples are scored. So they are
        where the record is too short to choose by: rules have their defaults then.
    share : float
        Of the complete samples, those that choose.
    progress : callable, optional
        Called with (runs done, runs expected) while factors are chosen.

    Raises
    ------
    RecordError, forgetting.InvalidInput
        When the record, the model or a parameter is at fault.

    Examples
    --------
    >>> import numpy as np, pandas as pd
    >>> from forgetting.record import read
    >>> random = np.random.default_rng(0)
    >>> x = random.normal(size=600)
    >>> record = read(pd.DataFrame({"x": x, "y": np.cumsum(0.1 * random.normal(size=600)) * x}))
    >>> found = compare(record, ["none", "exponential"], formula="y ~ 0 + x")
    >>> [each.name for each in found.ranked]
    ['exponential', 'none']
    """
    samples = build(record, formula, listed(output), listed(input), arx)
    parts = split(problem(samples), share)
    plain = [Candidate(fg.rule(name), prior(initial_covariance, samples)) for name in rules]
    runner = Runner(lambda _: problem(samples), parts, progress=progress)
    unchosen = None
    if forgetting_factor is not None:
        unchosen = "one factor for all rules: none was chosen"
        chosen = [Trial(fixed(name, forgetting_factor), np.nan, "given") for name in rules]
    elif not parts.is_enough:
        unchosen = "all rules at their defaults: the record is too short to choose factors"
        chosen = [Trial(candidate, np.nan, "default") for candidate in plain]
    else:
        runner.keep(None)
        runner.expected = sum(MOST_RUNS if tuned(name) else 1 for name in rules)
        chosen = best_of_each(runner, plain)
    model = {"formula": formula, "output": output, "input": input, "arx": arx}
    settings = {**model, "initial_covariance": initial_covariance}
    scored = None if unchosen else parts
    ranked, refused = ranking(chosen, record, scored, settings)
    return Comparison(ranked, refused, scored, unchosen, runner.trials)


def ranking(
    chosen: Sequence[Trial], record: Record, parts: Split | None, settings: dict[str, Any]
) -> tuple[list[Compared], list[str]]:
    """Every rule run over the whole record, the best first; and those that did not get through."""
    ranked, refused = [], []
    for trial in chosen:
        rule = trial.candidate.rule
        assert rule is not None
        try:
            ranked.append(ranked_by(trial, identify(record, rule=rule, **settings), parts))
        except fg.NumericalRange as error:
            refused.append(f"{rule.name}: {error}")
    return sorted(ranked, key=lambda each: each.error), refused


def fixed(name: str, forgetting_factor: float) -> Candidate:
    """The rule with this factor, if it uses one."""
    plain: Any = fg.rule(name)
    uses = plain.about["forgetting_factor"]
    return Candidate(fg.rule(name, forgetting_factor=forgetting_factor) if uses else plain)


def ranked_by(trial: Trial, found: Identification, parts: Split | None) -> Compared:
    """A rule with the error that it is ranked by."""
    rule = trial.candidate.rule
    assert rule is not None
    if parts is None:
        return Compared(rule.name, found, typical(found.scores.model), None)
    error = typical(rms(found.trace.error[parts.reporting]))
    return Compared(rule.name, found, error, trial.error)


def prior(initial_covariance: ArrayLike | None, samples: Samples) -> tuple[float, ...] | None:
    """The diagonal of P before the first sample."""
    if initial_covariance is None:
        return None
    given = np.asarray(initial_covariance, dtype=np.float64)
    diagonal = np.broadcast_to(given, (samples.phi.shape[1],)) if given.ndim == 0 else given
    return tuple(map(float, diagonal))
