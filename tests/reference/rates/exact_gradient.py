"""Adaptive memory (Haykin): the exact gradient of |e|^2 / 2 under exponential forgetting, followed
for every rule. For the next sample.

With psi = d theta / d lambda (n x targets), Z = d P / d lambda (n x n), both 0 at the start; at
sample k, l = lambda_k (the factor used), P = P_{k+1}, M = I - P phi^T phi:
    lambda_{k+1} = clip(l + step_size tr(psi^T phi^T e) / targets),   lambda_0 = largest
    Z <- (M Z M^T - P + P phi^T phi P) / l
    psi <- M psi + Z phi^T e                                     (the new Z, the a-priori e)
lambda_{k+1} takes psi before its update. The recursions are exact for a constant lambda and the
rule ``exponential`` (checked against finite differences); for other rules they are the same ones.
"""

from __future__ import annotations

from ..linalg import Matrix, Real, identity, symmetric, trace, transpose
from ..step import Step
from .clip import ClippedRate


class Rate(ClippedRate):
    def __init__(self, step_size: float, smallest: float, largest: float) -> None:
        super().__init__(smallest, largest)
        self.step_size, self.next = Real(step_size), self.largest
        self.theta_slope: Matrix | None = None
        self.covariance_slope: Matrix | None = None

    def factor(self, step: Step) -> Real:
        return self.next

    def after(self, step: Step, covariance: Matrix) -> None:
        if self.theta_slope is None or self.covariance_slope is None:
            self.theta_slope = Matrix(step.parameters, step.targets)
            self.covariance_slope = Matrix(step.parameters, step.parameters)
        pull = (transpose(step.phi) * step.error).mid()
        ascent = trace(transpose(self.theta_slope) * pull) / step.targets
        used = self.next
        self.next = self.clip(used + self.step_size * ascent)
        reach = covariance * transpose(step.phi)
        shrink = (identity(step.parameters) - reach * step.phi).mid()
        slope = shrink * self.covariance_slope * transpose(shrink)
        slope = (slope - covariance + reach * transpose(reach)) / used
        self.covariance_slope = symmetric(slope)
        self.theta_slope = (shrink * self.theta_slope + self.covariance_slope * pull).mid()


CASES = [
    {"step_size": 1e-3, "smallest": 0.8, "largest": 0.999},
    {"step_size": 1e-2, "smallest": 0.9, "largest": 0.98},
]
