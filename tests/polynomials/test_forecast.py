"""Forecasts of ARX and its kin, and how often outputs are within their intervals."""

from __future__ import annotations

import numpy as np
import pandas as pd
import pytest
from scipy.signal import lfilter

import forgetting as fg

SYSTEMS, STEPS = 300, 20
CHANCE = 0.055
"""A little more than three standard deviations of a share of 0.9 among 300 systems."""


def record(rng, samples):
    u = rng.normal(size=samples)
    noise = lfilter([1.0], [1.0, -1.5, 0.7], 0.5 * rng.normal(size=samples))
    return u, 2.0 + lfilter([0.0, 1.0, 0.5], [1.0, -1.5, 0.7], u) + noise


@pytest.mark.parametrize("rule", ["none", "exponential"])
@pytest.mark.parametrize("samples", [60, 400])
def test_the_share_inside_is_the_level(rule, samples):
    made = fg.NoForgetting() if rule == "none" else fg.Exponential(0.98)
    rng, inside, one_step = np.random.default_rng(1), np.zeros(STEPS), []
    for _ in range(SYSTEMS):
        u, y = record(rng, samples + STEPS)
        model = fg.ARX(2, 2, 1, rule=made, offset=True).fit(u[:samples], y[:samples])
        ahead = model.forecast(u[samples:], level=0.9)
        inside += (ahead.lower <= y[samples:]) & (y[samples:] <= ahead.upper)
        known = model.predict(u, y, level=0.9)
        one_step.append(((known.lower <= y) & (y <= known.upper))[samples:].mean())
    for step in (1, 5, 20):
        assert inside[step - 1] / SYSTEMS == pytest.approx(0.9, abs=CHANCE), step
    assert np.mean(one_step) == pytest.approx(0.9, abs=0.03)


def test_a_bank_is_not_too_sure():
    rng, inside = np.random.default_rng(2), np.zeros(STEPS)
    for _ in range(100):
        u, y = record(rng, 300)
        model = fg.ARX(2, 2, 1, offset=True).fit(u[:280], y[:280])
        ahead = model.forecast(u[280:], level=0.9)
        inside += (ahead.lower <= y[280:]) & (y[280:] <= ahead.upper)
    assert 0.86 < inside.mean() / 100 < 0.97


def test_known_parameters_leave_the_noise():
    rng = np.random.default_rng(3)
    y = lfilter([1.0], [1.0, -0.9], rng.normal(size=100_000))
    model = fg.AR(1, rule="none").fit(None, y)
    ahead = model.forecast(30, level=0.95)
    expected = np.sqrt((1 - 0.81 ** np.arange(1, 31)) / (1 - 0.81))
    assert (ahead.upper - ahead.value) / 1.95996 == pytest.approx(expected, rel=0.02)
    assert ahead.value == pytest.approx(y[-1] * model.theta_[0] ** np.arange(1, 31))
    assert np.array_equal(model.forecast(30), ahead.value)


def test_the_parameters_are_those_of_the_delta_method():
    rng = np.random.default_rng(4)
    y = lfilter([1.0], [1.0, -0.9], rng.normal(size=40))
    model = fg.AR(1, rule="none").fit(None, y)
    a, h = model.theta_[0], np.arange(1, 11)
    noise = model.noise_variance_[0]
    variance = noise * (1 - a ** (2 * h)) / (1 - a**2)
    variance += (h * a ** (h - 1) * y[-1]) ** 2 * noise * model.covariance_[0, 0]
    ahead = model.forecast(10, level=0.95)
    assert ahead.upper - ahead.value == pytest.approx(1.95996 * np.sqrt(variance), rel=1e-4)


def test_outputs_that_act_on_one_another():
    rng = np.random.default_rng(5)
    a = np.array([[0.7, 0.4], [0.0, 0.5]])
    y = np.zeros((20_000, 2))
    for k in range(1, len(y)):
        y[k] = a @ y[k - 1] + [0.1, 1.0] * rng.normal(size=2)
    ahead = fg.ARX(1, 0, 0, rule="none").fit(None, y).forecast(3, level=0.95)
    response = [np.linalg.matrix_power(a, k) for k in range(3)]
    variance = np.cumsum([np.square(each) @ [0.01, 1.0] for each in response], axis=0)
    assert ahead.value.shape == (3, 2)
    assert ahead.upper - ahead.value == pytest.approx(1.95996 * np.sqrt(variance), rel=0.03)


def test_frames_keep_their_index():
    rng = np.random.default_rng(6)
    u, y = record(rng, 100)
    index = pd.date_range("2026-01-01", periods=100, freq="s")
    u, y = pd.Series(u, index, name="u"), pd.Series(y, index, name="y")
    found = fg.ARX(2, 2, 1, rule="none").fit(u, y).predict(u, y, level=0.9)
    assert found.upper.index.equals(index)


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda model: model.forecast(np.ones(3), level=0.0), "level = 0.0"),
        (lambda model: model.forecast(np.ones((3, 2))), "u has 2 channels"),
        (lambda model: model.forecast([1.0, np.nan]), "u is missing"),
        (lambda model: fg.ARX(1, 1, 1).forecast(3), "has seen no data"),
        (
            lambda model: model.partial_fit([1.0], [np.nan]).forecast([1.0]),
            "a value in the last rows is missing",
        ),
    ],
)
def test_what_is_refused_is_named(call, words):
    u, y = record(np.random.default_rng(7), 50)
    with pytest.raises(fg.InvalidInput, match=words):
        call(fg.ARX(1, 1, 1).fit(u, y))
