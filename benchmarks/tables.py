"""Many streams from tables: million rows a second of `TableFleet` on one core, and its memory.

Batches of a million rows of four regressors over 100,000 keys, in any order of keys and times. A
fleet is timed from its second batch on, when its streams are there. Rows a second are of the
processor's time, which others on the machine do not count in. The limit beside it is the same
samples without a table: a `Fleet` that gets one sample of each stream after the other.
"""

from __future__ import annotations

from . import environment  # isort: skip  # noqa: F401

import json
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

import forgetting as fg

from .ledger import Ledger
from .markdown import table
from .memory import STATUS, resident
from .plan import Plan

N, ROWS, KEYS, MANY = 4, 1_000_000, 100_000, 1_000_000
BATCHES, QUICK = 8, 4
PRIOR = {"initial_covariance": 100.0}
CASES: dict[str, tuple[dict[str, Any], dict[str, Any]]] = {
    "subspace, P₀ given": ({"rule": "subspace", **PRIOR}, {}),
    "the same, rows by time": ({"rule": "subspace", **PRIOR}, {"shuffled": False}),
    "the same, no times": ({"rule": "subspace", **PRIOR}, {"times": False}),
    "the same, keys are text": ({"rule": "subspace", **PRIOR}, {"text": True}),
    "the same, one key has a tenth": ({"rule": "subspace", **PRIOR}, {"skewed": True}),
    "the default": ({}, {}),
    "a bank each": ({"rule": "auto"}, {}),
    "half-life by the clock": ({"rule": "exponential", **PRIOR, "half_life": "1h"}, {}),
}
CHECKED = 20
"""Streams that are compared with single estimators, bit for bit, before a time counts."""


def batch(
    seed: int,
    keys: int = KEYS,
    shuffled: bool = True,
    times: bool = True,
    text: bool = False,
    skewed: bool = False,
) -> Any:
    """A million rows."""
    import pyarrow as pa

    random = np.random.default_rng(seed)
    key = random.integers(0, keys, ROWS)
    if skewed:
        key[random.uniform(size=ROWS) < 0.1] = 0
    columns: dict[str, Any] = {f"x{j}": random.standard_normal(ROWS) for j in range(N)}
    columns["y"] = random.standard_normal(ROWS)
    if times:
        rows = random.permutation(ROWS) if shuffled else np.arange(ROWS)
        columns["t"] = seed * ROWS + rows
    columns["key"] = [f"device-{k:06d}" for k in key.tolist()] if text else key
    return pa.table(columns)


def fleet_of(settings: dict[str, Any], times: bool) -> Any:
    """A fleet for such batches."""
    from forgetting.tables import TableFleet

    names = [f"x{j}" for j in range(N)]
    return TableFleet("key", "y", names, time="t" if times else None, threads=1, **settings)


def check(fleet: Any, settings: dict[str, Any], batches: list[Any]) -> None:
    """That streams are what single estimators come to, bit for bit."""
    own = {name: value for name, value in settings.items() if name != "half_life"}
    if "half_life" in settings:
        own["rule"] = fg.Exponential(half_life=settings["half_life"])
    for key in fleet.keys()[:CHECKED]:
        est, last = fg.Bank(N) if settings.get("rule") == "auto" else fg.RLS(N, **own), None
        for each in batches:
            rows = each.filter(np.array(each.column("key").to_pylist(), dtype=object) == key)
            rows = rows.sort_by("t") if "t" in rows.column_names else rows
            phi = np.column_stack([rows.column(f"x{j}").to_numpy() for j in range(N)])
            times = rows.column("t").to_numpy().astype(float) if "half_life" in settings else None
            if times is not None and len(times):
                times, last = (times if last is None else np.r_[last, times]), times[-1]
            est.run(phi, rows.column("y").to_numpy(), time=times)
        if est.to_bytes() != fleet[key].to_bytes():
            raise ArithmeticError(f"stream {key} differs from a single estimator")


def rate(name: str, count: int) -> float:
    """Rows a second of the fastest batch but the first."""
    settings, kind = CASES[name]
    times = kind.get("times", True)
    first = [batch(seed, **kind) for seed in range(2)]
    fleet = fleet_of(settings, times)
    for each in first:
        fleet.update(each)
    check(fleet, settings, first)
    least = np.inf
    for seed in range(2, count):
        each = batch(seed, **kind)
        start = time.process_time()
        fleet.update(each)
        least = min(least, time.process_time() - start)
    return float(ROWS / least)


def limit() -> float:
    """Samples a second of a `Fleet` of as many streams, without a table."""
    random = np.random.default_rng(0)
    fleet = fg.Fleet(KEYS, N, rule="subspace", threads=1, **PRIOR)
    phi, y = random.standard_normal((KEYS, N)), random.standard_normal(KEYS)
    least = np.inf
    for _ in range(20):
        start = time.process_time()
        fleet.update(phi, y)
        least = min(least, time.process_time() - start)
    return float(KEYS / least)


def held() -> dict[str, float]:
    """What a fleet of a million keys takes: bytes when it rests, and seconds to save and load."""
    fleet = fleet_of(CASES["the default"][0], True)
    before = resident()
    for seed in range(3):
        fleet.update(batch(seed, MANY))
    rests = resident() - before
    start = time.process_time()
    saved = fleet.to_arrow()
    middle = time.process_time()
    type(fleet).from_arrow(saved)
    done = time.process_time()
    return {
        "keys": len(fleet),
        "bytes": rests,
        "state": saved.nbytes,
        "save": middle - start,
        "load": done - middle,
    }


def apart(*arguments: str) -> Any:
    """The answer of this module in a process of its own."""
    command = [sys.executable, "-m", "benchmarks.tables", *arguments]
    root = Path(__file__).parent.parent
    answer = subprocess.run(command, capture_output=True, text=True, check=False, cwd=root)
    if answer.returncode:
        raise RuntimeError((answer.stderr.strip() or "no message").splitlines()[-1])
    return json.loads(answer.stdout)


def report(plan: Plan, ledger: Ledger) -> Iterator[str]:
    """Markdown."""
    count = QUICK if plan.quick else BATCHES
    rows = [[name, f"{apart(name, str(count)) / 1e6:.1f}"] for name in CASES]
    rows.append(["limit: a `Fleet` without a table", f"{apart('limit') / 1e6:.0f}"])
    yield f"n = {N}, {KEYS:,} keys, batches of {ROWS:,} rows, one core:\n"
    yield table(["fleet", "M rows/s"], rows)
    if not STATUS.exists():
        yield ledger.unavailable("memory of a million keys", f"needs {STATUS}")
        return
    found = apart("held")
    yield (
        f"\nWith {found['keys']:,} keys, three batches and their leavings it holds "
        f"{found['bytes'] / 1e6:.0f} MB; its state is {found['state'] / 1e6:.0f} MB, saved in "
        f"{found['save']:.1f} s and loaded in {found['load']:.1f} s."
    )


if __name__ == "__main__":
    asked = sys.argv[1]
    if asked in CASES:
        print(json.dumps(rate(asked, int(sys.argv[2]))))
    else:
        print(json.dumps(limit() if asked == "limit" else held()))
