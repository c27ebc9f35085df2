"""Runs of the estimator on random regressors, for the tests here."""

import numpy as np

import forgetting as fg

OUTPUTS = ("theta", "error", "covariance", "forgetting_factor", "skipped", "leverage")


def data(rows=1, samples=400, n=3, seed=0, sigma=0.1):
    """Regressors (T, rows, n), outputs (T, rows) and the parameters behind them."""
    rng = np.random.default_rng(seed)
    phi = rng.normal(size=(samples, rows, n))
    truth = rng.normal(size=n)
    return phi, phi @ truth + sigma * rng.normal(size=(samples, rows)), truth


def run_of(rule, phi, y, P0=1.0, **options):
    """All that an analysis asks of a run."""
    _, rows, n = phi.shape
    est = fg.RLS(n, rule=rule, rows=rows, initial_covariance=P0, **options)
    return est.run(phi[:, 0] if rows == 1 else phi, y[:, 0] if rows == 1 else y, outputs=OUTPUTS)
