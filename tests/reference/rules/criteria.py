"""When a covariance is reset. Each criterion sees step k before its data and answers met or not.

period               k > 0 and k mod ``period`` == 0 (k counts used samples from 0)
trace                tr(P_k) < ``threshold``
smallest_eigenvalue  lambda_min(P_k) < ``threshold``  (P_k - threshold I is not >= 0)
change               a one-sided CUSUM of the normalised innovation, free of the noise scale:
                     u = tr(e^T (I + S)^-1 e) / (p targets);  v: its running mean, over all samples
                     at first, then exponential with ``memory``. At step k:
                       if k >= memory: g <- max(0, g + (u/v if v > 0 else 1) - 1 - drift);
                                       met iff g > threshold, and then g <- 0
                       v <- v + (u - v) / min(k + 1, memory)
                     with g = v = 0 at the start; the first ``memory`` samples only learn v.
"""

from __future__ import annotations

from ..eigen import eigen_symmetric
from ..linalg import Real, identity, inverse, trace, transpose
from ..step import Step


class Period:
    def __init__(self, period: int) -> None:
        self.period = period

    def met(self, step: Step) -> bool:
        return step.k > 0 and step.k % self.period == 0


class Trace:
    def __init__(self, threshold: float) -> None:
        self.threshold = Real(threshold)

    def met(self, step: Step) -> bool:
        return bool(trace(step.own) < self.threshold)


class SmallestEigenvalue:
    def __init__(self, threshold: float) -> None:
        self.threshold = Real(threshold)

    def met(self, step: Step) -> bool:
        return bool(eigen_symmetric(step.own)[0][-1] < self.threshold)


class Change:
    def __init__(self, threshold: float, drift: float, memory: int) -> None:
        self.threshold, self.drift, self.memory = Real(threshold), Real(drift), memory
        self.sum, self.mean = Real(0), Real(0)

    def met(self, step: Step) -> bool:
        weight = inverse(identity(step.rows) + step.spread)
        u = trace(transpose(step.error) * weight * step.error) / (step.rows * step.targets)
        alarm = False
        if step.k >= self.memory:
            ratio = u / self.mean if self.mean > 0 else Real(1)
            raised = (self.sum + ratio - 1 - self.drift).mid()
            self.sum = raised if raised > 0 else Real(0)
            alarm = bool(self.sum > self.threshold)
            if alarm:
                self.sum = Real(0)
        self.mean = (self.mean + (u - self.mean) / min(step.k + 1, self.memory)).mid()
        return alarm


CRITERIA = {
    "period": Period,
    "trace": Trace,
    "smallest_eigenvalue": SmallestEigenvalue,
    "change": Change,
}
