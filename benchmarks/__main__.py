"""Speed of `forgetting` beside what users write or install: `python -m benchmarks [--quick]`.

Every number is the least of several repetitions, each side with the same data, in one process and
on one thread; read them as ratios. Prints Markdown.
"""

from __future__ import annotations

import os

for variable in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(variable, "1")

import argparse
import platform
import time
from collections.abc import Callable

import numpy as np

import forgetting as fg

SIZES = (2, 4, 6, 10, 16, 32, 64, 128)
LAMBDA = 0.999


def least(work: Callable[[], object], repetitions: int) -> float:
    """The shortest of several runs, in seconds."""
    times = []
    for _ in range(repetitions):
        start = time.perf_counter()
        work()
        times.append(time.perf_counter() - start)
    return min(times)


def step_time(rule: fg.Rule, n: int, dtype: str, repetitions: int) -> float:
    """Nanoseconds a sample of `run`, which keeps the one-step errors."""
    samples = max(2000, 400_000 // (n * n))
    random = np.random.default_rng(n)
    phi = random.normal(size=(samples, n)).astype(dtype)
    y = random.normal(size=samples).astype(dtype)
    est = fg.RLS(n, rule=rule, dtype=dtype)
    work = least(lambda: est.run(phi, y, outputs=["error"]), repetitions)
    return work / samples * 1e9


def growth(name: str, repetitions: int) -> tuple[float, float]:
    """The exponent of time over n = 16 to 256, and microseconds a sample at n = 64."""
    sizes, times = (16, 32, 64, 128, 256), []
    for n in sizes:
        samples = max(20, 1_000_000 // (n * n))
        random = np.random.default_rng(n)
        phi, y = random.normal(size=(samples, n)), random.normal(size=samples)
        est = fg.RLS(n, rule=fg.rule(name))
        work = least(lambda: est.run(phi, y, outputs=["error"]), repetitions)  # noqa: B023
        times.append(work / samples)
    slope = np.polyfit(np.log(sizes), np.log(times), 1)[0]
    return float(slope), times[2] * 1e6


def numpy_step(theta: np.ndarray, p: np.ndarray, phi: np.ndarray, y: float) -> None:
    """The textbook's covariance form, as written by hand."""
    gain = p @ phi / (LAMBDA + phi @ p @ phi)
    theta += gain * (y - phi @ theta)
    p -= np.outer(gain, phi @ p)
    p /= LAMBDA


def padasip_call(phi: np.ndarray) -> Callable[[], object] | None:
    """One `adapt` of padasip, if it is installed."""
    try:
        import padasip
    except ImportError:
        return None
    peer = padasip.filters.FilterRLS(n=len(phi), mu=LAMBDA)
    return lambda: peer.adapt(0.3, phi)


def call_times(repetitions: int) -> list[tuple[str, float]]:
    """Microseconds of one call from Python with four parameters."""
    phi = np.random.default_rng(0).normal(size=4)
    theta, p = np.zeros(4), 100.0 * np.eye(4)
    est = fg.RLS(4, rule=fg.Subspace(LAMBDA))
    calls: list[tuple[str, Callable[[], object] | None]] = [
        ("`forgetting` update (subspace)", lambda: est.update(phi, 0.3)),
        ("NumPy by hand (exponential)", lambda: numpy_step(theta, p, phi, 0.3)),
        ("padasip adapt (exponential)", padasip_call(phi)),
    ]
    found = []
    for name, call in calls:
        if call is None:
            found.append((f"{name}: not installed", float("nan")))
            continue
        many = 20_000 if "forgetting" in name else 2_000

        def loop(call: Callable[[], object] = call, many: int = many) -> None:
            for _ in range(many):
                call()

        found.append((name, least(loop, repetitions) / many * 1e6))
    return found


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks", description=__doc__)
    parser.add_argument("--quick", action="store_true", help="fewer repetitions")
    repetitions = 5 if parser.parse_args().quick else 25
    print(f"forgetting {fg.__version__}, NumPy {np.__version__}, {platform.processor()}")
    print(f"Python {platform.python_version()}, least of {repetitions} repetitions, one thread\n")
    columns = [
        ("exponential", fg.Exponential(LAMBDA), "float64"),
        ("subspace", fg.Subspace(LAMBDA), "float64"),
        ("exponential, float32", fg.Exponential(LAMBDA), "float32"),
    ]
    print("| n | " + " | ".join(f"{name}, ns a sample" for name, *_ in columns) + " |")
    print("|---|" + "---|" * len(columns))
    for n in SIZES:
        times = [step_time(rule, n, dtype, repetitions) for _, rule, dtype in columns]
        print(f"| {n} | " + " | ".join(f"{t:.0f}" for t in times) + " |")
    print(
        "\n| rule | cost | exponent over n = 16 to 256 | µs a sample, n = 64 |\n|---|---|---|---|"
    )
    for rule in fg.rules():
        if any(parameter["required"] for parameter in rule["parameters"]):
            continue  # made from a function of the user's
        slope, microseconds = growth(rule["name"], max(2, repetitions // 5))
        print(f"| {rule['name']} | {rule['cost']} | {slope:.2f} | {microseconds:.1f} |")
    print("\n| one call from Python, n = 4 | µs | times `forgetting` |\n|---|---|---|")
    calls = call_times(repetitions)
    for name, microseconds in calls:
        print(f"| {name} | {microseconds:.2f} | {microseconds / calls[0][1]:.1f} |")


if __name__ == "__main__":
    main()
