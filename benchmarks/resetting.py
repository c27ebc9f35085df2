"""The prior kept alive: exponential resetting beside dlib::rls as it is by default.

dlib adds (1 - λ)/C to the information at every sample, in O(n³), which is `exponential_resetting`
with the prior as its information. `cyclic_resetting` adds one direction a sample, in O(n²).
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

import forgetting as fg

from . import native
from .compile import NotAvailable
from .ledger import Ledger
from .markdown import table
from .plan import Plan
from .record import LAMBDA, P0, WrongResult, check, record
from .timing import Side, best_of, race

SAMPLES = 200
RULES = ("exponential_resetting", "cyclic_resetting")


def recursion(phi: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Theta by the information matrix, solved at every sample."""
    n = phi.shape[1]
    theta, information = np.zeros(n), np.eye(n) / P0
    for x, target in zip(phi, y, strict=True):
        information = LAMBDA * information + (1 - LAMBDA) / P0 * np.eye(n) + np.outer(x, x)
        theta += np.linalg.solve(information, x) * (target - x @ theta)
    return theta


def ours(name: str, phi: np.ndarray, y: np.ndarray) -> Side:
    """A rule; the exact one is checked."""
    rule = fg.rule(name, forgetting_factor=LAMBDA, information=1 / P0)
    est = fg.RLS(phi.shape[1], rule=rule, initial_covariance=P0)
    est.run(phi, y)
    if name == "exponential_resetting":
        check(est.theta, recursion(phi, y))
    return Side(name, lambda: est.run(phi, y, outputs=["error"]), est.reset, each=len(y))


def theirs(phi: np.ndarray, y: np.ndarray, ledger: Ledger) -> list[Side]:
    """dlib's default, with each set of flags."""
    sides = []
    try:
        found = native.filters("dlib", (phi, y), (LAMBDA, P0), ledger.missing, "default")
        for name, made in found.items():
            made.reset()
            made.run()
            check(made.theta, recursion(phi, y))
            sides.append(Side(name, made.run, made.reset, group="dlib", each=len(y)))
    except (NotAvailable, WrongResult) as reason:
        ledger.unavailable("dlib::rls, default", reason)
    return sides


def row(n: int, plan: Plan, ledger: Ledger) -> list[str]:
    """One size."""
    phi, y = (array[:SAMPLES] for array in record(n))
    mine = [ours(name, phi, y) for name in RULES]
    sides = [*mine, *theirs(phi, y, ledger)]
    race(sides, plan.seconds)
    row = [str(n), *(f"{side.nanoseconds / 1e3:.2f}" for side in mine)]
    best = best_of(sides, "dlib")
    if best is None:
        return [*row, "not available", ""]
    ratio = best.nanoseconds / mine[0].nanoseconds
    ratio_text = ledger.compare("prior kept alive", f"n = {n}", "dlib::rls, default", ratio)
    return [*row, f"{best.nanoseconds / 1e3:.2f}", ratio_text]


def report(plan: Plan, ledger: Ledger) -> Iterator[str]:
    """Markdown."""
    sizes = plan.of(4, 16, 64) if plan.quick else plan.of(2, 4, 6, 10, 16, 32, 64, 128)
    header = ["n", *(f"`{name}`, µs" for name in RULES), "dlib default, µs", "dlib/the first"]
    yield table(header, [row(n, plan, ledger) for n in sizes])
