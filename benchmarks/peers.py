"""One stream, exponential forgetting: nanoseconds a sample beside Python, over a whole record."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from . import packages
from .hand import BlasFilter, NumpyFilter, loop_of, numba_full, numba_triangle
from .ledger import Ledger
from .markdown import table
from .plan import Plan
from .record import WrongResult, check, record, solution
from .single import ours
from .timing import Side, race

# seconds of one turn of a slow peer: its record is cut to that
TURN = 0.02


@dataclass(frozen=True)
class Peer:
    """A way to do it in Python.

    `make(n)` returns what runs over a record and returns theta; `solution(phi, y)` is what theta
    must be.
    """

    name: str
    make: Callable[[int], Callable[[np.ndarray, np.ndarray], np.ndarray]]
    solution: Callable[[np.ndarray, np.ndarray], np.ndarray]
    quick: bool = True
    largest: int = 512


PEERS = (
    Peer("NumPy by hand", loop_of(NumpyFilter), solution),
    Peer("SciPy BLAS dsymv, dsyr", loop_of(BlasFilter), solution),
    Peer("Numba, full", numba_full, solution),
    Peer("Numba, lower half", numba_triangle, solution),
    Peer("padasip FilterRLS, O(n³)", loop_of(packages.PadasipFilter), solution, largest=256),
    Peer("pyroomacoustics RLS (FIR)", packages.pyroomacoustics, packages.fir_solution, False),
    Peer("statsmodels RecursiveLS, λ = 1", packages.statsmodels, packages.ordinary, False, 32),
    Peer("river BLR, smoothing, O(n³)", packages.river, packages.river_solution, False, 128),
)


def side(peer: Peer, n: int) -> Side:
    """A peer with as much of the record as it does in a turn; raises if it cannot or is wrong."""
    phi, y = record(n)
    run, samples = peer.make(n), min(len(y), 3 * n)
    run(phi[:samples], y[:samples])  # may compile
    for _ in range(2):  # a short record is mostly the call itself
        trial = Side(peer.name, lambda m=samples: run(phi[:m], y[:m]))
        trial.turn()
        samples = int(np.clip(TURN / trial.least * samples, min(samples, 3 * n), len(y)))
    phi, y = phi[:samples], y[:samples]
    check(run(phi, y), peer.solution(phi, y))
    return Side(peer.name, lambda: run(phi, y), each=samples)


def measure(n: int, plan: Plan, ledger: Ledger) -> tuple[Side, dict[str, Side]]:
    """All sides at one size."""
    mine, sides = ours(*record(n), ["error"]), {}
    for peer in PEERS:
        if n > peer.largest or (plan.quick and not peer.quick):
            continue
        try:
            sides[peer.name] = side(peer, n)
        except (ImportError, WrongResult) as reason:
            ledger.unavailable(peer.name, reason)
    race([mine, *sides.values()], plan.seconds)
    return mine, sides


def report(plan: Plan, ledger: Ledger) -> Iterator[str]:
    """Markdown."""
    sizes = plan.of(4, 16, 64, 256) if plan.quick else plan.sizes
    rows: dict[str, list[str]] = {"`forgetting` run": []}
    rows |= {peer.name: [] for peer in PEERS if peer.quick or not plan.quick}
    for n in sizes:
        mine, sides = measure(n, plan, ledger)
        rows["`forgetting` run"].append(f"{mine.nanoseconds:.0f}")
        for name in list(rows)[1:]:
            if name not in sides:
                rows[name].append(ledger.absent(name))
                continue
            theirs = sides[name].nanoseconds
            ratio = ledger.compare("record in Python", f"n = {n}", name, theirs / mine.nanoseconds)
            rows[name].append(f"{theirs:.0f} ({ratio})")
    yield "ns a sample (times `forgetting`):\n"
    yield table(["", *(f"n = {n}" for n in sizes)], [[name, *row] for name, row in rows.items()])
    if plan.quick:
        yield "\nMore peers and sizes: `make bench-full`."
