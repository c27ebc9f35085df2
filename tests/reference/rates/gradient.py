"""Leung & So (2005), GVFF-RLS: gradient of the modelled mean square error. Uses this sample.

With e2 = |e|^2 / p and l = lambda_{k-1} (lambda_{-1} = largest), at sample k:
    E, V <- averages of e2, fast (K_a) and slow (K_b), as A and B in ``noise_power``
    r' = r,  t' = 2 l t                      (d/d lambda of the next line, old r and t)
    r <- 1 + l r,  t <- 1 + l^2 t            (r = t = 0 at the start)
    D = (n + 1) t + r^2,   D' = (n + 1) t' + 2 r r'
    zeta = 1 - 2/r + (n + 2)/D,     zeta' = 2 r'/r^2 - (n + 2) D'/D^2
    h = 2/r - 2/D,                  h'    = -2 r'/r^2 + 2 D'/D^2
    g <- zeta g + zeta' E + h' V             (g = 0 at the start)
    lambda_k = clip(l - step_size g / (1 - l))
The model is J_k = zeta J_{k-1} + h V. The sign of 2/D in h is minus: only then is J = V (1 + n/k)
without forgetting. ``short_memory`` = K_a, ``long_memory`` = K_b, ``largest`` < 1. The original's
second, moving lower clip is left out: ``smallest`` does its work.
"""

from __future__ import annotations

from ..linalg import Real
from ..step import Step
from .clip import ClippedRate
from .noise_power import Averages


class Model:
    """zeta, h and their derivatives with respect to lambda, one sample after the other."""

    def __init__(self, n: int) -> None:
        self.n, self.r, self.t = n, Real(0), Real(0)

    def advance(self, factor: Real) -> tuple[Real, Real, Real, Real]:
        n = self.n
        dr, dt = self.r, 2 * factor * self.t
        r = self.r = (1 + factor * self.r).mid()
        self.t = (1 + factor**2 * self.t).mid()
        d = (n + 1) * self.t + r**2
        dd = (n + 1) * dt + 2 * r * dr
        zeta, h = 1 - 2 / r + (n + 2) / d, 2 / r - 2 / d
        turn = 2 * dr / r**2
        return zeta, h, turn - (n + 2) * dd / d**2, -turn + 2 * dd / d**2


class Rate(ClippedRate):
    def __init__(
        self,
        step_size: float,
        short_memory: float,
        long_memory: float,
        smallest: float,
        largest: float,
    ) -> None:
        super().__init__(smallest, largest)
        self.step_size = Real(step_size)
        self.errors = Averages(short_memory, long_memory)
        self.model: Model | None = None
        self.gradient, self.value = Real(0), self.largest

    def factor(self, step: Step) -> Real:
        self.model = self.model or Model(step.parameters)
        self.errors.add((step.square / step.rows).mid(), step.parameters)
        zeta, _, dzeta, dh = self.model.advance(self.value)
        pull = dzeta * self.errors.fast + dh * self.errors.slow
        self.gradient = (zeta * self.gradient + pull).mid()
        self.value = self.clip(self.value - self.step_size * self.gradient / (1 - self.value))
        return self.value


CASES = [
    {"step_size": 1e-3, "short_memory": 1.0, "long_memory": 10.0, "smallest": 0.8, "largest": 0.99},
    {"step_size": 1e-2, "short_memory": 1.0, "long_memory": 5.0, "smallest": 0.9, "largest": 0.98},
]
