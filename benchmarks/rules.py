"""Time of a sample over that of exponential forgetting: every rule, and what is told nothing."""

from __future__ import annotations

import re
from collections.abc import Iterator

import numpy as np

import forgetting as fg

from .ledger import Ledger
from .markdown import table
from .plan import Plan
from .record import LAMBDA, P0, record
from .timing import Side, growth, race

MAIN = ("subspace", "directional")
# costs whose time should grow with the square of n
QUADRATIC = ("O(n^2)", "O(p n^2)", "O((p + 1) n^2)", "that of the rule")
# seconds of one turn
TURN = 1e-3


def estimator(n: int, name: str) -> fg.RLS:
    """With a rule; those that are compared with exponential forgetting have its factor."""
    factor = {"forgetting_factor": LAMBDA} if name in (*MAIN, "exponential") else {}
    return fg.RLS(n, rule=fg.rule(name, **factor), initial_covariance=P0)


def side(n: int, name: str, est: fg.RLS | fg.Bank | None = None) -> Side:
    """`RLS.run` with a rule, again and again over as much of the record as fits a turn."""
    phi, y = record(n)
    est = estimator(n, name) if est is None else est

    def run(samples: int) -> None:
        est.run(phi[:samples], y[:samples], outputs=["error"])

    trial = Side(name, lambda: run(20))
    trial.turn()
    samples = int(np.clip(TURN / trial.least * 20, 20, len(y)))
    return Side(name, lambda: run(samples), each=samples)


def skipped(n: int, name: str) -> float:
    """The share of a record that a rule leaves out, which costs it less."""
    found = estimator(n, name).run(*record(n))
    return found.skipped_count / found.samples


def times(n: int, names: list[str], seconds: float) -> dict[str, float]:
    """Nanoseconds a sample of each rule, all in one race."""
    sides = [side(n, name) for name in names]
    race(sides, seconds)
    return {each.name: each.nanoseconds for each in sides}


def main_rules(plan: Plan) -> Iterator[str]:
    """The two that stand for forgetting where data come in, at every size."""
    found = {n: times(n, ["exponential", *MAIN], plan.seconds) for n in plan.sizes}
    rows = []
    for n, by_name in found.items():
        base = by_name["exponential"]
        row = [str(n), f"{base:.1f}"]
        for name in MAIN:
            row += [f"{by_name[name]:.1f}", f"{by_name[name] / base:.2f}"]
        rows.append(row)
    header = ["n", "exponential, ns"]
    header += [word for name in MAIN for word in (f"{name}, ns", "over exponential")]
    yield table(header, rows)


def defaults(plan: Plan) -> Iterator[str]:
    """`RLS(n)` and `Bank(n)` without any setting."""
    rows = []
    for n in plan.of(4, 10, 16, 64, 256):
        told_nothing = {"RLS(n)": fg.RLS(n), "Bank(n)": fg.Bank(n)}
        sides = [side(n, "exponential"), *(side(n, *each) for each in told_nothing.items())]
        race(sides, plan.seconds)
        base, *others = (each.nanoseconds for each in sides)
        row = [word for each in others for word in (f"{each / 1e3:.2f}", f"{each / base:.1f}")]
        rows.append([str(n), f"{base / 1e3:.2f}", *row])
    header = ["n", "exponential, µs"]
    header += [word for name in ("RLS(n)", "Bank(n)") for word in (f"{name}, µs", "over it")]
    yield table(header, rows)


def without_functions() -> dict[str, str]:
    """Names and costs of the rules that need nothing from the user."""
    return {
        rule["name"]: rule["cost"]
        for rule in fg.rules()
        if not any(parameter["required"] for parameter in rule["parameters"])
    }


def all_rules(plan: Plan) -> Iterator[str]:
    """The others at few sizes, and how their time grows."""
    costs = without_functions()
    small, large = plan.of(16, 64), plan.of(128, 256, 512)
    quadratic = [name for name, cost in costs.items() if re.split("[;,]", cost)[0] in QUADRATIC]
    found = {n: times(n, list(costs), 2 * plan.seconds) for n in small}
    found |= {n: times(n, quadratic, 2 * plan.seconds) for n in large}
    rows = []
    for name, cost in costs.items():
        mine = {n: by_name[name] for n, by_name in found.items() if name in by_name}
        row = [name, cost]
        for n in small:
            row += [f"{mine[n] / 1e3:.2f}", f"{mine[n] / found[n]['exponential']:.1f}"]
        row.append(f"{growth(mine):.2f}" if len(mine) > len(small) else "")
        rows.append([*row, f"{skipped(16, name):.0%}"])
    header = ["rule", "cost"]
    header += [word for n in small for word in (f"n = {n}, µs", "over exponential")]
    yield table([*header, "exponent from n = 64 on", "samples skipped, n = 16"], rows)


def report(plan: Plan, ledger: Ledger) -> Iterator[str]:
    """Markdown."""
    yield from main_rules(plan)
    yield ""
    yield from defaults(plan)
    yield ""
    yield from all_rules(plan)
    left_out = [rule["name"] for rule in fg.rules() if rule["name"] not in without_functions()]
    yield f"\nNot timed, because made from something of the user's: {', '.join(left_out)}."
