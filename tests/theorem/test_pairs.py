"""A rule around another: exactly what the inner rule would do with the P that it finds.

Every rule with every parameter set of its reference, reset every few samples, against Theorem 1.
"""

from __future__ import annotations

import numpy as np
import pytest

import forgetting as fg
from reference import precision, rates, rules
from reference.estimator import Estimator
from reference.linalg import to_float
from reference.signals import record

from . import product

FACTOR = 0.97
SAMPLES = 40
# Largest difference in units of eps cond(P), over theta and P of every sample; measured: 1
AMPLIFICATION = 10.0

INNER = [
    pytest.param(name, case, id=f"{name}-{i}")
    for name in product.RULES
    if name != "covariance_resetting"
    for i, case in enumerate(rules.load(name).cases(3))
]
# resets that shrink P and such that widen it, among samples of one or two rows
RESETS = [("exciting", 1, 3, 0.3), ("exciting", 2, 7, 500.0), ("silent", 1, 4, 20.0)]


@pytest.mark.parametrize(("name", "case"), INNER)
def test_the_inner_rule_goes_on_from_the_covariance_of_the_reset(
    name: str, case: dict[str, object]
) -> None:
    for kind, rows, period, covariance in RESETS:
        p = product.rows(name, rows)
        around = {"criterion": "period", "period": period, "covariance": covariance}
        case_around = {**around, "rule": (name, case)}
        data = record(kind, SAMPLES, p, 3, weighted=p > 1, seed=period)
        est = fg.RLS(
            3,
            rule=product.rule("covariance_resetting", case_around, FACTOR),
            rows=p,
            initial_covariance=100.0,
        )
        worst, condition = 0.0, 1.0
        with precision.working(float(np.finfo(float).eps)):
            dense = Estimator(
                3,
                rules.load("covariance_resetting").Dense(3, **case_around),
                rates.load("constant").Rate(FACTOR),
            )
            for k in range(SAMPLES):
                gamma = None if data.gamma is None else data.gamma[k : k + 1]
                run = product.feed(est, data.phi[k : k + 1], data.y[k : k + 1], gamma)
                dense.update(data.phi[k], data.y[k], None if gamma is None else gamma[0])
                assert (run.skipped[0] != 0) == dense.skipped, (kind, k)
                wanted, theta = to_float(dense.inverted), to_float(dense.theta)[:, 0]
                spread = np.linalg.eigvalsh(wanted)
                condition = max(condition, spread[-1] / spread[0])
                for found, right in ((est.covariance, wanted), (est.theta, theta)):
                    off = np.abs(found - right).max() / (np.abs(right).max() or 1.0)
                    worst = max(worst, off / condition)
        assert worst < AMPLIFICATION * np.finfo(float).eps, (kind, worst / np.finfo(float).eps)


def test_matrix_forgetting_after_a_reset_by_hand() -> None:
    """R = 2 before sample 3: R - F = 2 - 0.1 (1 - 1/2)^3 2 = 1.975."""
    inner = fg.MatrixForgetting(0.9, information=1.0, power=3)
    rule = fg.CovarianceResetting(inner, "period", covariance=1.0, period=2)
    est = fg.RLS(1, rule=rule, initial_covariance=0.01)
    priors = [
        est.run([[1.0]], [0.0], outputs=("prior_covariance",)).prior_covariance.item()
        for _ in range(4)
    ]
    assert 1.0 / priors[3] == pytest.approx(1.975, rel=1e-14)


def test_multiple_after_a_reset_by_hand() -> None:
    """P = 100 at sample 3, so that it is 100/101 after it, and R grows by 1 from then on."""
    rule = fg.CovarianceResetting(fg.Multiple(factors=1.0), "period", covariance=100.0, period=3)
    est = fg.RLS(1, rule=rule, initial_covariance=100.0)
    found = []
    for _ in range(6):
        est.update([1.0], 0.0)
        found.append(est.covariance.item())
    wanted = [1 / 1.01, 1 / 2.01, 1 / 3.01, 1 / 1.01, 1 / 2.01, 1 / 3.01]
    assert found == pytest.approx(wanted, rel=1e-14)
