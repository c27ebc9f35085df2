"""How often outputs are within the intervals of ARMA, ARMAX, OE and BJ, and why."""

from __future__ import annotations

import numpy as np
import pandas as pd
import pytest
from scipy.signal import lfilter

import forgetting as fg
from forgetting.models.unknown import with_unknown
from reference.polynomial import SYSTEMS, record

RECORDS, STEPS, LEVEL = 150, 20, 0.9
CHANCE = 0.075
"""A little more than three standard deviations of a share of 0.9 among so many records."""
CLASSES = {
    "arma": fg.ARMA(na=1, nc=1, rule="none"),
    "armax": fg.ARMAX(na=2, nb=2, nc=2, rule="none"),
    "oe": fg.OE(nb=2, nf=2, rule="none"),
    "bj": fg.BJ(nb=2, nc=1, nd=1, nf=2, rule="none"),
}
Z = 1.6448536
"""Standard deviations on both sides that hold 0.9 of a normal distribution."""


def new(name, **settings):
    return type(CLASSES[name])(**CLASSES[name].get_params() | settings)


def rows(u, part):
    """Inputs of some rows; how many of them where there is no input."""
    return part.stop - part.start if u is None else u[part]


def held(made, y):
    return (made.lower <= y) & (y <= made.upper)


@pytest.mark.parametrize("rule", ["none", "exponential"])
@pytest.mark.parametrize("name", SYSTEMS)
def test_the_share_inside_is_the_level(name, rule):
    samples, ahead, one_step = 2000, np.zeros(STEPS), []
    made = fg.NoForgetting() if rule == "none" else fg.Exponential(0.998)
    for seed in range(RECORDS):
        u, y = record(SYSTEMS[name], seed, samples + STEPS)
        y, later = y + 10.0, slice(samples, samples + STEPS)
        model = new(name, rule=made, offset=True)
        model.fit(None if u is None else u[:samples], y[:samples])
        ahead += held(model.forecast(rows(u, later), level=LEVEL), y[later])
        one_step.append(held(model.predict(u, y, level=LEVEL), y)[samples:].mean())
    for step in (1, 5, 20):
        assert ahead[step - 1] / RECORDS == pytest.approx(LEVEL, abs=CHANCE), step
    assert ahead.mean() / RECORDS == pytest.approx(LEVEL, abs=0.03)
    assert np.mean(one_step) == pytest.approx(LEVEL, abs=0.02)


@pytest.mark.parametrize("name", SYSTEMS)
def test_a_short_record_and_a_bank_are_not_too_sure(name):
    inside = {"none": 0.0, "auto": 0.0}
    for seed in range(60):
        u, y = record(SYSTEMS[name], seed, 400 + STEPS)
        for rule in inside:
            model = new(name, rule=rule).fit(None if u is None else u[:400], y[:400])
            made = model.forecast(rows(u, slice(400, 400 + STEPS)), level=LEVEL)
            inside[rule] += held(made, y[400:]).mean() / 60
    assert all(0.86 < share < 0.97 for share in inside.values()), inside


def slopes(of, theta, covariance):
    """The root of the covariance, and what `of` changes by along each of its columns."""
    root = np.linalg.cholesky(covariance) * 1e-4
    each = [(of(theta + column) - of(theta - column)) / 2e-4 for column in root.T]
    return np.square(each).sum(axis=0)


@pytest.mark.parametrize("name", SYSTEMS)
def test_one_step_is_the_delta_method(name):
    u, y = record(SYSTEMS[name], 1, 500)
    model, given = new(name).fit(u, y), np.zeros_like(y) if u is None else u

    def predicted(theta):
        return y - SYSTEMS[name].with_theta(theta).errors(given, y)

    made = model.predict(u, y, level=LEVEL)
    variance = ((made.upper - made.value) / Z) ** 2 / model.noise_variance_
    expected = 1.0 + slopes(predicted, model.theta_, model.covariance_)
    assert variance[model.reach :] == pytest.approx(expected[model.reach :], rel=1e-5)
    assert np.isnan(made.lower[: model.reach]).all()
    assert np.array_equal(made.value, model.predict(u, y), equal_nan=True)


@pytest.mark.parametrize("name", SYSTEMS)
def test_many_steps_are_the_delta_method(name):
    u, y = record(SYSTEMS[name], 2, 4000 + STEPS)
    known, later = y[:4000], slice(4000, 4000 + STEPS)
    model = new(name).fit(None if u is None else u[:4000], known)
    given = np.zeros_like(y) if u is None else u

    def forecast(theta):
        system = SYSTEMS[name].with_theta(theta)
        errors = np.r_[system.errors(given[:4000], known), np.zeros(STEPS)]
        return system.simulate(given, errors)[later]

    made = model.forecast(rows(u, later), level=LEVEL)
    found = SYSTEMS[name].with_theta(model.theta_)
    noise = np.cumsum(found.simulate(np.zeros(STEPS), np.eye(1, STEPS)[0]) ** 2)
    variance = ((made.upper - made.value) / Z) ** 2 / model.noise_variance_
    # the signals of the model are those of the estimates of each moment, not of the last
    expected = slopes(forecast, model.theta_, model.covariance_)
    assert variance - noise == pytest.approx(expected, rel=0.1)
    assert np.array_equal(made.value, model.forecast(rows(u, later)))


