"""Mohseni & Bernstein (2022): F-test on two moving error covariances. Uses this sample.

z = the whitened errors of one sample, all rows and targets as one vector of d = p targets numbers;
Sigma_n, Sigma_d = mean of z z^T over the last tau_n and tau_d samples (about zero: that has the
tau_n and tau_d degrees of freedom of the test), both including this sample.
    a = d tau_n,  B = (tau_n + tau_d - d - 1)(tau_d - 1) / ((tau_d - d - 3)(tau_d - d))
    b = 4 + (a + 2)/(B - 1),  c = a (b - 2) / (b (tau_d - d - 1))                (Lawley-Hotelling)
    g = sqrt((tau_n/tau_d) tr(Sigma_n Sigma_d^-1) / c) - sqrt(F^-1_{a,b}(1 - significance))
    lambda_k = clip(1 / (1 + eta max(0, g)))
For d = 1: a = tau_n, b = tau_d, and g = sqrt(ratio of the variances) - sqrt(F quantile). Needs
tau_d > d + 3. Until tau_d samples were seen, and when Sigma_d is singular: lambda = largest.
"""

from __future__ import annotations

from ..linalg import Matrix, Real, cholesky, inverse, trace, transpose
from ..step import Step
from .clip import ClippedRate

BISECTIONS = 260


def distribution(x: Real, a: Real, b: Real) -> Real:
    """CDF of the F law with a and b degrees of freedom."""
    return (a * x / (a * x + b)).beta_lower(a / 2, b / 2, regularized=True)


def quantile(probability: Real, a: Real, b: Real) -> Real:
    """Inverse of ``distribution`` by bisection."""
    low, high = Real(0), Real(1)
    while distribution(high, a, b) < probability:
        high = 2 * high
    for _ in range(BISECTIONS):
        middle = ((low + high) / 2).mid()
        if distribution(middle, a, b) < probability:
            low = middle
        else:
            high = middle
    return low


class Rate(ClippedRate):
    def __init__(
        self,
        sensitivity: float,
        short_window: int,
        long_window: int,
        significance: float,
        smallest: float,
        largest: float,
    ) -> None:
        super().__init__(smallest, largest)
        self.sensitivity, self.short, self.long = Real(sensitivity), short_window, long_window
        self.significance = Real(significance)
        self.errors: list[Matrix] = []
        self.scale: Real | None = None
        self.limit = Real(0)

    def _prepare(self, d: int) -> None:
        short, long = Real(self.short), Real(self.long)
        a = d * short
        base = (short + long - d - 1) * (long - 1) / ((long - d - 3) * (long - d))
        b = 4 + (a + 2) / (base - 1)
        c = a * (b - 2) / (b * (long - d - 1))
        self.scale = (short / long / c).mid()
        self.limit = quantile(1 - self.significance, a, b).sqrt().mid()

    def factor(self, step: Step) -> Real:
        z = Matrix([[x] for x in step.error.entries()])
        if self.scale is None:
            self._prepare(z.nrows())
        self.errors = [*self.errors, (z * transpose(z)).mid()][-self.long :]
        if len(self.errors) < self.long:
            return self.largest
        wide = _mean(self.errors)
        try:
            cholesky(wide)
        except ArithmeticError:
            return self.largest
        statistic = self.scale * trace(_mean(self.errors[-self.short :]) * inverse(wide))
        excess = statistic.sqrt() - self.limit
        return self.clip(1 / (1 + self.sensitivity * excess)) if excess > 0 else self.largest


def _mean(items: list[Matrix]) -> Matrix:
    total = items[0]
    for item in items[1:]:
        total = total + item
    return (total / len(items)).mid()


CASES = [
    {
        "sensitivity": 0.1,
        "short_window": 5,
        "long_window": 40,
        "significance": 0.3,
        "smallest": 0.8,
        "largest": 1.0,
    },
    {
        "sensitivity": 1.0,
        "short_window": 2,
        "long_window": 12,
        "significance": 0.6,
        "smallest": 0.9,
        "largest": 0.99,
    },
]
