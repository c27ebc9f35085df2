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

# what the names of variants begin with; dlib's default is another rule
PEERS = {
    "Eigen, fixed size": ("eigen", "fixed size"),
    "Eigen": ("eigen", "dynamic"),
    "dlib::rls": ("dlib", "C forgotten"),
}
DTYPES = ("float64", "float32")


def ours(phi: np.ndarray, y: np.ndarray, outputs: Sequence[str] | None) -> Side:
    """`RLS.run` over a record."""
    dtype = str(phi.dtype)
    rule = fg.Exponential(LAMBDA)
    est = fg.RLS(phi.shape[1], rule=rule, initial_covariance=P0, dtype=dtype)
    est.run(phi, y, outputs=outputs)
    check(est.theta, solution(phi, y))
    return Side("forgetting", lambda: est.run(phi, y, outputs=outputs), est.reset, each=len(y))


def cpp(peer: str, phi: np.ndarray, y: np.ndarray, ledger: Ledger) -> list[Side]:
    """Each variant of a peer in C++ with each set of flags, as rivals."""
    source, only = PEERS[peer]
    try:
        found = native.filters(source, (phi, y), (LAMBDA, P0), ledger.missing, only)
    except NotAvailable as missing:
        ledger.unavailable(peer, missing)
        return []
    sides, reference = [], solution(phi, y)
    for name, made in found.items():
        made.reset()
        made.run()
        try:
            check(made.theta, reference)
        except WrongResult as wrong:
            ledger.unavailable(f"{peer}, {name}, n = {phi.shape[1]}, {phi.dtype}", wrong)
            continue
        group = f"{peer} {phi.dtype}"
        written = name.removeprefix(only).removeprefix(", ")
        sides.append(Side(written, made.run, made.reset, group=group, each=len(y)))
    return sides


def measure(n: int, plan: Plan, ledger: Ledger) -> dict[str, list[Side]]:
    """All sides at one size, by name and type."""
    sides: dict[str, list[Side]] = {}
    for dtype in DTYPES:
        phi, y = record(n, dtype)
        sides[f"ours {dtype}"] = [ours(phi, y, ["error"])]
        for peer in PEERS:
            sides[f"{peer} {dtype}"] = cpp(peer, phi, y, ledger)
    sides["all outputs"] = [ours(*record(n), None)]
    race([side for group in sides.values() for side in group], plan.seconds)
    return sides


def double_row(n: int, sides: dict[str, list[Side]], ledger: Ledger) -> list[str]:
    """One size in float64."""
    times = [sides[name][0].nanoseconds for name in ("ours float64", "all outputs")]
    row = [str(n), *(f"{time:.1f}" for time in times)]
    for peer in PEERS:
        row += rival(n, "float64", sides, peer, ledger)
    return row


def single_row(n: int, sides: dict[str, list[Side]], ledger: Ledger) -> list[str]:
    """One size in float32."""
    mine = sides["ours float32"][0].nanoseconds
    row = [str(n), f"{mine:.1f}", f"{sides['ours float64'][0].nanoseconds / mine:.2f}"]
    for peer in list(PEERS)[:2]:  # dlib knows doubles only
        row += rival(n, "float32", sides, peer, ledger)
    return row


def rival(n: int, dtype: str, sides: dict[str, list[Side]], peer: str, ledger: Ledger) -> list[str]:
    """The best variant of a peer beside ours: time, how it is written, ratio."""
    best = best_of(sides[f"{peer} {dtype}"], f"{peer} {dtype}")
    if best is None:
        return [ledger.absent(peer), ""]
    ratio = best.nanoseconds / sides[f"ours {dtype}"][0].nanoseconds
    text = ledger.compare(f"single stream, {dtype}", f"n = {n}", peer, ratio)
    return [f"{best.nanoseconds:.1f} ({best.name})", text]


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
    beside = [word for peer in PEERS for word in (peer, f"{peer.split('::')[0]}/ours")]
    yield "float64, ns a sample; a peer's best variant, in brackets how it is written:\n"
    header = ["n", "`run`, error only", "`run`, all outputs", *beside]
    yield table(header, [double_row(n, sides, ledger) for n, sides in found.items()])
    yield "\nfloat32, ns a sample:\n"
    header = ["n", "`run`, error only", "float64/float32", *beside[:4]]
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
    yield "\nExponent of time from n = 64 on:\n"
    rows = []
    for side in ("ours float64", "ours float32", "Eigen float64", "Eigen float32"):
        least = {n: min(s.least / s.each for s in by[side]) for n, by in found.items() if by[side]}
        rows.append([side, f"{growth(least):.2f}"])
    yield table(["side", "exponent"], rows)


def variants(found: dict[int, dict[str, list[Side]]]) -> Iterator[str]:
    """Every way of writing it in C++; those far behind had three turns."""
    for group in (f"{peer} {dtype}" for dtype in DTYPES for peer in PEERS):
        times = {n: {side.name: side.nanoseconds for side in s[group]} for n, s in found.items()}
        names = dict.fromkeys(name for by_name in times.values() for name in by_name)
        rows = [
            [name, *(f"{t[name]:.0f}" if name in t else "" for t in times.values())]
            for name in names
        ]
        if rows:
            yield f"\nEvery variant of {group}, ns a sample:\n"
            yield table(["variant", *(f"n = {n}" for n in found)], rows)
