"""One record through every rule of the registry, in the terms of Theorem 1.

The covariance that an estimator shows is the P_k of Theorem 1 for every rule: those that measure
first and forget afterwards show P after the data and forget when the next sample comes, which is
the trick of (71)-(73). So F_k can be read off: F_k = P_k⁻¹ − P_{k+1}⁻¹ + φ_kᵀΓ_k⁻¹φ_k (9).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

import forgetting as fg
from forgetting.analysis import Trajectory

from ..path import Path, follow

Array = NDArray[Any]

FACTOR, START = 0.95, 100.0
"""λ of every rule that takes one, and P_0 = START · I, the package's own default."""
NAMES = tuple(about["name"] for about in fg.rules())
ABOUT = {about["name"]: about for about in fg.rules()}


def make(name: str, **parameters: Any) -> fg.Rule:
    """The rule with its defaults and λ = 0.95, but for `parameters`; `custom` is exponential."""
    if ABOUT[name]["forgetting_factor"]:
        parameters.setdefault("forgetting_factor", FACTOR)
    if name == "custom":
        parameters.setdefault("forgetting_matrix", lambda r, phi, error: (1 - FACTOR) * r)
    return fg.rule(name, **parameters)


@dataclass(frozen=True, eq=False)
class Course:
    """A record, the path of a rule through it, and both in the terms of Theorem 1.

    Attributes
    ----------
    phi, y : (T, n), (T,)
    path : Path
    weight : (T,)
        Γ_k⁻¹, zero where the rule left the sample out.
    """

    phi: Array
    y: Array
    path: Path
    weight: Array

    @property
    def measured(self) -> Array:
        """φ_kᵀΓ_k⁻¹φ_k, (T, n, n)."""
        return np.asarray(np.einsum("t,ti,tj->tij", self.weight, self.phi, self.phi))

    @property
    def forgetting(self) -> Array:
        """F_0 ... F_{T-1}, (T, n, n)."""
        information = self.path.information
        return np.asarray(information[:-1] + self.measured - information[1:])

    @property
    def trajectory(self) -> Trajectory:
        """For `forgetting.analysis`, which finds P̄ from P and the weighted φ."""
        phi = np.sqrt(self.weight)[:, np.newaxis] * self.phi
        return Trajectory.from_arrays(phi, self.path.covariance)


def course(rule: fg.Rule, phi: Array, y: Array, start: ArrayLike = START) -> Course:
    """Run a rule over a record, one row a sample."""
    path = follow(rule, phi, y, initial_covariance=start)
    return Course(phi, y, path, _weight(rule, phi, path))


def _weight(rule: fg.Rule, phi: Array, path: Path) -> Array:
    """Γ_k⁻¹: 1 but for the two rules that choose it."""
    weight = np.ones(len(phi))
    if rule.name == "data_dependent":
        weight = 1 - path.factor  # μ_k of (45), (46)
    if rule.name == "efra":
        # Γ = 1/a + (1/a − 1) s, and s₊ = φP₊φᵀ = s − a s²/(1 + s).
        a, after = rule.parameters["gain"], np.einsum("ti,tij,tj->t", phi, path.covariance[1:], phi)
        root = np.sqrt((1 - after) ** 2 + 4 * (1 - a) * after)
        weight = 1 / (1 / a + (after - 1 + root) / (2 * a))
    return np.asarray(np.where(path.used, weight, 0.0))


@lru_cache(maxsize=4)
def data(kind: str, samples: int = 550, n: int = 3) -> tuple[Array, Array, Array]:
    """φ, y and θ without noise: "excited" is white; "silent" is that for a fifth of the record,
    and only along one direction from there on."""
    rng = np.random.default_rng(12)
    phi, theta = rng.standard_normal((samples, n)), np.arange(1.0, n + 1)
    if kind == "silent":
        late = np.arange(samples) >= samples // 5
        phi[late] = phi[late, :1] * np.ones(n)
    return phi, phi @ theta, theta
