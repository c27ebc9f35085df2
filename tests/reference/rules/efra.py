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
"""

from __future__ import annotations

from ..eigen import eigen_symmetric
from ..gf_rls import Measurement
from ..linalg import Matrix, Real, diagonal, identity, inverse, symmetric, transpose
from ..step import MeasureThenForget, Step
from .form import PublishedForm
from .form import gain as kalman_gain

RATED = True


class Dense(MeasureThenForget):
    def __init__(self, n: int, gain: float, increase: float, saturation: float) -> None:
        super().__init__(n)
        self.gain, self.increase, self.saturation = Real(gain), Real(increase), Real(saturation)

    def measurement(self, step: Step, y: Matrix) -> Measurement:
        gamma = identity(step.rows) / self.gain + (1 / self.gain - 1) * step.spread
        return Measurement(step.phi, y, gamma.mid())

    def after(self, step: Step, covariance: Matrix) -> None:
        growth = (1 - step.factor) / step.factor
        values, vectors = eigen_symmetric(step.own)
        added = [growth * p + self.increase - self.saturation * p * p for p in values]
        added = [x if x > 0 else Real(0) for x in added]
        wider = covariance + vectors * diagonal(added) * transpose(vectors)
        self.pending = (inverse(covariance) - inverse(wider)).mid()


class Published(PublishedForm):
    def __init__(
        self, theta: Matrix, covariance: Matrix, gain: float, increase: float, saturation: float
    ) -> None:
        super().__init__(theta, covariance)
        self.gain, self.increase, self.saturation = Real(gain), Real(increase), Real(saturation)

    def update(self, phi: Matrix, y: Matrix, factor: Real) -> None:
        p = self.covariance
        k = self.gain * kalman_gain(p, phi)
        self.theta = (self.theta + k * (y - phi * self.theta)).mid()
        reset = self.increase * identity(p.nrows()) - self.saturation * p * p
        self.covariance = symmetric(p / factor - k * phi * p + reset)


def cases(n: int) -> list[dict[str, object]]:
    """sigma_max for lambda = 0.98: 204 and 101."""
    return [
        {"gain": 0.5, "increase": 5e-3, "saturation": 1e-4},
        {"gain": 1.0, "increase": 1e-2, "saturation": 2.03e-4},
    ]