def test_an_interval_over_missing_outputs_holds_its_level():
    inside, samples = np.zeros(60), 3000
    for seed in range(RECORDS):
        u, y = record(SYSTEMS["bj"], seed, samples)
        model = new("bj").fit(u, y)
        given = y.copy()
        given[2920:2940] = np.nan
        inside += held(model.predict(u, given, level=LEVEL), y)[2900:2960]
    for part in (slice(0, 20), slice(20, 40), slice(40, 60)):
        assert inside[part].mean() / RECORDS == pytest.approx(LEVEL, abs=0.03)


def test_what_missing_outputs_leave_is_known():
    """Beside draws of the errors that a predictor with nothing in the place of e makes."""
    rng, missing = np.random.default_rng(3), np.zeros(40, dtype=bool)
    missing[[5, 6, 7, 20, 22]] = True
    psi = np.zeros((40, 1))
    ar, ma = np.convolve([1.0, -0.8], [1.0, -0.6]), np.array([1.0, 0.5])
    variance, slope = with_unknown(psi, missing, ma, ar)
    e = rng.normal(size=(20_000, 40))
    y = lfilter(ma, ar, e, axis=1)
    used, errors = np.zeros_like(y), np.zeros_like(y)
    past = lambda x, k, lag: x[:, k - lag] if k >= lag else 0.0  # noqa: E731
    known = np.zeros_like(y)  # what the predictor takes for e
    for k in range(40):
        predicted = 0.5 * past(known, k, 1) - ar[1] * past(used, k, 1) - ar[2] * past(used, k, 2)
        errors[:, k] = y[:, k] - predicted
        used[:, k] = predicted if missing[k] else y[:, k]
        known[:, k] = 0.0 if missing[k] else errors[:, k]
    assert variance == pytest.approx(errors.var(axis=0), rel=0.06)
    assert variance[:6] == pytest.approx(1.0) and not slope.any()


def test_units_do_not_matter():
    u, y = record(SYSTEMS["bj"], 4, 600)
    plain = new("bj", offset=True).fit(u[:500], y[:500]).forecast(u[500:], level=LEVEL)
    other = new("bj", offset=True).fit(u[:500] * 1e6 + 3e7, y[:500] * 1e-3 + 5.0)
    made = other.forecast(u[500:] * 1e6 + 3e7, level=LEVEL)
    for ours, theirs in zip(plain, made, strict=True):
        assert (theirs - 5.0) * 1e3 == pytest.approx(ours, rel=1e-5, abs=1e-5)


def test_frames_keep_their_index_and_nothing_is_learned():
    u, y = record(SYSTEMS["oe"], 5, 300)
    index = pd.date_range("2026-01-01", periods=300, freq="s")
    u, y = pd.Series(u, index, name="u"), pd.Series(y, index, name="y")
    model = new("oe").fit(u, y)
    before = model.theta_, model.samples_
    assert model.predict(u, y, level=0.9).upper.index.equals(index)
    model.forecast(np.ones(5), level=0.9)
    assert np.array_equal(before[0], model.theta_) and before[1] == model.samples_


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda model: model.forecast(np.ones(3), level=1.0), "level = 1.0"),
        (lambda model: model.predict(np.ones(9), np.ones(9), level=-1.0), "level = -1.0"),
        (lambda model: model.forecast(np.ones((3, 2)), level=0.9), "u has 2 channels"),
        (lambda model: model.forecast([1.0, np.nan], level=0.9), "u is missing"),
        (lambda model: fg.BJ().forecast(3, level=0.9), "has seen no data"),
        (
            lambda model: model.partial_fit([1.0], [np.nan]).forecast([1.0], level=0.9),
            "in the last rows is missing",
        ),
    ],
)
def test_what_is_refused_is_named(call, words):
    u, y = record(SYSTEMS["armax"], 6, 300)
    with pytest.raises(fg.InvalidInput, match=words):
        call(new("armax").fit(u, y))


def test_a_model_that_has_seen_too_little_claims_nothing():
    made = new("armax").fit(np.ones(4), np.arange(4.0)).forecast([1.0, 2.0], level=0.9)
    assert np.isnan(made.lower).all() and np.isfinite(made.value).all()
    empty = new("armax").fit(np.ones(4), np.arange(4.0)).forecast(np.empty(0), level=0.9)
    assert all(len(each) == 0 for each in empty)
