"""Simulated systems with coloured noise, and batch estimates that know nothing of this package."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.optimize import least_squares
from scipy.signal import lfilter


@dataclass(frozen=True)
class System:
    """A y = B/F u(k-1) + C/D e; a, d and f with the sign of poles, c as in 1 + c1 q^-1."""

    a: tuple[float, ...] = ()
    b: tuple[float, ...] = ()
    c: tuple[float, ...] = ()
    d: tuple[float, ...] = ()
    f: tuple[float, ...] = ()

    @property
    def theta(self):
        return np.array([*self.a, *self.b, *self.c, *self.d, *self.f])

    def with_theta(self, theta):
        ends = np.cumsum([len(part) for part in (self.a, self.b, self.c, self.d, self.f)])
        return System(*(tuple(part) for part in np.split(theta, ends[:-1])))

    def response(self, u):
        delayed = np.r_[0.0, u[:-1]]
        return lfilter(self.b or [0.0], np.r_[1.0, -np.array(self.f)], delayed)

    def simulate(self, u, e):
        v = lfilter(np.r_[1.0, self.c], np.r_[1.0, -np.array(self.d)], e)
        return lfilter([1.0], np.r_[1.0, -np.array(self.a)], self.response(u) + v)

    def errors(self, u, y):
        v = lfilter(np.r_[1.0, -np.array(self.a)], [1.0], y) - self.response(u)
        return lfilter(np.r_[1.0, -np.array(self.d)], np.r_[1.0, self.c], v)


SYSTEMS = {
    "arma": System(a=(0.9,), c=(-0.5,)),
    "armax": System(a=(1.5, -0.7), b=(1.0, 0.5), c=(-0.9, 0.3)),
    "oe": System(b=(1.0, 0.5), f=(1.5, -0.7)),
    "bj": System(b=(1.0, 0.5), c=(0.5,), d=(0.9,), f=(1.5, -0.7)),
}


def record(system, seed, samples=3000):
    """Input, output."""
    u, e = np.random.default_rng(seed).normal(size=(2, samples))
    return (u if system.b else None), system.simulate(u if system.b else 0.0 * u, e)


def batch(system, u, y):
    """The least-squares prediction-error estimate, begun at the truth."""
    u = np.zeros_like(y) if u is None else u

    def errors(theta):
        with np.errstate(all="ignore"):
            return np.nan_to_num(
                system.with_theta(theta).errors(u, y), nan=1e6, posinf=1e6, neginf=-1e6
            )

    return least_squares(errors, system.theta).x
