"""How often intervals from P of a run hold what they are about."""

import numpy as np
import pytest
from runs import data, run_of

import forgetting as fg
from forgetting.analysis import confidence


def test_coverage_of_plain_least_squares_over_1e5_samples():
    inside = counted = 0
    for seed in range(10):
        phi, y, _ = data(samples=10_100, n=2, seed=seed)
        run = run_of(fg.NoForgetting(), phi, y, P0=1e4)
        found = confidence(run, phi, initial_covariance=1e4, warm_up=50)
        inside += found.coverage * found.counted.sum()
        counted += int(found.counted.sum())
    assert counted >= 100_000
    assert 0.94 < inside / counted < 0.96


#: Coverage of 95 % intervals from P for fixed parameters and known σ²: the docs quote these.
COVERAGE = {
    "none": (fg.NoForgetting(), 0.950),
    "exponential 0.98": (fg.Exponential(0.98), 0.955),
    "exponential 0.9": (fg.Exponential(0.9), 0.970),
    "resetting 0.9": (fg.ExponentialResetting(0.9, information=1.0), 0.968),
    "subspace 0.98": (fg.Subspace(0.98, threshold=1e-3), 0.952),
    "subspace 0.9": (fg.Subspace(0.9, threshold=1e-3), 0.956),
}


@pytest.mark.parametrize("name", COVERAGE)
def test_coverage_of_each_rule_for_fixed_parameters(name):
    rule, expected = COVERAGE[name]
    covered, fixed, estimated = [], [], []
    for seed in range(4):
        phi, y, _ = data(samples=10_140, n=4, seed=seed)
        run = run_of(rule, phi, y, P0=100.0)
        for given, kept in ((0.01, (covered, fixed)), (None, (None, estimated))):
            found = confidence(run, phi, initial_covariance=100.0, noise_variance=given, warm_up=70)
            if kept[0] is not None:
                kept[0].append(found.coverage)
            kept[1].append(found.fixed_coverage)
    chance = 4 * (0.05 * 0.95 / 40_000) ** 0.5
    assert np.mean(covered) == pytest.approx(expected, abs=chance)
    # The reading for fixed parameters is the true one here, σ² known or not.
    assert np.mean(fixed) == pytest.approx(0.95, abs=chance)
    assert np.mean(estimated) == pytest.approx(0.95, abs=chance)
