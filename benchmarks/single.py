"""One stream, exponential forgetting, one row, one thread: nanoseconds a sample beside C++."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

import forgetting as fg

from . import limits, native
from .compile import NotAvailable, build
from .ledger import Ledger
from .markdown import table
from .plan import Plan
from .record import LAMBDA, P0, WrongResult, check, record, solution
from .timing import Side, best_of, growth, race

PEERS = {"eigen": "Eigen", "dlib": "dlib::rls"}
DTYPES = ("float64", "float32")


def ours(phi: np.ndarray, y: np.ndarray, outputs: Sequence[str] | None) -> Side:
    """`RLS.run` over a record."""
    dtype = str(phi.dtype)
    rule = fg.Exponential(LAMBDA)
    est = fg.RLS(phi.shape[1], rule=rule, initial_covariance=P0, dtype=dtype)
    est.run(phi, y, outputs=outputs)
    check(est.theta, solution(phi, y))
    return Side("forgetting", lambda: est.run(phi, y, outputs=outputs), est.reset, each=len(y))


def cpp(source: str, phi: np.ndarray, y: np.ndarray, ledger: Ledger) -> list[Side]:
    """Each variant of a peer in C++ with each set of flags, as rivals."""
    only = "C forgotten" if source == "dlib" else ""  # its default is another rule
    try:
        found = native.filters(source, (phi, y), (LAMBDA, P0), ledger.missing, only)
    except NotAvailable as missing:
        ledger.unavailable(PEERS[source], missing)
        return []
    sides, reference = [], solution(phi, y)
    for name, made in found.items():
        made.reset()
        made.run()
        try:
            check(made.theta, reference)
        except WrongResult as wrong:
            where = f"n = {phi.shape[1]}, {phi.dtype}"
            ledger.unavailable(f"{PEERS[source]}, {name}, {where}", wrong)
            continue
        group = f"{source} {phi.dtype}"
        sides.append(Side(name, made.run, made.reset, group=group, each=len(y)))
    return sides


def measure(n: int, plan: Plan, ledger: Ledger) -> dict[str, list[Side]]:
    """All sides at one size."""
    sides: dict[str, list[Side]] = {}
    for dtype in DTYPES:
        phi, y = record(n, dtype)
        sides[f"ours {dtype}"] = [ours(phi, y, ["error"])]
        sides[f"eigen {dtype}"] = cpp("eigen", phi, y, ledger)
    phi, y = record(n)
    sides["default outputs"] = [ours(phi, y, None)]
    sides["dlib float64"] = cpp("dlib", phi, y, ledger)
    race([side for group in sides.values() for side in group], plan.seconds)
    return sides


def double_row(n: int, sides: dict[str, list[Side]], ledger: Ledger) -> list[str]:
    """One size in float64."""
    mine = sides["ours float64"][0].nanoseconds
    row = [str(n), f"{mine:.1f}", f"{sides['default outputs'][0].nanoseconds:.1f}"]
    row += rival(n, mine, sides, "eigen float64", "Eigen", ledger)
    row += rival(n, mine, sides, "dlib float64", "dlib::rls", ledger)
    return row


def single_row(n: int, sides: dict[str, list[Side]], ledger: Ledger) -> list[str]:
    """One size in float32."""
    mine = sides["ours float32"][0].nanoseconds
    times = sides["ours float64"][0].nanoseconds / mine
    row = [str(n), f"{mine:.1f}", f"{times:.2f}"]
    return row + rival(n, mine, sides, "eigen float32", "Eigen, float32", ledger)


def rival(
    n: int, mine: float, sides: dict[str, list[Side]], group: str, name: str, ledger: Ledger
) -> list[str]:
    """The best of a group beside ours: time, ratio, which."""
    best = best_of(sides[group], group)
    if best is None:
        return ["not available", "", ""]
    ratio = ledger.compare("single stream", f"n = {n}", name, best.nanoseconds / mine)
    return [f"{best.nanoseconds:.1f}", ratio, best.name]


def limit_row(n: int, sides: dict[str, list[Side]]) -> list[str]:
    """The multiply-adds that a sample needs, and how near ours are."""
    row = [str(n)]
    for dtype in DTYPES:
        bound = limits.least_time(n, dtype) * 1e9
        row += [f"{bound:.1f}", f"{bound / sides[f'ours {dtype}'][0].nanoseconds:.0%}"]
    return row


def report(plan: Plan, ledger: Ledger) -> Iterator[str]:
    """Markdown."""
    build()
    found = {n: measure(n, plan, ledger) for n in plan.sizes}
    header = ["n", "`run`, error only", "`run`, all outputs", "Eigen", "Eigen/ours", "written as"]
    header += ["dlib", "dlib/ours", "with"]
    yield "float64, ns a sample:\n"
    yield table(header, [double_row(n, sides, ledger) for n, sides in found.items()])
    yield "\nfloat32, ns a sample:\n"
    header = ["n", "`run`, error only", "float64/float32", "Eigen", "Eigen/ours", "written as"]
    yield table(header, [single_row(n, sides, ledger) for n, sides in found.items()])
    yield "\nLimit by the multiply-adds of the covariance form, 1.5 n², ns a sample:\n"
    header = ["n", "limit, float64", "limit/ours", "limit, float32", "limit/ours"]
    try:
        yield table(header, [limit_row(n, sides) for n, sides in found.items()])
    except NotAvailable as missing:
        yield ledger.unavailable("machine limits", missing)
    yield from exponents(found)
    if not plan.quick:
        yield from variants(found)


def exponents(found: dict[int, dict[str, list[Side]]]) -> Iterator[str]:
    """How time grows."""
    if len([n for n in found if n >= 64]) < 2:
        return
    yield "\nExponent of time over n = 64 to 512:\n"
    rows = []
    for group in ("ours float64", "ours float32", "eigen float64", "eigen float32", "dlib float64"):
        least = {
            n: min(side.nanoseconds for side in sides[group])
            for n, sides in found.items()
            if sides[group]
        }
        rows.append([group, f"{growth(least):.2f}"])
    yield table(["side", "exponent"], rows)


def variants(found: dict[int, dict[str, list[Side]]]) -> Iterator[str]:
    """Every way of writing it in C++; those far behind had three turns."""
    for group in ("eigen float64", "eigen float32", "dlib float64"):
        times = {n: {side.name: side.nanoseconds for side in s[group]} for n, s in found.items()}
        names = dict.fromkeys(name for by_name in times.values() for name in by_name)
        yield f"\nEvery variant of {group}, ns a sample:\n"
        rows = [
            [name, *(f"{t[name]:.0f}" if name in t else "" for t in times.values())]
            for name in names
        ]
        yield table(["variant", *(f"n = {n}" for n in found)], rows)
