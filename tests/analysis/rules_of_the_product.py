"""Every rule of the registry in the terms of Theorem 1: proper settings, improper ones, records.

A rule that scales a sample has a Γ of its own: `data_dependent` 1/μ, `efra` 1/a + (1/a - 1) φPφᵀ
with the P that it has just added to.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

import forgetting as fg
from forgetting.analysis import Trajectory

OUTPUTS = (
    "theta",
    "covariance",
    "prior_covariance",
    "skipped",
    "gate",
    "weight",
    "forgetting_factor",
)
GAIN = 0.5


@dataclass(frozen=True)
class Setting:
    """A rule, P_0 = start·I, and what it takes.

    `rows` is the largest number of rows, `axes` whether regressors must be along the axes.
    """

    rule: fg.Rule
    start: float = 2.0
    rows: int = 2
    axes: bool = False


ABOUT = {about["name"]: about for about in fg.rules()}


def proper(n):
    """Settings in which a rule is proper, by its name; a rule may have several.

    The defaults with λ = 0.9, but for the rules below, which take more than that.
    """
    return {
        about["name"]: [Setting(_rule(about, 0.9, {}), rows=about["largest_rows"] or 2)]
        for about in ABOUT.values()
        if about["proper"] != "no" and not _takes_a_function(about)
    } | _proper(n)


def improper(n):
    """A setting of each rule that is not always proper in which it is not.

    The one that the rule names itself, but for those below.
    """
    return {
        about["name"]: _named(about)
        for about in ABOUT.values()
        if about["proper"] != "always" and not _takes_a_function(about)
    } | _improper()


def _rule(about, factor, parameters):
    rated = {"forgetting_factor": factor} if about["forgetting_factor"] else {}
    return fg.rule(about["name"], **rated, **parameters)


def _named(about):
    """The setting in which, by what the registry says, the rule is not proper."""
    fails = about["settings"]["proper"]["fails"]
    rule = _rule(about, fails["forgetting_factor"], fails["parameters"])
    return Setting(rule, start=fails["variance"], rows=1)


def _takes_a_function(about):
    return any(parameter["kind"] == "function" for parameter in about["parameters"])


def _proper(n):
    return {
        "exponential": [
            Setting(fg.Exponential(0.9)),
            Setting(fg.Exponential(fg.PredictionError(sensitivity=1.0, smallest=0.8))),
        ],
        "exponential_resetting": [Setting(fg.ExponentialResetting(0.9, information=0.4))],
        "subspace": [Setting(fg.Subspace(0.9, threshold=1e-3))],
        "directional": [Setting(fg.Directional(0.9, threshold=1e-3), rows=1)],
        # so far from θ that every sample has the largest weight: none is left out
        "data_dependent": [Setting(fg.DataDependent(1e-6, 0.1, initial_radius=1e6))],
        "component": [Setting(fg.Component(factors=np.linspace(0.85, 0.97, n)))],
        "random_walk": [Setting(fg.RandomWalk(0.02))],
        "variable_direction": [Setting(fg.VariableDirection(0.9, threshold=1e-3))],
        "matrix_forgetting": [
            Setting(fg.MatrixForgetting(0.9, information=0.1)),
            Setting(fg.MatrixForgetting(0.9, information=0.1, power=3)),
        ],
        "efra": [
            Setting(fg.Efra(0.9, GAIN, 0.005, 0.01, schedule), rows=1)
            for schedule in ("every_sample", "cyclic")
        ],
        "multiple": [Setting(fg.Multiple(0.9), axes=True)],
        "custom": [Setting(fg.Custom(lambda r, phi, error: 0.1 * r))],
        "covariance_resetting": [
            Setting(fg.CovarianceResetting(covariance=2.0, period=20)),
            Setting(fg.CovarianceResetting(fg.Subspace(0.9), covariance=20.0, period=30)),
        ],
    }


def _improper():
    return {
        "exponential_resetting": Setting(fg.ExponentialResetting(0.9, information=5.0)),
        "cyclic_resetting": Setting(fg.CyclicResetting(0.9, information=5.0), rows=1),
        "matrix_forgetting": Setting(fg.MatrixForgetting(0.9, information=5.0), rows=1),
        "constant_trace": Setting(fg.ConstantTrace(level=1.0, floor=0.2)),
        "multiple": Setting(fg.Multiple(0.98)),
        "covariance_resetting": Setting(fg.CovarianceResetting(covariance=0.01, period=5)),
        "custom": Setting(fg.Custom(lambda r, phi, error: -0.1 * r)),
    }


def follow(setting, phi, y, theta0=None, **options):
    """Run the rule over φ (T, p, n) and y (T, p): the run, and its record with its own Γ."""
    _, rows, n = phi.shape
    est = fg.RLS(
        n,
        rule=setting.rule,
        rows=rows,
        initial_covariance=setting.start,
        initial_theta=theta0,
        **options,
    )
    run = est.run(phi, y, outputs=OUTPUTS)
    trajectory = Trajectory.from_run(
        run, phi, gamma=_gamma(setting.rule, run, phi), initial_covariance=setting.start
    )
    return run, trajectory


def _gamma(rule, run, phi):
    """Γ_k (T, p, p) where the rule chooses it, which it does where it is asked."""
    asked = ((run.skipped == 0) & (run.gate == 0))[:, None, None]
    unit = np.eye(phi.shape[1])
    if rule.name == "data_dependent":
        mu = np.where(asked[:, 0, 0], 1 - run.forgetting_factor, 1.0)
        return unit / mu[:, None, None]
    if rule.name == "efra":
        told = np.einsum("tpi,tij,tqj->tpq", phi, run.prior_covariance, phi)
        return np.where(asked, 1 / GAIN + (1 / GAIN - 1) * told, unit)
    return None
