"""A rule, a rate and a weighting run over a record by Theorem 1, dense, in 256 bits."""

from __future__ import annotations

import numpy as np

from .cost import Cost
from .gf_rls import Measurement, theorem_1
from .linalg import Matrix, Real, cholesky, inverse, matrix, symmetric_parameter
from .rates.constant import Rate as ConstantRate
from .step import Rule, Step


class Estimator:
    """The dense recursion, with the cost (4) kept beside it.

    ``whitened`` lists (phi, y, factor) of every used sample in whitened units: the input of the
    published forms, which are printed for Gamma = I.
    """

    def __init__(
        self,
        parameters: int,
        rule: Rule,
        rate: object | None = None,
        weighting: object | None = None,
        targets: int = 1,
        initial_covariance: object = 100.0,
        initial_theta: np.ndarray | None = None,
    ) -> None:
        start = np.zeros((parameters, targets)) if initial_theta is None else initial_theta
        self.theta = matrix(np.reshape(start, (parameters, targets)))
        self.inverted = symmetric_parameter(initial_covariance, parameters)
        self.information = inverse(self.inverted)
        self.rule, self.rate, self.weighting = rule, rate or ConstantRate(1.0), weighting
        self.cost = Cost(self.theta, self.inverted)
        self.k = 0
        self.factor = Real(1)
        self.skipped = False
        self.forgotten: Matrix | None = None
        self.whitened: list[tuple[Matrix, Matrix, Real]] = []

    @property
    def covariance(self) -> Matrix:
        """The algorithm's own P."""
        return self.rule.own_covariance(self.information, self.inverted)

    def update(self, phi: np.ndarray, y: np.ndarray, gamma: np.ndarray | None = None) -> None:
        """phi (p, n), y (p, targets), gamma (p, p) positive definite or None for I."""
        phi, y = matrix(phi), matrix(y)
        if gamma is not None:
            root = cholesky(matrix(gamma))
            phi, y = root.solve(phi).mid(), root.solve(y).mid()
        clip = Real(1)
        if self.weighting is not None:
            clip = self.weighting.weight((y - phi * self.theta).mid())
            phi, y = (phi * clip.sqrt()).mid(), (y * clip.sqrt()).mid()
        error = (y - phi * self.theta).mid()
        own = self.covariance
        step = Step(self.k, self.information, self.inverted, own, phi, error, Real(1))
        self.skipped = self.rule.skips(step)
        if self.skipped:
            return
        # A rate sees the clipped error (weight * e) and phi without the weight.
        seen = Step(
            self.k,
            step.information,
            step.covariance,
            step.own,
            (phi / clip.sqrt()).mid(),
            (error * clip.sqrt()).mid(),
            Real(1),
        )
        step.factor = seen.factor = self.factor = self.rate.factor(seen)
        self._advance(step, y)
        self.rate.after(seen, self.covariance)

    def _advance(self, step: Step, y: Matrix) -> None:
        measured: Measurement = self.rule.measurement(step, y)
        self.forgotten = self.rule.forgetting(step)
        self.whitened.append((step.phi, y, step.factor))
        self.cost.add(measured, self.forgotten, self.theta)
        self.information, self.inverted, self.theta = theorem_1(
            self.information, self.theta, self.forgotten, measured
        )
        self.rule.after(step, self.inverted)
        self.k += 1
