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
def test_exponential_reports_windup_and_then_refuses(dtype):
    est, random = excited(fg.Exponential(0.98), dtype)
    reported = False
    with pytest.raises(fg.NumericalRange, match="covariance"):
        for _ in range(100_000):
            y = float(STUCK @ THETA + NOISE * random.normal())
            before = est.to_bytes()
            reported |= est.update(STUCK, y).windup
            assert np.isfinite(est.theta).all()
    assert reported
    assert est.to_bytes() == before
    assert np.isfinite(est.covariance).all()
