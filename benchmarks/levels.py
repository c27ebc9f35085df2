"""Each set of instructions that the machine has: nanoseconds a sample of `RLS.run`.

A process finds out once which instructions there are, so each set has processes of its own, held
down to it by a variable of the environment; they take turns.
"""

from __future__ import annotations

from . import environment  # isort: skip  # noqa: F401

import json
import os
import subprocess
import sys
from collections.abc import Iterator

import forgetting as fg

from .cpu import VARIABLE, levels, model
from .ledger import Ledger
from .markdown import table
from .plan import Plan
from .record import LAMBDA, P0, check, record, solution
from .timing import Side, race

RULES = ("exponential", "subspace")
DTYPES = ("float64", "float32")
# turns of the processes, and seconds that one takes for a size
TURNS, SECONDS = 3, 0.15


def side(n: int, rule: str, dtype: str) -> Side:
    """`RLS.run` over a record; exponential forgetting is checked."""
    phi, y = record(n, dtype)
    est = fg.RLS(
        n, rule=fg.rule(rule, forgetting_factor=LAMBDA), initial_covariance=P0, dtype=dtype
    )
    est.run(phi, y, outputs=["error"])
    if rule == "exponential":
        check(est.theta, solution(phi, y))
    name = f"{rule}, {dtype}"
    return Side(name, lambda: est.run(phi, y, outputs=["error"]), est.reset, each=len(y))


def times(sizes: list[int]) -> dict[str, dict[str, float]]:
    """Nanoseconds a sample, by name and size, with the instructions of this process."""
    found: dict[str, dict[str, float]] = {}
    for n in sizes:
        sides = [side(n, rule, dtype) for dtype in DTYPES for rule in RULES]
        race(sides, SECONDS)
        for each in sides:
            found.setdefault(each.name, {})[str(n)] = each.nanoseconds
    return found


def times_of(level: str, sizes: list[int]) -> dict[str, dict[str, float]]:
    """The same with the instructions of a level, in a process of its own."""
    command = [sys.executable, "-m", "benchmarks.levels", *map(str, sizes)]
    done = subprocess.run(
        command, env={**os.environ, VARIABLE: level}, stdout=subprocess.PIPE, check=True
    )
    found: dict[str, dict[str, float]] = json.loads(done.stdout)
    return found


def row(name: str, n: str, found: dict[str, list[dict[str, dict[str, float]]]]) -> list[str]:
    """One size of one table: the least of each level's turns, and how many times the first's."""
    least = [min(turn[name][n] for turn in turns) for turns in found.values()]
    slower = [f"{time / least[0]:.1f}" for time in least[1:]]
    return [n, *(f"{time:.1f}" for time in least), *slower]


def report(plan: Plan, ledger: Ledger) -> Iterator[str]:
    """Markdown."""
    sizes = plan.of(4, 10, 16, 64, 256) if plan.quick else list(plan.sizes)
    found: dict[str, list[dict[str, dict[str, float]]]] = {level: [] for level in levels()}
    for _ in range(TURNS):
        for level, turns in found.items():
            turns.append(times_of(level, sizes))
    best, *others = found
    header = ["n", *(f"{level}, ns" for level in found), *(f"{name}/{best}" for name in others)]
    yield f"On {model()}."
    for name in found[best][0]:
        yield f"\n{name.capitalize()}:\n"
        yield table(header, [row(name, str(n), found) for n in sizes])


if __name__ == "__main__":
    print(json.dumps(times([int(size) for size in sys.argv[1:]])))
