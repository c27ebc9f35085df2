"""The order in which settings are chosen: cheap runs first, and only the best go on.

Orders of a model are chosen first, each at the best of a few speeds. Every rule is then run
over a coarse grid of its factor; the grid is made finer around the best of those rules that go
on. Other parameters, rates and priors are tried last, where they are worth it (`worth.py`).
"""

from __future__ import annotations

from collections.abc import Sequence

from forgetting._core import InvalidInput
from forgetting.tuning import grid
from forgetting.tuning.candidate import NOISE, Candidate, tuned
from forgetting.tuning.problem import Problem
from forgetting.tuning.runner import Runner, Trial, best
from forgetting.tuning.structures import ModelOrders
from forgetting.tuning.worth import (
    MARGIN,
    WITH_RATES,
    preferred,
    with_priors,
    with_rates,
    with_variants,
)

GO_ON = 3
"""Rules of which the factor is found more closely."""
ROUNDS = 2
"""How often the grid is made finer."""


def best_orders(runner: Runner, orders: Sequence[ModelOrders]) -> ModelOrders:
    """The fewest orders that predict about as well as the best, each at its best speed."""
    if len(orders) == 1:
        return orders[0]
    tried = [[Candidate(rule, None, each) for rule in grid.speeds()] for each in orders]
    runner.score([candidate for candidates in tried for candidate in candidates], "orders")
    least = [runner.score(candidates, "orders")[0].error for candidates in tried]
    if min(least) == float("inf"):
        raise InvalidInput("no model could be run on the first part of the record")
    near = min(least) * (1 + MARGIN)
    good = (each for each, error in zip(orders, least, strict=True) if error <= near)
    return min(good, key=lambda each: each.size)


def best_of_each(
    runner: Runner, plain: Sequence[Candidate], go_on: int | None = None
) -> list[Trial]:
    """Each rule with its best factor, the best rule first.

    Parameters
    ----------
    plain : sequence of Candidate
        The rules, with any factor.
    go_on : int, optional
        Of how many rules the factor is found more closely; all if not given.
    """
    tried = [coarse(runner, candidate) for candidate in plain]
    runner.score([each for candidates in tried for each in candidates], "factors")
    ranked = [runner.score(candidates, "factors") for candidates in tried]
    ranked.sort(key=lambda trials: trials[0].error)
    going = ranked[:go_on]
    for _ in range(ROUNDS):
        finer = [[*map(candidate_of, trials), *closer(trials)] for trials in going]
        runner.score([each for candidates in finer for each in candidates], "factors")
        going = [runner.score(candidates, "factors") for candidates in finer]
    found = [best(trials) for trials in [*going, *ranked[len(going) :]]]
    return sorted(found, key=lambda trial: trial.error)


def candidate_of(trial: Trial) -> Candidate:
    """What was tried."""
    return trial.candidate


def coarse(runner: Runner, plain: Candidate) -> list[Candidate]:
    """The rule with every setting of the first grid."""
    assert plain.rule is not None
    name = tuned(plain.rule.name)
    if name is None:
        return [plain]
    values = grid.settings(plain.rule.name, int(runner.split.choosing.sum()))
    return [plain.with_rule(**{name: value}) for value in values]


def closer(trials: Sequence[Trial]) -> list[Candidate]:
    """The settings in the middle between the best of a rule and its neighbours."""
    centre = trials[0].candidate
    assert centre.rule is not None
    rule, name = centre.rule.name, tuned(centre.rule.name)
    if name is None:
        return []
    # beside the shortest memory on the grid stands that of one sample, which is a factor of 0
    beyond = [] if name == NOISE else [0.0]
    values = beyond + sorted(setting(trial.candidate) for trial in trials)
    at = values.index(setting(centre))
    near = [values[place] for place in (at - 1, at + 1) if 0 <= place < len(values)]
    middles = [grid.between(setting(centre), value, rule) for value in near]
    return [centre.with_rule(**{name: value}) for value in middles]


def setting(candidate: Candidate) -> float:
    """The factor or the noise of a candidate."""
    assert candidate.rule is not None
    name = tuned(candidate.rule.name)
    assert name is not None
    value = candidate.rule.arguments()[name]
    return float(value[0] if isinstance(value, list) else value)


def search(
    runner: Runner,
    rules: Sequence[str],
    orders: ModelOrders | None,
    problem: Problem,
    rates: bool,
    priors: bool,
) -> Trial:
    """The best setting of all."""
    plain = [Candidate(grid.plain_rule(rule), None, orders) for rule in rules]
    ranked = best_of_each(runner, plain, GO_ON)
    ranked = [with_variants(runner, trial) for trial in ranked[:GO_ON]]
    ranked.sort(key=lambda trial: trial.error)
    if ranked[0].error == float("inf"):
        raise InvalidInput(f"none of the rules {', '.join(rules)} could be run on the first part")
    ranked.insert(0, preferred(ranked))
    found = with_rates(runner, ranked, problem.y.shape[1]) if rates else ranked[0]
    return with_priors(runner, found, problem) if priors else found


def expected(orders: int, rules: Sequence[str], rates: bool, priors: bool) -> int:
    """About how many runs a search takes; for a progress bar."""
    grids = sum(grid.MEMORIES if tuned(rule) else 1 for rule in rules)
    more = GO_ON * (2 * ROUNDS + 3) + len(grid.PRIORS) * priors
    values = sum(len(values) for _, values in grid.RATES.values())
    per_rule = values * len(grid.SMALLEST)
    return (
        (orders * len(grid.SPEEDS) if orders > 1 else 0)
        + 1
        + grids
        + more
        + rates * WITH_RATES * per_rule
    )
