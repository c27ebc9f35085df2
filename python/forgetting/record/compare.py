"""Forgetting rules side by side on a record, each with its own best factor."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

import forgetting as fg
from forgetting.models.orders import Each
from forgetting.record.comparison import Compared, Comparison
from forgetting.record.identify import build, listed
from forgetting.record.origin import origin
from forgetting.record.polynomial import recorded, which
from forgetting.record.ranking import Learn, Whole, by_regressors, by_signals, over_all
from forgetting.record.read import Record, read
from forgetting.record.release import release
from forgetting.record.samples import Samples
from forgetting.record.scores import scored_samples
from forgetting.record.tune import problem
from forgetting.tuning.candidate import Candidate, tuned
from forgetting.tuning.choose import SHARE
from forgetting.tuning.grid import MEMORIES
from forgetting.tuning.problem import Problem, Split, split
from forgetting.tuning.runner import Progress, Runner, Trial
from forgetting.tuning.search import ROUNDS, best_of_each

CHOOSING = 100_000
"""Rows by which factors are chosen at most: what a factor is worth shows in fewer."""
MOST_RUNS = MEMORIES + 2 * ROUNDS
"""Runs in which a rule finds its factor; for the progress bar."""


def compare(
    record: Record | Callable[[], Record],
    rules: Sequence[str],
    *,
    formula: str | None = None,
    output: str | Sequence[str] = (),
    input: str | Sequence[str] = (),
    arx: Sequence[Each] | None = None,
    model: str | None = None,
    offset: bool = True,
    initial_covariance: ArrayLike | None = None,
    forgetting_factor: float | None = None,
    share: float = SHARE,
    progress: Progress | None = None,
) -> Comparison:
    """Run rules over a record and rank them by their one-step error.

    Every rule gets the factor (a random walk its process noise) with which it predicts the first
    part best, and is ranked by its error on the rest; see `forgetting.tune`. Of a first part of
    more than 100 000 rows the last 100 000 choose.

    Parameters
    ----------
    record, formula, output, input, arx, model, offset
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
        Called with (runs done, runs expected) after each run.

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
    source = read(record)
    said = formula, listed(output), listed(input), arx, model, offset
    samples, whole, learn = prepared(source, *said, moves=initial_covariance is None)
    del record, source  # the table, which nobody else may hold, is as large as what is made of it
    release(len(samples.y))
    parts = split(whole, share)
    part, choosing = choosing_part(whole, parts)
    runner = Runner(lambda _: part, choosing, progress=progress)
    runner.expected = len(rules)
    plain = [Candidate(fg.rule(name), prior(initial_covariance, samples)) for name in rules]
    chosen, unchosen = with_factors(runner, plain, forgetting_factor, parts.is_enough)
    scored = scored_samples(samples) if unchosen else parts.reporting
    made = []
    for trial, found in zip(chosen, over_all(chosen, samples, learn, scored), strict=True):
        made.append((trial, found))
        if progress is not None:
            runs = runner.runs + len(made)
            progress(runs, max(runner.expected, runs))
    return Comparison(
        ranked=ranking(made, chosen_by=not unchosen),
        refused=[f"{name_of(trial)}: {each.refused}" for trial, each in made if each.refused],
        split=None if unchosen else parts,
        unchosen=unchosen,
        trials=runner.trials,
        samples=samples,
        choosing=None if unchosen or part is whole else len(part.y),
    )


def prepared(
    source: Record,
    formula: str | None,
    outputs: list[str],
    inputs: list[str],
    arx: Sequence[Each] | None,
    model: str | None,
    offset: bool,
    moves: bool,
) -> tuple[Samples, Problem, Learn]:
    """The samples of a model, as factors are chosen by them, and as rules are run over them."""
    arx, named = which(formula, arx, model)
    if named is not None:
        found = recorded(source, outputs, inputs, named, offset)
        return found.plain_samples(), found.signals, by_signals(found.signals)
    samples = build(source, formula, outputs, inputs, arx, offset)
    return samples, problem(samples), by_regressors(origin(samples, moves).moved(samples))


def with_factors(
    runner: Runner, plain: Sequence[Candidate], forgetting_factor: float | None, enough: bool
) -> tuple[list[Trial], str | None]:
    """The rules with their factors, and why none was chosen, if so."""
    if forgetting_factor is not None:
        given = [Trial(with_factor(each, forgetting_factor), np.nan, "given") for each in plain]
        return given, "one factor for all rules: none was chosen"
    if not enough:
        defaults = [Trial(candidate, np.nan, "default") for candidate in plain]
        return defaults, "all rules at their defaults: the record is too short to choose factors"
    runner.keep(None)
    names = [each.rule.name for each in plain if each.rule is not None]
    runner.expected += sum(MOST_RUNS if tuned(name) else 1 for name in names)
    return best_of_each(runner, plain), None


def choosing_part(problem: Problem, parts: Split) -> tuple[Problem, Split]:
    """The rows by which factors are chosen: of a long first part the last `CHOOSING`."""
    start = parts.row - CHOOSING
    if start <= 0:
        return problem, parts
    rows = slice(start, parts.row)
    part = problem.part(rows)
    count = np.cumsum(part.complete)
    settled = count > max(2 * problem.parameters, count[-1] // 10)
    choosing = parts.choosing[rows] & settled
    return part, Split(CHOOSING, choosing, np.zeros_like(choosing))


def ranking(made: Sequence[tuple[Trial, Whole]], chosen_by: bool) -> list[Compared]:
    """The rules that got through the record, the best first."""
    found = [
        Compared(
            name=name_of(trial),
            rule=trial.candidate.rule,
            error=each.error,
            chosen_by=trial.error if chosen_by else None,
            left_out=each.left_out,
            eigenvalues=each.eigenvalues,
        )
        for trial, each in made
        if not each.refused
    ]
    return sorted(found, key=lambda each: each.error)


def name_of(trial: Trial) -> str:
    """Registry name of the rule of a trial."""
    assert trial.candidate.rule is not None
    return trial.candidate.rule.name


def with_factor(plain: Candidate, forgetting_factor: float) -> Candidate:
    """The rule with this factor, if it uses one."""
    rule: Any = plain.rule
    uses = rule.about["forgetting_factor"]
    return plain.with_rule(forgetting_factor=forgetting_factor) if uses else plain


def prior(initial_covariance: ArrayLike | None, samples: Samples) -> tuple[float, ...] | None:
    """The diagonal of P before the first sample."""
    if initial_covariance is None:
        return None
    given = np.asarray(initial_covariance, dtype=np.float64)
    diagonal = np.broadcast_to(given, (samples.phi.shape[1],)) if given.ndim == 0 else given
    return tuple(map(float, diagonal))
