"""What knowing when to trust an estimate costs: watch, gate and meter beside an update.

    python -m benchmarks.live [--quick]

Each row is one estimator without and with the part, their runs taking turns, so that whatever
else the machine does meets both.
"""

from __future__ import annotations

import os

for variable in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(variable, "1")

import argparse
import time
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

import forgetting as fg

LAMBDA = 0.999
SIZES = (4, 16, 64)
RULES = (fg.Subspace(LAMBDA), fg.Exponential(LAMBDA))
PARTS: dict[str, dict[str, Any]] = {
    "nothing": {},
    "monitor": {"monitor": True},
    "minimum_information": {"gate": fg.MinimumInformation()},
    "dead_zone": {"gate": fg.DeadZone(1e-9)},
}


def in_turns(works: Mapping[str, Callable[[], object]], repetitions: int) -> dict[str, float]:
    """The shortest of several runs of each, one of each at a time, in seconds."""
    least = dict.fromkeys(works, float("inf"))
    for _ in range(repetitions):
        for name, work in works.items():
            start = time.perf_counter()
            work()
            least[name] = min(least[name], time.perf_counter() - start)
    return least


def times(rule: fg.Rule, n: int, repetitions: int) -> dict[str, float]:
    """Nanoseconds a sample of `run` with each part."""
    samples = max(500, 200_000 // (n * n))
    random = np.random.default_rng(n)
    phi, y = random.normal(size=(samples, n)), random.normal(size=samples)

    def work(options: dict[str, Any]) -> Callable[[], object]:
        est = fg.RLS(n, rule=rule, **options)
        return lambda: est.run(phi, y, outputs=["error"])

    least = in_turns({name: work(options) for name, options in PARTS.items()}, repetitions)
    return {name: seconds / samples * 1e9 for name, seconds in least.items()}


def meter_time(n: int, repetitions: int) -> float:
    """Nanoseconds of one `ExcitationMeter.add`."""
    phi = np.random.default_rng(n).normal(size=(1000, n))
    meter = fg.ExcitationMeter(n, 100)

    def work() -> None:
        for row in phi:
            meter.add(row)

    return in_turns({"add": work}, repetitions)["add"] / len(phi) * 1e9


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.live", description=__doc__)
    parser.add_argument("--quick", action="store_true", help="fewer repetitions")
    repetitions = 50 if parser.parse_args().quick else 400
    names = list(PARTS)
    print(f"least of {repetitions} repetitions in turns, one thread, `run`, ns a sample\n")
    print(f"| rule | n | {' | '.join(names)} | monitor costs |\n|---|---|{'---|' * len(names)}---|")
    for rule in RULES:
        for n in SIZES:
            found = times(rule, n, repetitions)
            cells = " | ".join(f"{found[name]:.0f}" for name in names)
            more = found["monitor"] / found["nothing"] - 1
            print(f"| {rule.name} | {n} | {cells} | {more:+.0%} |")
    print("\n| n | `ExcitationMeter.add`, ns a call from Python |\n|---|---|")
    for n in SIZES:
        print(f"| {n} | {meter_time(n, max(5, repetitions // 10)):.0f} |")


if __name__ == "__main__":
    main()
