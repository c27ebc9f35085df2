"""Eigen-decomposition and oblique-projection forgetting beside the same step in NumPy.

`variable_direction` in `RLS.run` against the same step with `numpy.linalg.eigh` of the propagated
R, and `oblique_projection` against the formulas of Zhu, Yu & Wan (2022), (17)-(23), with
`numpy.linalg.inv` and `pinv`. With distinct prior variances, so that no eigenvectors are left to
the solver, the largest difference of theta is rounding.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np

import forgetting as fg

from .ledger import Ledger
from .markdown import table
from .plan import Plan
from .timing import Side, race

LAMBDA = 0.98
THRESHOLD = 1e-6

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


def ours(rule: fg.Rule) -> Run:
    """`RLS.run`."""

    def run(phi: Array, y: Array) -> Array:
        _, p, n = phi.shape
        est = fg.RLS(n, rule=rule, rows=p, initial_covariance=prior(n))
        est.run(phi, y, outputs=())
        return np.asarray(est.theta)

    return run


def row(rule: fg.Rule, numpy_form: Run, size: tuple[int, int], plan: Plan) -> list[str]:
    """One rule at one size."""
    n, p = size
    samples = 300 if plan.quick else max(300, 20_000 // n)
    rng = np.random.default_rng(n * 10 + p)
    phi = rng.standard_normal((samples, p, n))
    y = phi @ rng.standard_normal(n) + 0.1 * rng.standard_normal((samples, p))
    mine = Side("ours", lambda: ours(rule)(phi, y), each=samples)
    theirs = Side("NumPy", lambda: numpy_form(phi, y), each=samples)
    race([mine, theirs], plan.seconds / 4)
    apart = np.abs(ours(rule)(phi, y) - numpy_form(phi, y)).max()
    times = [f"{side.nanoseconds / 1e3:.2f}" for side in (mine, theirs)]
    return [str(n), str(p), *times, f"{theirs.least / mine.least:.1f}", f"{apart:.1e}"]


def report(plan: Plan, ledger: Ledger) -> Iterator[str]:
    """Markdown."""
    variable = fg.rule("variable_direction", forgetting_factor=LAMBDA, threshold=THRESHOLD)
    oblique = fg.rule("oblique_projection", forgetting_factor=LAMBDA)
    rows = [
        ["variable_direction", *row(variable, eigh_step, (n, p), plan)]
        for n in (6, 10, 32, 64)
        for p in (1, 2)
    ]
    rows.append(["oblique_projection", *row(oblique, oblique_step, (64, 2), plan)])
    yield table(["rule", "n", "p", "µs", "NumPy, µs", "NumPy/ours", "difference of theta"], rows)
