"""Memory of one estimator, by growth of the process, beside the numbers of a covariance."""

from __future__ import annotations

from . import environment  # isort: skip  # noqa: F401

import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

from .ledger import Ledger
from .markdown import table
from .plan import Plan

STATUS = Path("/proc/self/statm")
MANY = 200
BYTES = {"float64": 8, "float32": 4}


def resident() -> int:
    """Bytes of this process in memory; Linux only."""
    return int(STATUS.read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def held(n: int, dtype: str) -> float:
    """Bytes of one estimator, used, of many in this process."""
    import numpy as np

    import forgetting as fg

    phi, y = np.random.default_rng(0).standard_normal((3, n)).astype(dtype), np.zeros(3, dtype)
    rule = fg.Exponential(0.999)

    def make() -> fg.RLS:
        est = fg.RLS(n, rule=rule, dtype=dtype)
        est.run(phi, y, outputs=["error"])
        est.update(phi[0], 0.0)
        return est

    make()
    before = resident()
    kept = [make() for _ in range(MANY)]
    return (resident() - before) / len(kept)


def measured(n: int, dtype: str) -> float:
    """`held` in a process of its own, whose heap nobody has used before."""
    command = [sys.executable, "-m", "benchmarks.memory", str(n), dtype]
    root = Path(__file__).parent.parent
    answer = subprocess.run(command, capture_output=True, text=True, check=True, cwd=root)
    return float(answer.stdout)


def report(plan: Plan, ledger: Ledger) -> Iterator[str]:
    """Markdown."""
    if not STATUS.exists():
        yield ledger.unavailable("memory of one estimator", f"needs {STATUS}")
        return
    rows = []
    for n in plan.of(64, 128, 256, 512):
        for dtype, size in BYTES.items():
            bytes_held, needed = measured(n, dtype), n * (n + 1) / 2 * size
            row = [str(n), dtype, f"{bytes_held / 1024:.1f}", f"{needed / 1024:.1f}"]
            rows.append([*row, f"{bytes_held / needed:.2f}"])
    yield table(["n", "type", "held, KiB", "n (n + 1) / 2 numbers, KiB", "ratio"], rows)


if __name__ == "__main__":
    print(held(int(sys.argv[1]), sys.argv[2]))
