"""Covariance resetting (Goodwin, Teoh & Elliott 1983) around any rule. GF-RLS V-F, (54)-(57).

    F = R_k - P_inf^-1 where the criterion is met, else the F of ``rule`` (0 for ``none``)

``covariance`` is P_inf (a scalar, (n,) or (n, n), positive definite); the criteria are defined in
``criteria.py`` and look at R_k^-1. At a reset nothing else is forgotten; whether the sample is
used, its measurement and what ``rule`` keeps of it are those with P_inf in the place of P. Proper
iff P_k <= P_inf at every reset (and ``rule`` is proper).
    published: P_{k+1}^-1 = P_inf^-1 + phi^T phi at a reset, P_k^-1 + phi^T phi otherwise (54)
"""

from __future__ import annotations

import importlib
from copy import copy
from dataclasses import replace

from ..gf_rls import Measurement
from ..linalg import Matrix, Real, inverse, symmetric_parameter
from ..step import Rule, Step
from .criteria import CRITERIA
from .form import PublishedForm

RATED = True


def _inner(rule: tuple[str, dict[str, object]]) -> object:
    return importlib.import_module(f".{rule[0]}", __package__)


class Dense(Rule):
    """``rule`` is (registry name, parameters)."""

    def __init__(
        self,
        n: int,
        criterion: str,
        covariance: object = 100.0,
        rule: tuple[str, dict[str, object]] = ("none", {}),
        **settings: object,
    ) -> None:
        self.inner: Rule = _inner(rule).Dense(n, **rule[1])
        self.single_row = self.inner.single_row
        self.criterion = CRITERIA[criterion](**settings)
        self.target = symmetric_parameter(covariance, n)
        self.reset = False

    def skips(self, step: Step) -> bool:
        criterion = copy(self.criterion)
        self.reset = criterion.met(replace(step, own=step.covariance))
        if self.inner.skips(self._inside(step)):
            return True
        self.criterion = criterion
        return False

    def _inside(self, step: Step) -> Step:
        if not self.reset:
            return step
        return replace(
            step,
            information=inverse(self.target),
            covariance=self.target,
            own=self.target,
            forgets=False,
        )

    def measurement(self, step: Step, y: Matrix) -> Measurement:
        return self.inner.measurement(self._inside(step), y)

    def forgetting(self, step: Step) -> Matrix:
        if self.reset:
            return (step.information - inverse(self.target)).mid()
        return self.inner.forgetting(step)

    def after(self, step: Step, covariance: Matrix) -> None:
        self.inner.after(self._inside(step), covariance)

    def own_covariance(self, information: Matrix, covariance: Matrix) -> Matrix:
        return self.inner.own_covariance(information, covariance)


class Published(PublishedForm):
    """The inner rule's published form, its covariance replaced when the criterion is met.

    At a reset the inner form runs with forgetting factor 1 (nothing else is forgotten).
    """

    def __init__(
        self,
        theta: Matrix,
        start: Matrix,
        criterion: str,
        covariance: object = 100.0,
        rule: tuple[str, dict[str, object]] = ("none", {}),
        **settings: object,
    ) -> None:
        self.module, self.parameters = _inner(rule), rule[1]
        self.target = symmetric_parameter(covariance, theta.nrows())
        self.form = self.module.Published(theta, start, **self.parameters)
        self.criterion, self.k = CRITERIA[criterion](**settings), 0

    @property
    def theta(self) -> Matrix:
        return self.form.theta

    @property
    def covariance(self) -> Matrix:
        return self.form.covariance

    def update(self, phi: Matrix, y: Matrix, factor: Real) -> None:
        p = self.form.covariance
        step = Step(self.k, inverse(p), p, p, phi, (y - phi * self.theta).mid(), factor)
        if self.module.Dense(phi.ncols(), **self.parameters).skips(step):
            return
        if self.criterion.met(step):
            self.form = self.module.Published(self.theta, self.target, **self.parameters)
            factor = Real(1)
        self.form.update(phi, y, factor)
        self.k += 1


def cases(n: int) -> list[dict[str, object]]:
    """Every criterion, and two inner rules (``subspace`` and ``exponential``)."""
    subspace = ("subspace", {"threshold": 1e-3})
    return [
        {"criterion": "period", "period": 50, "covariance": 10.0},
        {"criterion": "trace", "threshold": 0.02 * n, "covariance": 1.0},
        {"criterion": "smallest_eigenvalue", "threshold": 0.01, "covariance": 2.0},
        {"criterion": "change", "threshold": 5.0, "drift": 0.5, "memory": 40},
        {"criterion": "period", "period": 70, "covariance": 5.0, "rule": ("exponential", {})},
        {"criterion": "trace", "threshold": 0.05 * n, "covariance": 4.0, "rule": subspace},
    ]
