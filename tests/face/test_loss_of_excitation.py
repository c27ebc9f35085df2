"""The failure that this package exists to end.

Four parameters, noise of 0.01, 500 exciting samples, then one regressor for a million more.
"""

import numpy as np
import pytest

import forgetting as fg

THETA = np.array([1.0, -2.0, 0.5, 3.0])
NOISE = 0.01
STUCK = np.array([1.0, 0.5, -0.3, 0.8])
BLOCK = 50_000


def excited(rule, dtype):
    random = np.random.default_rng(7)
    est = fg.RLS(4, rule=rule, initial_covariance=100.0, dtype=dtype)
    phi = random.normal(size=(500, 4))
    est.run(phi, phi @ THETA + NOISE * random.normal(size=500))
    return est, random


def stuck(est, random, samples):
    """Yields the results of `samples` samples with one regressor, block by block."""
    phi = np.tile(STUCK, (BLOCK, 1))
    for _ in range(samples // BLOCK):
        y = phi @ THETA + NOISE * random.normal(size=BLOCK)
        yield est.run(phi, y, outputs=["theta", "windup"])


@pytest.mark.parametrize("dtype", ["float64", "float32"])
def test_subspace_holds_the_estimate(dtype):
    est, random = excited(fg.Subspace(0.98), dtype)
    largest = np.linalg.eigvalsh(est.covariance.astype(float))[-1]
    for run in stuck(est, random, 1_000_000):
        assert np.abs(run.theta - THETA).max() < 1e-2
        assert not run.windup.any()
    eigenvalues = np.linalg.eigvalsh(est.covariance.astype(float))
    assert eigenvalues[0] > 0
    assert eigenvalues[-1] < 2 * largest


@pytest.mark.parametrize("dtype", ["float64", "float32"])
def test_exponential_reports_windup_and_lives_on(dtype):
    est, random = excited(fg.Exponential(0.98), dtype)
    (*_, last) = stuck(est, random, 100_000)
    assert last.windup.all()
    update = est.update(STUCK, STUCK @ THETA)
    assert (update.forgetting_factor, update.rank) == (1.0, 0)
    assert np.isfinite(est.theta).all()
    assert np.isfinite(est.covariance).all()
    phi = random.normal(size=(200, 4))
    est.run(phi, phi @ THETA + NOISE * random.normal(size=200))
    np.testing.assert_allclose(est.theta, THETA, atol=0.05)
    assert not est.update(phi[0], phi[0] @ THETA).windup


FACTORS = {
    each["name"]: {"forgetting_factor": 0.9} if each["forgetting_factor"] else {}
    for each in fg.rules()
    if each["name"] != "custom"
}


@pytest.mark.parametrize("prior", [{}, {"initial_covariance": 100.0}], ids=["data", "given"])
@pytest.mark.parametrize("dtype", ["float64", "float32"])
@pytest.mark.parametrize("rule", FACTORS)
def test_every_rule_lives_through_silence(rule, dtype, prior):
    """Silent until any growth of P by 0.9 a sample would have left the range; then all is new."""
    random, silent = np.random.default_rng(3), 5000
    est = fg.RLS(2, rule=rule, dtype=dtype, **FACTORS[rule], **prior)
    excited = random.normal(size=1000)
    x = np.concatenate([excited[:200], np.zeros(silent), excited[200:]])
    phi = np.column_stack([np.ones_like(x), x])
    y = 3.0 + 0.5 * x + NOISE * random.normal(size=len(x))
    before = est.run(phi[: 200 + silent], y[: 200 + silent])
    assert len(before.theta) == 200 + silent
    assert np.isfinite(before.theta).all()
    y[200 + silent :] -= 1.5 * excited[200:]
    est.run(phi[200 + silent :], y[200 + silent :])
    assert np.isfinite(est.covariance).all()
    assert abs(est.theta[0] - 3.0) < 0.05
    assert rule == "none" or abs(est.theta[1] + 1.0) < 0.25
