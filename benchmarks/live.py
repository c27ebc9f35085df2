"""What it costs to watch: `RLS.run` with `monitor=True` over the same without."""

from __future__ import annotations

from collections.abc import Iterator

import forgetting as fg

from .ledger import Ledger
from .markdown import table
from .plan import Plan
from .record import LAMBDA, P0, record
from .timing import Side, race

RULES = {"exponential": fg.Exponential, "subspace": fg.Subspace}


def run(n: int, rule: fg.Rule, monitor: bool) -> Side:
    """A record with or without the monitor."""
    phi, y = record(n)
    est = fg.RLS(n, rule=rule, initial_covariance=P0, monitor=monitor)
    return Side(
        "with" if monitor else "without",
        lambda: est.run(phi, y, outputs=["error"]),
        est.reset,
        each=len(y),
    )


def row(n: int, name: str, seconds: float) -> list[str]:
    """One rule at one size."""
    rule = RULES[name](LAMBDA)
    without, watched = run(n, rule, False), run(n, rule, True)
    race([without, watched], seconds)
    more = watched.nanoseconds - without.nanoseconds
    times = [f"{side.nanoseconds:.1f}" for side in (without, watched)]
    return [name, str(n), *times, f"{more:.1f}", f"{more / without.nanoseconds:+.0%}"]


def report(plan: Plan, ledger: Ledger) -> Iterator[str]:
    """Markdown."""
    sizes = plan.of(4, 16, 64)
    header = ["rule", "n", "without, ns", "with, ns", "more, ns", "more"]
    yield table(header, [row(n, name, plan.seconds) for name in RULES for n in sizes])
