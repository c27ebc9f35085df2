"""One stream, exponential forgetting, one row: nanoseconds a sample beside C++."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

import forgetting as fg

from . import native
from .markdown import table
from .native import NotAvailable, filters
from .timing import Side, best_of, race

SIZES = (2, 4, 6, 10, 16, 32, 64, 128, 256, 512)
LAMBDA, P0 = 0.999, 100.0
# relative difference of theta after the run from the batch solution; measured below 1e-10
AGREES = {"float64": 1e-8, "float32": 2e-2}


def record(n: int, dtype: str) -> tuple[np.ndarray, np.ndarray]:
    """White regressors, few enough to stay in the second cache and to make a turn short."""
    samples = max(64, 32768 // n)
    random = np.random.default_rng(n)
    phi = random.standard_normal((samples, n))
    y = phi @ random.standard_normal(n) + 0.1 * random.standard_normal(samples)
    return phi.astype(dtype), y.astype(dtype)


def solution(phi: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Theta after all samples, from the cost that exponential forgetting minimises."""
    phi, y = phi.astype(float), y.astype(float)
    weights = LAMBDA ** np.arange(len(y) - 1, -1, -1.0)
    prior = LAMBDA ** len(y) / P0 * np.eye(phi.shape[1])
    return np.linalg.solve((phi.T * weights) @ phi + prior, (phi.T * weights) @ y)


def disagreement(theta: np.ndarray, reference: np.ndarray) -> float:
    """Relative difference."""
    return float(np.linalg.norm(theta - reference) / np.linalg.norm(reference))


def ours(phi: np.ndarray, y: np.ndarray, outputs: list[str] | None, name: str) -> Side:
    """`RLS.run` over the record."""
    n, dtype = phi.shape[1], str(phi.dtype)
    est = fg.RLS(n, rule=fg.Exponential(LAMBDA), initial_covariance=P0, dtype=dtype)
    est.run(phi, y)
    check(name, est.theta, phi, y)
    return Side(name, lambda: est.run(phi, y, outputs=outputs), est.reset)


def check(name: str, theta: np.ndarray, phi: np.ndarray, y: np.ndarray) -> None:
    """Refuse to time what computes something else."""
    apart = disagreement(theta, solution(phi, y))
    if not apart < AGREES[str(phi.dtype)]:
        raise ArithmeticError(f"{name}, n = {phi.shape[1]}: theta differs by {apart:.1e}")


def cpp(source: str, phi: np.ndarray, y: np.ndarray) -> list[Side]:
    """Each variant of a peer in C++ with each set of flags, as rivals."""
    sides = []
    for name, made in filters(source, phi, y, LAMBDA, P0).items():
        if "default" in name:
            continue  # another rule
        made.reset()
        made.run()
        check(f"{source}, {name}", made.theta, phi, y)
        sides.append(Side(name, made.run, made.reset, group=source))
    return sides


def measure(n: int, seconds: float) -> list[Side]:
    """All sides at one size."""
    phi, y = record(n, "float64")
    sides = [
        ours(phi, y, ["error"], "error only"),
        ours(phi, y, None, "default outputs"),
        ours(*record(n, "float32"), ["error"], "float32"),
    ]
    for source in ("eigen", "dlib"):
        try:
            sides += cpp(source, phi, y)
        except NotAvailable as missing:
            sides.append(Side(str(missing), lambda: None, group=f"{source} missing"))
    race(sides, seconds)
    return sides


def report(seconds: float) -> Iterator[str]:
    """Markdown."""
    native.build()
    rows = []
    for n in SIZES:
        sides = measure(n, seconds)
        samples = len(record(n, "float64")[1])
        mine, whole, single, *_ = (side.least / samples * 1e9 for side in sides)
        row = [str(n), f"{mine:.1f}", f"{whole:.1f}", f"{single:.1f}"]
        for source in ("eigen", "dlib"):
            best = best_of(sides, source)
            if best is None:
                row += ["not available"] * 2
                continue
            theirs = best.least / samples * 1e9
            row += [f"{theirs:.1f} ({best.name})", f"{theirs / mine:.2f}"]
        rows.append(row)
    yield table(
        [
            "n",
            "error only",
            "default outputs",
            "float32",
            "Eigen",
            "Eigen/ours",
            "dlib",
            "dlib/ours",
        ],
        rows,
    )
