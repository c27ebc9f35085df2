"""Forgetting rules side by side on a record, each with its own best factor."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

import forgetting as fg
from forgetting.record.identification import Identification, finite
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


@dataclass(frozen=True)
class Compared:
    """A rule on a record.

    Attributes
    ----------
    name : str
        Registry name of the rule.
    found : Identification
        Its run over the whole record.
    error : float
        One-step root mean square error on the rest of the record, or, where nothing was chosen, on
        all of it; of several outputs the geometric mean.
    chosen_by : float or None
        The error on the first part, by which its factor was chosen; None where it was not.
    """

    name: str
    found: Identification
    error: float
    chosen_by: float | None

    @property
    def setting(self) -> tuple[str, Any] | None:
        """The parameter that says how much the rule forgets, and its value."""
        name = tuned(self.name)
        return None if name is None else (name, self.found.rule.arguments()[name])

    def summary(self) -> dict[str, Any]:
        """The rule for JSON."""
        ends = self.found.trace.eigenvalues[-1]
        return {
            "rule": self.name,
            "setting": None if self.setting is None else dict([self.setting]),
            "error": self.error,
            "error_on_first_part": self.chosen_by,
            "left_out": len(self.found.samples.y) - self.found.used,
            "largest_eigenvalue": float(ends[-1]),
            "covariance_ratio": self.found.covariance_ratio,
        }


@dataclass(frozen=True)
class Comparison:
    """Rules ranked by their error.

    Attributes
    ----------
    ranked : list of Compared
        The best first.
    refused : list of str
        Rules that did not get through the record, and why.
    split : Split or None
        The part that chose and the rest; None where nothing was chosen.
    unchosen : str or None
        Why nothing was chosen.
    trials : list of Trial
        All factors that were tried.
    """

    ranked: list[Compared]
    refused: list[str]
    split: Split | None
    unchosen: str | None
    trials: list[Trial]

    def scored_in_words(self) -> str:
        """Which samples the errors are of, and what was chosen."""
        if self.split is None:
            return f"all samples, {self.unchosen}"
        count = int(self.split.reporting.sum())
        return f"the last {count} samples, each rule with its best factor on those before"

    def summary(self) -> dict[str, Any]:
        """All of it for JSON: None where a number is not finite."""
        samples = self.ranked[0].found.samples if self.ranked else None
        found = {
            "record": None if samples is None else samples.source,
            "model": None if samples is None else samples.model,
            "scored": self.scored_in_words(),
            "first_row_of_the_rest": None if self.split is None else self.split.row,
            "rules": [each.summary() for each in self.ranked],
            "refused": self.refused,
        }
        return dict(finite(found))


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
    record, formula, output, input, arx, initial_covariance
        The record and the model, see `forgetting.record.identify`.
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
    parts, unchosen = split(problem(samples), share), None
    plain = [Candidate(fg.rule(name), prior(initial_covariance, samples)) for name in rules]
    runner = Runner(lambda _: problem(samples), parts, progress=progress)
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
    scored = None if unchosen else parts
    model: dict[str, Any] = {
        "formula": formula,
        "output": output,
        "input": input,
        "arx": arx,
        "initial_covariance": initial_covariance,
    }
    ranked, refused = [], []
    for trial in chosen:
        rule = trial.candidate.rule
        assert rule is not None
        try:
            ranked.append(ranked_by(trial, identify(record, rule=rule, **model), scored))
        except fg.NumericalRange as error:
            refused.append(f"{rule.name}: {error}")
    ranked.sort(key=lambda each: each.error)
    return Comparison(ranked, refused, scored, unchosen, runner.trials)


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
