"""Times eigen-decomposition and oblique-projection forgetting against NumPy.

    python benchmarks/variable_direction.py [--quick]

`variable_direction` in `RLS.run` against the same step with `numpy.linalg.eigh` of the propagated
R, and `oblique_projection` against the formulas of Zhu, Yu & Wan (2022), (17)-(23), with
`numpy.linalg.inv` and `pinv`. Both sides run on one thread, in turns; each time is the least of
five turns, processor time a sample. Prints the times, their ratio and the largest difference of
theta: with distinct prior variances, so that no eigenvectors are left to the solver, it is
rounding.
"""

from __future__ import annotations

import os

for variable in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(variable, "1")

import sys
import time
from collections.abc import Callable

import numpy as np

import forgetting as fg

LAMBDA = 0.98
THRESHOLD = 1e-6
TURNS = 5

Array = np.ndarray
Run = Callable[[Array, Array], Array]


def prior(n: int) -> Array:
    """Distinct variances around 100."""
    return np.linspace(50.0, 150.0, n)


def eigh_step(phi_all: Array, y_all: Array) -> Array:
    """(64)-(71) of the tutorial, R propagated, one eigh a sample."""
    n = phi_all.shape[2]
    theta, information = np.zeros(n), np.diag(1 / prior(n))
    for phi, y in zip(phi_all, y_all, strict=True):
        values, vectors = np.linalg.eigh(information)
        psi = phi @ vectors
        kept = np.where(np.sqrt((psi * psi).sum(axis=0)) > THRESHOLD, LAMBDA, 1.0) * values
        widened = (vectors / kept) @ vectors.T
        cross = widened @ phi.T
        gain = cross @ np.linalg.inv(np.eye(len(phi)) + phi @ cross)
        theta = theta + gain @ (y - phi @ theta)
        information = (vectors * kept) @ vectors.T + phi.T @ phi
    return theta


def oblique_step(phi_all: Array, y_all: Array) -> Array:
    """(17)-(23) of Zhu, Yu & Wan with a constant factor; R is inverted at every sample."""
    n = phi_all.shape[2]
    theta, information = np.zeros(n), np.diag(1 / prior(n))
    for phi, y in zip(phi_all, y_all, strict=True):
        cross = information @ phi.T
        lost = cross @ np.linalg.pinv(phi @ cross) @ cross.T
        information = information - (1 - LAMBDA) * lost + phi.T @ phi
        theta = theta + np.linalg.inv(information) @ phi.T @ (y - phi @ theta)
    return theta


def ours(rule: fg.Rule, n: int, p: int) -> Run:
    def run(phi: Array, y: Array) -> Array:
        est = fg.RLS(n, rule=rule, rows=p, initial_covariance=prior(n))
        est.run(phi, y, outputs=())
        return np.asarray(est.theta)

    return run


def compare(name: str, mine: Run, numpy_form: Run, n: int, p: int, samples: int) -> None:
    rng = np.random.default_rng(n * 10 + p)
    phi = rng.standard_normal((samples, p, n))
    y = phi @ rng.standard_normal(n) + 0.1 * rng.standard_normal((samples, p))
    best = [np.inf, np.inf]
    for _ in range(TURNS):
        for i, run in enumerate((mine, numpy_form)):
            start = time.thread_time()
            run(phi, y)
            best[i] = min(best[i], (time.thread_time() - start) / samples)
    difference = np.abs(mine(phi, y) - numpy_form(phi, y)).max()
    print(
        f"{name:20} n={n:3} p={p}  {best[0] * 1e6:8.2f} us  NumPy {best[1] * 1e6:8.2f} us  "
        f"{best[1] / best[0]:6.1f} times  difference {difference:.1e}",
        flush=True,
    )


def main() -> None:
    quick = "--quick" in sys.argv
    names = {entry["name"] for entry in fg.rules()}
    for n in (6, 10, 32, 64):
        for p in (1, 2):
            samples = 300 if quick else 20_000 // n
            rule = fg.rule("variable_direction", forgetting_factor=LAMBDA, threshold=THRESHOLD)
            compare("variable_direction", ours(rule, n, p), eigh_step, n, p, samples)
    if "oblique_projection" in names:
        rule = fg.rule("oblique_projection", forgetting_factor=LAMBDA)
        samples = 300 if quick else 1000
        compare("oblique_projection", ours(rule, 64, 2), oblique_step, 64, 2, samples)


if __name__ == "__main__":
    main()
