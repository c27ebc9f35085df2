"""Figures that headers state, measured."""

from __future__ import annotations

import numpy as np
import pytest

import forgetting as fg

C = 1.345


def gaussian_means(function: object) -> float:
    """The mean of a function of a standard normal number."""
    x = np.linspace(-12.0, 12.0, 400_001)
    density = np.exp(-(x**2) / 2) / np.sqrt(2 * np.pi)
    return float((function(x) * density).sum() * (x[1] - x[0]))


def test_the_efficiency_of_huber_is_that_of_a_recursion_whose_gain_is_one_over_the_weights() -> (
    None
):
    """theta moves by psi(e)/(k E w): of its variance remains b^2/(2 a - 1)/k, a = E psi'/E w and
    b^2 = E psi^2/(E w)^2. The equation sum psi = 0 itself has E psi^2/(E psi')^2."""
    weight = gaussian_means(lambda e: np.minimum(1.0, C / np.maximum(np.abs(e), 1e-300)))
    square = gaussian_means(lambda e: np.clip(e, -C, C) ** 2)
    slope = gaussian_means(lambda e: (np.abs(e) < C).astype(float))
    assert slope**2 / square == pytest.approx(0.95, abs=5e-4)
    recursive = (2 * slope / weight - 1) * weight**2 / square
    assert recursive == pytest.approx(0.923, abs=5e-4)

    streams, samples = 8000, 800
    fleet = fg.Fleet(streams, 1, rule="none", weighting=fg.Huber(C), initial_covariance=1e4)
    rng, ones = np.random.default_rng(1), np.ones((streams, 1))
    for _ in range(samples):
        fleet.update(ones, rng.standard_normal(streams))
    found = 1.0 / samples / float(fleet.theta.var())
    assert found == pytest.approx(recursive, abs=0.06)
    about = next(entry for entry in fg.weightings() if entry["name"] == "huber")
    assert "92.3 %" in about["header"]


@pytest.mark.parametrize("alpha", [0.01, 0.05])
def test_f_test_raises_fewer_false_alarms_than_its_significance(alpha: float) -> None:
    rule = fg.Exponential(fg.FTest(significance=alpha))
    est = fg.RLS(1, rule=rule, initial_covariance=1e-12)
    y = np.random.default_rng(2).standard_normal(300_000)
    factor = est.run(np.ones((len(y), 1)), y, outputs=("forgetting_factor",)).forgetting_factor
    rate = float((factor[1000:] < 1.0).mean())
    assert alpha / 5 < rate < alpha / 1.7
