"""A search from its problem to its report: choose on the first part, report on the rest."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from forgetting.tuning import grid
from forgetting.tuning.candidate import Candidate
from forgetting.tuning.problem import Problem, check, split
from forgetting.tuning.report import report
from forgetting.tuning.result import Lines, Tuning
from forgetting.tuning.runner import Make, Progress, Runner
from forgetting.tuning.search import best_orders, expected, search
from forgetting.tuning.structures import ModelOrders

SHARE = 2 / 3
"""Of the complete samples, those that choose."""


def choose(
    make: Make,
    models: Sequence[ModelOrders | None],
    covering: Problem,
    say: Callable[[Candidate], Lines],
    *,
    rules: str | Sequence[str],
    rates: bool,
    priors: bool,
    share: float,
    threads: int | None = None,
    progress: Progress | None = None,
    outputs: Sequence[str] | None = None,
) -> Tuning:
    """Search, report and say how to use it.

    Parameters
    ----------
    make : callable
        Makes the problem of given orders.
    models : sequence of Orders, of NamedModel or of None
        The models to try; [None] for a regression.
    covering : Problem
        A model whose complete samples all models can predict.
    say : callable
        How to use a candidate.
    """
    names = grid.named_rules(rules if isinstance(rules, str) else list(rules))
    parts = check(split(covering, share), share)
    runner = Runner(make, parts, threads, progress)
    runner.expected = expected(len(models), names, rates, priors)
    given = [each for each in models if each is not None]
    orders = best_orders(runner, given) if given else None
    problem = runner.keep(orders)
    runner.score([Candidate(None, None, orders)], "bank")
    best = search(runner, names, orders, problem, rates, priors)
    if progress is not None:
        progress(runner.runs, runner.runs)
    return Tuning(
        best=best,
        rest=report(best.candidate, orders, problem, parts),
        split=parts,
        trials=runner.trials,
        lines=say(best.candidate),
        lines_of_bank=say(Candidate(None, None, orders)),
        outputs=tuple(outputs or [f"y{j}" for j in range(problem.y.shape[1])]),
    )
