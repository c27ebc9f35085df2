"""What the machine can do at most: multiply-adds, and bytes read and written, a second."""

from __future__ import annotations

import time
from collections.abc import Iterator
from ctypes import c_bool, c_double, c_int, c_long
from functools import cache

from .compile import FLAGS, NotAvailable, library
from .cpu import caches, cores
from .ledger import Ledger
from .markdown import table
from .plan import Plan

TRIALS = 300
# bytes gone over in one trial, and the least memory that no cache holds
TRIAL_BYTES, BEYOND = 16 << 20, 128 << 20


@cache
def multiply_add_rate(dtype: str) -> float:
    """Multiply-adds a second of one core; raises NotAvailable."""
    found = library("limits", FLAGS)
    found.multiply_add_rate.argtypes = [c_bool, c_int]
    found.multiply_add_rate.restype = c_double
    return found.multiply_add_rate(dtype == "float32", TRIALS)


def least_time(n: int, dtype: str) -> float:
    """Seconds of the 1.5 n² multiply-adds that a sample needs in the covariance form."""
    return 1.5 * n * n / multiply_add_rate(dtype)


def levels() -> dict[str, int]:
    """Bytes of a working set that each level of memory holds and the level before does not."""
    sizes = caches() or {"L1": 32 << 10, "L2": 512 << 10, "L3": 8 << 20}
    inside = {name: size // 2 for name, size in sizes.items() if name in ("L1", "L2")}
    if "L3" in sizes:
        # shared, and often by others too
        inside["L3"] = max(2 * sizes.get("L2", 0), sizes["L3"] // 4)
    return {**inside, "DRAM": max(BEYOND, 2 * max(sizes.values()))}


def bandwidth(level: str, threads: int, seconds: float = 0.5) -> float:
    """Bytes read and written a second, at the best of many trials; raises NotAvailable."""
    found = library("limits", FLAGS)
    found.bandwidth.argtypes = [c_long, c_long, c_int]
    found.bandwidth.restype = c_double
    size = levels()[level] // (threads if level == "L3" else 1)
    best, end = 0.0, time.perf_counter() + seconds
    while best == 0 or time.perf_counter() < end:
        best = max(best, found.bandwidth(size, max(2, TRIAL_BYTES // size), threads))
    return best


def report(plan: Plan, ledger: Ledger) -> Iterator[str]:
    """Markdown."""
    try:
        rates = [multiply_add_rate(dtype) / 1e9 for dtype in ("float64", "float32")]
    except NotAvailable as missing:
        yield ledger.unavailable("machine limits", missing)
        return
    yield f"Multiply-adds of one core: {rates[0]:.1f} G/s in float64, {rates[1]:.1f} in float32.\n"
    threads = sorted({1, min(2, cores())})
    rows = []
    for name, size in levels().items():
        rates = [bandwidth(name, t, plan.seconds) / 1e9 for t in threads]
        rows.append([name, f"{size // 1024}", *(f"{rate:.0f}" for rate in rates)])
    header = ["level", "working set, KiB", *(f"GB/s, {t} thread{'s'[: t > 1]}" for t in threads)]
    yield "Read and written, counted each, of x *= a:\n"
    yield table(header, rows)
