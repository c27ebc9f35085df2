"""Many streams at once: million updates a second of `Fleet`, and how near that is to the memory.

A fleet of small estimators does little arithmetic for the numbers that it moves. What an update
moves at least: the state, n (n + 1) / 2 + n numbers, read and written, phi and y read and the
error written. The limit is that many bytes over the bandwidth of the memory that holds the fleet,
measured in the same process, with the same threads, in turns with the fleet.
"""

from __future__ import annotations

from . import environment  # isort: skip  # noqa: F401

import json
import os
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

import forgetting as fg

from . import limits
from .compile import NotAvailable
from .cpu import caches, cores
from .ledger import Ledger
from .markdown import table
from .plan import Plan
from .record import LAMBDA, P0
from .timing import Side, race

N = 6
# after so many samples, streams are compared with single estimators; measured: rounding
CHECKED_SAMPLES, CHECKED_STREAMS = 20, 5
AGREES = {"float64": 1e-9, "float32": 1e-3}
SECONDS = 3.0


def bytes_moved(n: int, dtype: str) -> int:
    """By one update, at least."""
    state = n * (n + 1) // 2 + n
    return (2 * state + n + 1 + 1) * np.dtype(dtype).itemsize


def level(count: int, dtype: str, threads: int) -> str:
    """The nearest memory that holds each thread's part of the fleet."""
    size = count * bytes_moved(N, dtype) / 2
    sizes = caches()
    if "L2" in sizes and size / threads <= sizes["L2"]:
        return "L2"
    return "L3" if "L3" in sizes and size <= sizes["L3"] else "DRAM"


def made(count: int, dtype: str, rule: fg.Rule) -> Any:
    """A fleet."""
    return fg.Fleet(count, N, rule=rule, initial_covariance=P0, dtype=dtype)  # type: ignore[attr-defined]


def check(rule: fg.Rule, dtype: str) -> float:
    """The largest difference of theta from single estimators."""
    random = np.random.default_rng(0)
    fleet = made(CHECKED_STREAMS, dtype, rule)
    alone = [
        fg.RLS(N, rule=rule, initial_covariance=P0, dtype=dtype) for _ in range(CHECKED_STREAMS)
    ]
    for _ in range(CHECKED_SAMPLES):
        phi = random.standard_normal((CHECKED_STREAMS, N)).astype(dtype)
        y = random.standard_normal(CHECKED_STREAMS).astype(dtype)
        fleet.update(phi, y)
        for est, row, target in zip(alone, phi, y, strict=True):
            est.update(row, target)
    return float(np.abs(np.asarray(fleet.theta) - [est.theta for est in alone]).max())


def measured(count: int, dtype: str, threads: int) -> dict[str, Any]:
    """One fleet, in a process that was started with so many threads."""
    rule = fg.Exponential(LAMBDA)
    apart = check(rule, dtype)
    if not apart < AGREES[dtype]:
        raise ArithmeticError(f"theta differs from single estimators by {apart:.1e}")
    random = np.random.default_rng(1)
    phi = random.standard_normal((count, N)).astype(dtype)
    y = random.standard_normal(count).astype(dtype)
    fleet, where = made(count, dtype, rule), level(count, dtype, threads)
    calls = max(1, 100_000 // count)
    rates = [0.0]

    def update() -> None:
        for _ in range(calls):
            fleet.update(phi, y, outputs=["error"])

    def bandwidth() -> None:
        rates[0] = max(rates[0], limits.bandwidth(where, threads))

    # the same regressors for ever would wind exponential forgetting up
    side = Side("fleet", update, fleet.reset, each=count * calls, clock=time.perf_counter)
    for _ in range(2):  # in turns with the limit
        bandwidth()
        race([side], SECONDS / 2)
    bandwidth()
    return {"rate": 1e9 / side.nanoseconds, "bandwidth": rates[0], "level": where}


def row(count: int, dtype: str, threads: int, ledger: Ledger) -> list[str]:
    """One fleet."""
    name = [f"{count:,}", dtype, str(threads)]
    command = [sys.executable, "-m", "benchmarks.fleet", str(count), dtype, str(threads)]
    settings = os.environ | {"RAYON_NUM_THREADS": str(threads)}
    answer = subprocess.run(
        command,
        env=settings,
        capture_output=True,
        text=True,
        check=False,
        cwd=Path(__file__).parent.parent,
    )
    if answer.returncode:
        reason = (answer.stderr.strip() or "no message").splitlines()[-1]
        return [*name, ledger.unavailable(f"fleet of {', '.join(name)}", reason), "", "", ""]
    found = json.loads(answer.stdout)
    bound = found["bandwidth"] / bytes_moved(N, dtype)
    share = f"{found['rate'] / bound:.0%}"
    return [*name, f"{found['rate'] / 1e6:.1f}", found["level"], f"{bound / 1e6:.1f}", share]


def report(plan: Plan, ledger: Ledger) -> Iterator[str]:
    """Markdown."""
    if not hasattr(fg, "Fleet"):
        yield ledger.unavailable("fleet", "this forgetting has no Fleet")
        return
    counts = (800, 1_000_000) if plan.quick else (800, 1_000_000, 4_000_000)
    threads = sorted({1, min(2, cores())})
    rows = [
        row(count, dtype, t, ledger)
        for dtype in ("float64", "float32")
        for count in counts
        for t in threads
    ]
    yield f"n = {N}, exponential forgetting, {bytes_moved(N, 'float64')} bytes moved an update:\n"
    header = ["streams", "type", "threads", "M updates/s", "held in", "limit, M/s", "of the limit"]
    yield table(header, rows)


if __name__ == "__main__":
    try:
        print(json.dumps(measured(int(sys.argv[1]), sys.argv[2], int(sys.argv[3]))))
    except NotAvailable as missing:
        sys.exit(str(missing))
