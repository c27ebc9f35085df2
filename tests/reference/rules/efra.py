"""Exponential forgetting and resetting algorithm, EFRA (Salgado, Goodwin & Middleton 1988).

With a = ``gain``, b = ``increase``, d = ``saturation``, lambda = lambda_k:
    published: K = a P phi^T (I + S)^-1, theta_{k+1} = theta + K e,
               P_{k+1} = P / lambda - K phi P + b I - d P^2           (printed for one row)

Embedded (E1): the measurement is standard with Gamma_k = I/a + (1/a - 1) S, and afterwards
    Psi(P+) = P+ + W,  W = sum_i max(0, g p_i + b - d p_i^2) v_i v_i^T,  g = (1 - lambda)/lambda,
(p_i, v_i) the eigenpairs of P_k (before the data). The published map has no max; the two agree
while P_k <= sigma_max I, sigma_max = (g/2d)(1 + sqrt(1 + 4 b d / g^2)), which P_0 <= sigma_max I
and a constant lambda guarantee when g^2 + 4 b d <= 1. The max keeps P_{k+1} >= P+ > 0 (and the rule
proper) for a varying lambda. Rows p > 1 by the same formulas (derived). Silence: P -> sigma_max I.

With the cyclic ``schedule`` (derived) sample k forgets before it measures, along axis i = k mod n,
what n samples of silence would add to P_ii alone:
    Pbar = P + (p_n - P_ii) e_i e_i^T,  p_0 = P_ii,  p_{j+1} = p_j + max(0, g p_j + b - d p_j^2),
then measures with the same Gamma_k, S = phi Pbar phi^T: K = a Pbar phi^T (I + S)^-1 again.
"""

from __future__ import annotations

from ..eigen import eigen_symmetric
from ..gf_rls import Measurement
from ..linalg import Matrix, Real, diagonal, identity, inverse, symmetric, transpose
from ..step import MeasureThenForget, Rule, Step
from .form import PublishedForm
from .form import gain as kalman_gain

RATED = True


class Map:
    """a, b and d, and what one sample adds to a variance."""

    def __init__(self, gain: float, increase: float, saturation: float) -> None:
        self.gain, self.increase, self.saturation = Real(gain), Real(increase), Real(saturation)

    def added(self, p: Real, factor: Real) -> Real:
        growth = (1 - factor) / factor
        x = growth * p + self.increase - self.saturation * p * p
        return x if x > 0 else Real(0)

    def gamma(self, spread: Matrix) -> Matrix:
        return (identity(spread.nrows()) / self.gain + (1 / self.gain - 1) * spread).mid()

    def wider(self, p: Matrix, factor: Real, k: int) -> Matrix:
        """Pbar of the cyclic schedule."""
        n, i = p.nrows(), k % p.nrows()
        variance = p[i, i]
        for _ in range(n):
            variance = (variance + self.added(variance, factor)).mid()
        added = [variance - p[i, i] if j == i else Real(0) for j in range(n)]
        return symmetric(p + diagonal(added))


class EverySample(MeasureThenForget):
    def __init__(self, n: int, **parameters: float) -> None:
        super().__init__(n)
        self.map = Map(**parameters)

    def measurement(self, step: Step, y: Matrix) -> Measurement:
        return Measurement(step.phi, y, self.map.gamma(step.spread))

    def after(self, step: Step, covariance: Matrix) -> None:
        values, vectors = eigen_symmetric(step.own)
        added = [self.map.added(p, step.factor) for p in values]
        wider = covariance + vectors * diagonal(added) * transpose(vectors)
        self.pending = (inverse(covariance) - inverse(wider)).mid()


class Cyclic(Rule):
    def __init__(self, **parameters: float) -> None:
        self.map = Map(**parameters)

    def measurement(self, step: Step, y: Matrix) -> Measurement:
        p = step.covariance
        if step.forgets:
            p = self.map.wider(p, step.factor, step.k)
        return Measurement(step.phi, y, self.map.gamma((step.phi * p * transpose(step.phi)).mid()))

    def forgetting(self, step: Step) -> Matrix:
        wider = self.map.wider(step.covariance, step.factor, step.k)
        return (step.information - inverse(wider)).mid()


def Dense(n: int, schedule: str = "every_sample", **parameters: float) -> Rule:
    """The rule with this schedule."""
    return EverySample(n, **parameters) if schedule == "every_sample" else Cyclic(**parameters)


class Published(PublishedForm):
    def __init__(
        self,
        theta: Matrix,
        covariance: Matrix,
        schedule: str = "every_sample",
        **parameters: float,
    ) -> None:
        super().__init__(theta, covariance)
        self.map, self.k = Map(**parameters), 0
        self.update_covariance = self.printed if schedule == "every_sample" else self.cyclic

    def update(self, phi: Matrix, y: Matrix, factor: Real) -> None:
        k = self.update_covariance(phi, factor)
        self.theta = (self.theta + k * (y - phi * self.theta)).mid()
        self.k += 1

    def printed(self, phi: Matrix, factor: Real) -> Matrix:
        p = self.covariance
        k = self.map.gain * kalman_gain(p, phi)
        reset = self.map.increase * identity(p.nrows()) - self.map.saturation * p * p
        self.covariance = symmetric(p / factor - k * phi * p + reset)
        return k

    def cyclic(self, phi: Matrix, factor: Real) -> Matrix:
        p = self.map.wider(self.covariance, factor, self.k)
        k = self.map.gain * kalman_gain(p, phi)
        self.covariance = symmetric(p - k * phi * p)
        return k


def cases(n: int) -> list[dict[str, object]]:
    """sigma_max for lambda = 0.98: 204 and 101."""
    some: list[dict[str, object]] = [
        {"gain": 0.5, "increase": 5e-3, "saturation": 1e-4},
        {"gain": 1.0, "increase": 1e-2, "saturation": 2.03e-4},
    ]
    return some + [{**case, "schedule": "cyclic"} for case in some]
