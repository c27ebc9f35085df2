"""Paleologu, Benesty & Ciochina (2008), VFF-RLS: noise power from averages. For the next
sample.

With e2 = |e|^2 / p, q = tr(S) / p, and the steps a = max(1/(K_a n), 1/m), b = max(1/(K_b n), 1/m)
at the m-th sample (m = 1, 2, ...):
    A <- A + a (e2 - A)    (sigma_e^2)            B <- B + b (e2 - B)   (sigma_v^2)
    Q <- Q + a (q^2 - Q)   (sigma_q^2)
    lambda_{k+1} = clip(largest if sqrt A <= gamma sqrt B
                        else sqrt Q sqrt B / (xi + |sqrt A - sqrt B|)),   lambda_0 = largest
``short_memory`` = K_a >= 1, ``long_memory`` = K_b > K_a, ``ratio`` = gamma, ``floor`` = xi. One
row is the published algorithm once m > K_b n; it leaves the first values open, and a plain mean at
the start forgets the errors of an arbitrary theta_0 soonest. The lower clip is ours.
"""

from __future__ import annotations

from ..linalg import Matrix, Real, trace
from ..step import Step
from .clip import ClippedRate


class Averages:
    """A fast and a slow average: the plain mean at first, then exponential."""

    def __init__(self, short_memory: float, long_memory: float) -> None:
        self.short, self.long = Real(short_memory), Real(long_memory)
        self.fast, self.slow, self.count = Real(0), Real(0), 0

    def add(self, value: Real, n: int) -> None:
        self.count += 1
        short, long = min(self.short * n, self.count), min(self.long * n, self.count)
        self.fast = (self.fast + (value - self.fast) / short).mid()
        self.slow = (self.slow + (value - self.slow) / long).mid()


class Rate(ClippedRate):
    def __init__(
        self,
        short_memory: float,
        long_memory: float,
        ratio: float,
        floor: float,
        smallest: float,
        largest: float,
    ) -> None:
        super().__init__(smallest, largest)
        self.errors = Averages(short_memory, long_memory)
        self.spreads = Averages(short_memory, long_memory)
        self.ratio, self.floor, self.next = Real(ratio), Real(floor), self.largest

    def factor(self, step: Step) -> Real:
        return self.next

    def after(self, step: Step, covariance: Matrix) -> None:
        n, p = step.parameters, step.rows
        self.errors.add((step.square / p).mid(), n)
        self.spreads.add(((trace(step.spread) / p) ** 2).mid(), n)
        fast, slow = self.errors.fast.sqrt(), self.errors.slow.sqrt()
        self.next = self.largest
        if fast > self.ratio * slow:
            spread = self.spreads.fast.sqrt()
            self.next = self.clip(spread * slow / (self.floor + abs(fast - slow)))


CASES = [
    {
        "short_memory": 2.0,
        "long_memory": 10.0,
        "ratio": 1.1,
        "floor": 1e-8,
        "smallest": 0.8,
        "largest": 0.999,
    },
    {
        "short_memory": 1.5,
        "long_memory": 4.0,
        "ratio": 1.0,
        "floor": 1e-8,
        "smallest": 0.5,
        "largest": 0.99,
    },
]
