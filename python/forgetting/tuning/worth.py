"""What must be worth its place: other parameters, rates, priors, and rules without a bound of P.

What is simpler or safer stays unless something else is better by `MARGIN` on the first part: the
more is tried, the more seems better by chance, and the input may fall silent in the rest.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from forgetting.choices import Rate
from forgetting.tuning import grid
from forgetting.tuning.candidate import Candidate, tuned
from forgetting.tuning.problem import Problem
from forgetting.tuning.runner import Runner, Trial, best

MARGIN = 0.005
"""By how much of its error something must be better to take the place of a default."""
WITH_RATES = 2
"""Rules that are tried with each rate."""


def preferred(ranked: Sequence[Trial]) -> Trial:
    """The best rule, but by the margin rather one of which P stays bounded without excitation."""
    bounded = [trial for trial in ranked if is_bounded(trial.candidate)]
    near = bounded and ranked[0].error >= bounded[0].error * (1 - MARGIN)
    return bounded[0] if near else ranked[0]


def is_bounded(candidate: Candidate) -> bool:
    """Whether the registry knows a bound of P from above for the rule."""
    assert candidate.rule is not None
    return bool(candidate.rule.about["bounded_above"] != "no")


def worth(runner: Runner, plain: Trial, others: Sequence[Candidate], stage: str) -> Trial:
    """The best of some candidates where it is better than the plain one by the margin."""
    if not others:
        return plain
    found = best(runner.score(others, stage))
    return found if found.error < plain.error * (1 - MARGIN) else plain


def with_variants(runner: Runner, trial: Trial) -> Trial:
    """With another value of one of its other parameters, where that is worth it."""
    assert trial.candidate.rule is not None
    others = [trial.candidate.with_rule(**values) for values in grid.variants(trial.candidate.rule)]
    return worth(runner, trial, others, "parameters")


def with_rates(runner: Runner, ranked: Sequence[Trial], outputs: int) -> Trial:
    """The best of all: a rate with one of the best rules, where that is worth it."""
    taking = list(dict.fromkeys(t.candidate for t in ranked if takes_a_rate(t.candidate)))
    others = [
        candidate.with_rule(forgetting_factor=rate)
        for candidate in taking[:WITH_RATES]
        for rate in grid.rates(outputs)
    ]
    return worth(runner, ranked[0], others, "rates")


def takes_a_rate(candidate: Candidate) -> bool:
    """Whether the rule has a forgetting factor."""
    return candidate.rule is not None and tuned(candidate.rule.name) == "forgetting_factor"


def with_priors(runner: Runner, trial: Trial, problem: Problem) -> Trial:
    """With P before the first sample given, where that is worth it.

    Tried only with rules whose parameters are no numbers in units of the columns: with P given in
    these units, a threshold would be, too, and so would what a rate judges errors by.
    """
    rule = trial.candidate.rule
    assert rule is not None
    if any(rule.parameters.values()) or isinstance(rule.forgetting_factor, Rate):
        return trial
    squares = problem.mean_squares(runner.split.row)
    others = [replace(trial.candidate, initial_covariance=prior) for prior in grid.priors(squares)]
    return worth(runner, trial, others, "priors")
