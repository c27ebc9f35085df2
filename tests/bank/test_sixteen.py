"""A bank of sixteen members lives for ever; with FORGETTING_FULL=1 over ten million samples."""

from __future__ import annotations

import os

import numpy as np
import pytest

import forgetting as fg

SAMPLES = 10_000_000 if os.environ.get("FORGETTING_FULL") else 60_000
BLOCK = 5_000
THETA = np.array([1.0, -2.0, 0.5, 3.0])
MEMBERS = [
    *(fg.RandomWalk(noise, bound=1e5) for noise in (1e-8, 1e-4, 1e-2, 1.0)),
    *(fg.Exponential(factor) for factor in (0.8, 0.9, 0.99, 0.999)),
    *(fg.ExponentialResetting(factor) for factor in (0.8, 0.9, 0.99)),
    *(fg.Subspace(factor) for factor in (0.9, 0.99)),
    fg.Directional(0.95),
    fg.CyclicResetting(0.98),
    fg.NoForgetting(),
]


@pytest.mark.parametrize("dtype", ["float64", "float32"])
def test_sixteen_members_live_for_ever(dtype):
    """Silence of which exponential forgetting winds up to the end of its range, jumps, outliers."""
    assert len(MEMBERS) == 16
    random = np.random.default_rng(16)
    bank = fg.Bank(4, MEMBERS, dtype=dtype)
    theta = THETA.copy()
    for block in range(SAMPLES // BLOCK):
        kind = block % 4
        phi = random.normal(size=(BLOCK, 4))
        phi *= {0: 1.0, 1: 0.0, 2: [1.0, 1.0, 0.0, 0.0], 3: 100.0}[kind]
        if block % 3 == 0:
            theta = THETA + random.normal(size=4)
        y = phi @ theta + 0.1 * random.normal(size=BLOCK)
        if kind == 2:
            y[::50] += 1e4
        run = bank.run(phi, y, outputs=("error", "weights"))
        assert np.isfinite(run.error).all()
        np.testing.assert_allclose(run.weights.sum(axis=1), 1.0, rtol=1e-5)
        assert (run.weights >= 0).all()
    assert np.isfinite(bank.theta).all() and np.isfinite(bank.covariance).all()
    phi = random.normal(size=(500, 4))
    last = bank.run(phi, phi @ theta)
    assert np.std(last.error[-100:]) < 0.05 * np.std(phi @ theta)
    assert fg.Bank.from_bytes(bank.to_bytes()).to_bytes() == bank.to_bytes()
