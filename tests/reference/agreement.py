"""Runs a rule three ways over one record: dense (Theorem 1), published form, minimiser of (4)."""

from __future__ import annotations

from dataclasses import dataclass
from types import ModuleType

from .estimator import Estimator
from .linalg import Matrix, difference, inverse, matrix, symmetric_parameter
from .signals import Record


@dataclass
class Agreement:
    """Largest relative differences over the checkpoints."""

    theta: float = 0.0
    covariance: float = 0.0
    minimiser: float = 0.0
    curvature: float = 0.0

    def worst(self) -> float:
        return max(self.theta, self.covariance, self.minimiser, self.curvature)


def compare(
    module: ModuleType,
    parameters: dict[str, object],
    record: Record,
    rate: object,
    initial_covariance: object = 100.0,
    every: int = 20,
) -> Agreement:
    """Dense recursion against the published form and the minimiser, every few samples."""
    n, targets = record.phi.shape[2], record.y.shape[2]
    dense = Estimator(n, module.Dense(n, **parameters), rate, None, targets, initial_covariance)
    start = symmetric_parameter(initial_covariance, n)
    published = module.Published(Matrix(n, targets), start, **parameters)
    result = Agreement()
    for k in range(len(record.phi)):
        gamma = None if record.gamma is None else record.gamma[k]
        dense.update(record.phi[k], record.y[k], gamma)
        if not dense.skipped:
            published.update(*dense.whitened[-1])
        else:
            skipped_update(published, dense, record, k)
        if k % every == every - 1:
            _check(result, dense, published)
    return result


def skipped_update(published: object, dense: Estimator, record: Record, k: int) -> None:
    """A skipped sample must leave the published form alone, too: feed it and let it decide."""
    if record.gamma is None:
        published.update(matrix(record.phi[k]), matrix(record.y[k]), dense.factor)


def _check(result: Agreement, dense: Estimator, published: object) -> None:
    covariance = dense.covariance
    pairs = {
        "theta": (dense.theta, published.theta),
        "covariance": (covariance, published.covariance),
        "minimiser": (dense.theta, dense.cost.minimiser()),
        "curvature": (inverse(dense.information), inverse(dense.cost.hessian)),
    }
    for name, (a, b) in pairs.items():
        setattr(result, name, max(getattr(result, name), difference(a, b)))
