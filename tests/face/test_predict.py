"""Predictions with intervals: how often the next measurement is inside."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.stats import t as student

import forgetting as fg
from forgetting.prediction import quantile

CHANCE = 0.015
"""Three standard deviations of a share of 0.9 among 3600 samples."""
RULES = {
    "none": (fg.NoForgetting(), 0.0),
    "exponential": (fg.Exponential(0.95), 0.02),
    "random walk": (None, 0.02),
}


def system(rng, samples, drift):
    phi = np.column_stack([np.ones(samples), rng.normal(size=(samples, 2))])
    walk = np.cumsum(drift * rng.normal(size=(samples, 3)), axis=0)
    theta = np.array([1.0, 2.0, 3.0]) + walk
    return phi, (phi * theta).sum(axis=1) + 0.3 * rng.normal(size=samples)


def test_the_method_says_the_same():
    phi, y = system(np.random.default_rng(4), 200, 0.0)
    estimator, bank = fg.RLS(3, monitor=True), fg.Bank(3)
    estimator.run(phi, y)
    errors = bank.run(phi, y).error
    assert estimator.predict(phi[0], 0.9) == fg.predict(estimator, phi[0], 0.9)
    found = bank.predict(phi[:5], level=0.5, errors=errors)
    for each, other in zip(found, fg.predict(bank, phi[:5], 0.5, errors=errors), strict=True):
        np.testing.assert_array_equal(each, other)
    assert found.value.tolist() == bank.predict(phi[:5]).tolist()
    with pytest.raises(fg.InvalidInput, match="level"):
        estimator.predict(phi[0], level=1.5)
    with pytest.raises(fg.InvalidInput, match="a bank needs"):
        bank.predict(phi[0], level=0.9)


@pytest.mark.parametrize("rule", RULES)
def test_the_share_inside_is_the_level(rule):
    made, drift = RULES[rule]
    rng, inside = np.random.default_rng(1), []
    for _ in range(12):
        phi, y = system(rng, 360, drift)
        estimator = fg.RLS(3, rule=made, monitor=True)
        estimator.run(phi[:60], y[:60])
        for x, measured in zip(phi[60:], y[60:], strict=True):
            found = fg.predict(estimator, x, level=0.9)
            inside.append(found.lower <= measured <= found.upper)
            estimator.update(x, measured)
    assert np.mean(inside) == pytest.approx(0.9, abs=CHANCE)


def test_a_bank_by_its_errors():
    rng, inside = np.random.default_rng(2), []
    for _ in range(12):
        phi, y = system(rng, 360, 0.02)
        bank = fg.Bank(3)
        errors = bank.run(phi[:60], y[:60], outputs="error").error.tolist()
        for x, measured in zip(phi[60:], y[60:], strict=True):
            found = fg.predict(bank, x, level=0.9, errors=errors)
            inside.append(found.lower <= measured <= found.upper)
            errors.append(bank.update(x, measured).error)
    assert np.mean(inside) == pytest.approx(0.9, abs=2 * CHANCE)


def test_the_half_width_is_that_of_the_next_sample():
    rng = np.random.default_rng(3)
    phi, y = system(rng, 200, 0.0)
    estimator = fg.RLS(3, rule=fg.Exponential(0.9), monitor=True)
    estimator.run(phi, y)
    before = estimator.to_bytes()
    found = fg.predict(estimator, phi[:5], level=0.8)
    assert estimator.to_bytes() == before
    assert np.array_equal(found.value, estimator.predict(phi[:5]))
    health, prior = estimator.health(), estimator.covariance / 0.9
    for i, x in enumerate(phi[:5]):
        single = fg.predict(estimator, x, level=0.8)
        expected = student.ppf(0.9, health.weight)
        expected *= np.sqrt(health.noise_variance * (1 + x @ prior @ x))
        assert single.upper - single.value == pytest.approx(expected, rel=1e-3)
        assert (single.lower, single.upper) == (found.lower[i], found.upper[i])


@pytest.mark.parametrize("freedom", [5.0, 10.0, 100.0, np.inf])
def test_the_quantile_is_students(freedom):
    for level in (0.5, 0.8, 0.95):
        expected = student.ppf(0.5 + level / 2, freedom)
        assert quantile(level, freedom) == pytest.approx(expected, rel=0.01)


def test_before_anything_is_known_there_is_no_interval():
    found = fg.predict(fg.RLS(2, monitor=True), [1.0, 2.0])
    assert found.value == 0.0 and np.isnan([found.lower, found.upper]).all()
    assert np.isnan(fg.predict(fg.Bank(2), [1.0, 2.0], errors=[]).upper)


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: fg.predict(fg.RLS(1), [1.0]), "make it with monitor=True"),
        (lambda: fg.predict(fg.Bank(1), [1.0]), "a bank needs its one-step errors"),
        (lambda: fg.predict(fg.RLS(1, monitor=True), [1.0], level=1.0), "level = 1.0"),
        (lambda: fg.predict(fg.RLS(1, targets=2, monitor=True), [1.0]), "has 2 targets"),
        (lambda: fg.predict(fg.RLS(1, rows=2, monitor=True), [1.0]), "has 2 rows"),
        (lambda: fg.predict(fg.Bank(1), [1.0], errors=[[1.0]]), "errors has shape"),
        (lambda: fg.predict(fg.Bank(1), [1.0], errors=[np.inf]), "finite or NaN"),
        (lambda: fg.predict(fg.RLS(1, monitor=True), [np.nan]), "phi"),
    ],
)
def test_what_is_refused_is_named(call, words):
    with pytest.raises(fg.InvalidInput, match=words):
        call()
