"""Forecasts at every sample of a record, with intervals in both readings."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

import forgetting as fg
from forgetting.record.dynamics import columns
from forgetting.record.read import read
from reference.polynomial import SYSTEMS, record

ROOT = Path(__file__).resolve().parents[2]
CLASSES = {
    "arma": fg.ARMA(na=1, nc=1),
    "armax": fg.ARMAX(na=2, nb=2, nc=2),
    "oe": fg.OE(nb=2, nf=2),
    "bj": fg.BJ(nb=2, nc=1, nd=1, nf=2),
    "arx": fg.ARX(2, 2, 1),
    "fir": fg.FIR(3, 1),
    "ar": fg.AR(2),
}


def new(name, **settings):
    return type(CLASSES[name])(**CLASSES[name].get_params() | settings)


def signals(name, seed, samples):
    return record(
        SYSTEMS[{"arx": "armax", "fir": "armax", "ar": "arma"}.get(name, name)], seed, samples
    )


def rows(u, part):
    return None if u is None else u[part]


@pytest.mark.parametrize("rule", ["none", "auto", fg.Exponential(0.99)])
@pytest.mark.parametrize("name", CLASSES)
def test_they_are_those_of_the_model_at_that_time(name, rule):
    u, y = signals(name, 0, 300)
    made = fg.forecasts(new(name, rule=rule, offset=True), u, y, horizons=[1, 4], level=0.9)
    for k in (30, 100, 299):
        model = new(name, rule=rule, offset=True).fit(rows(u, slice(k)), y[:k])
        there = model.forecast(min(4, 300 - k) if u is None else u[k : k + 4])
        assert made.value[k, 0] == pytest.approx(there[0], rel=1e-6, abs=1e-9)
        if len(there) == 4:
            assert made.value[k + 3, 1] == pytest.approx(there[3], rel=1e-6, abs=1e-9)


def test_the_noise_is_that_of_the_forecast_with_a_level():
    u, y = signals("bj", 1, 3000)
    made = fg.forecasts(new("bj", rule="none"), u, y, horizons=[1, 20], level=0.9)
    model = new("bj", rule="none").fit(u[:2980], y[:2980])
    ahead = model.forecast(u[2980:], level=0.9)
    half = (ahead.upper - ahead.value)[[0, 19]]
    ours = np.array([made.noise_half_width[2980, 0], made.noise_half_width[2999, 1]])
    # the parameters make it wider by some thousandths
    assert (ours <= half).all() and ours == pytest.approx(half, rel=0.02)


def drifting(name, samples=5000):
    """Noise and gain that change, and outputs that jump."""
    u, y = signals(name, 2, samples)
    k = np.arange(samples)
    return u, y * (1 + 0.8 * np.sin(k / 600)) + 20.0 * (k > 3000)


@pytest.mark.parametrize("name", CLASSES)
def test_under_drift_the_share_inside_is_the_level(name):
    u, y = drifting(name)
    model = new(name, offset=True, rule=fg.Exponential(0.99))
    made = fg.forecasts(model, u, y, level=0.9)
    held = made.coverage()
    assert list(held) == [1, 5, 20]
    for i, each in enumerate(held.values()):
        assert each["conformal"] == pytest.approx(0.9, abs=0.01)
        lower, upper = made.interval.lower[:, i], made.interval.upper[:, i]
        inside = ((lower <= y) & (y <= upper))[np.isfinite(lower)]
        assert inside.mean() == pytest.approx(each["conformal"], abs=0.002)
        assert made.trackers[i].half_width > 0


RECORDS = Path(os.environ.get("FORGETTING_SHARED", ROOT.parent / "shared")) / "data"
LONG = 4000
"""Rows from which on a record has a long run; those that are shorter have some thousand."""


def noiseless(u, y):
    """Whether more than a twentieth of the errors is nothing but rounding: no share holds there."""
    error = fg.forecasts(fg.ARX(2, 2, 1, offset=True), u, y, horizons=1).error[18:]
    return np.mean(np.abs(error) < 1e-9 * np.abs(y).max()) > 0.05


@pytest.mark.skipif(not RECORDS.is_dir(), reason="the measured records are not here")
@pytest.mark.parametrize(
    "model",
    [fg.ARX(2, 2, 1, offset=True), fg.ARMAX(2, 2, 2, offset=True, rule=fg.Exponential(0.995))],
)
def test_measured_records_hold_the_level(model):
    held = 0
    for path in sorted(RECORDS.glob("*.csv")):
        found = read(path)
        names = [str(name) for name in found.frame.columns]
        if found.clock is not None:
            names.remove(found.clock.name)
        y, u = columns(found, names[-1:])[:LONG], columns(found, names[:-1])[:LONG]
        if noiseless(u, y):
            continue
        made = fg.forecasts(model, u, y, level=0.9)
        for horizon, each in made.coverage().items():
            off = 0.01 if len(y) == LONG else 0.025
            assert each["conformal"] == pytest.approx(0.9, abs=off), (path.stem, horizon)
        held += 1
    assert held >= 11


def test_what_is_missing_is_not_forecast_across():
    u, y = signals("arx", 3, 400)
    y[200], u[300] = np.nan, np.nan
    made = fg.forecasts(new("arx", rule="none"), u, y, horizons=[1, 3], level=0.9)
    one, three = made.value.T
    assert np.isnan(one[201:203]).all() and np.isfinite(one[203:301]).all()
    # made at 198 and 199, before the gap, and at 200 and 201, with y(200) among their lags
    assert np.isfinite(three[201:203]).all() and np.isnan(three[203:205]).all()
    assert np.isnan(one[301:303]).all() and np.isnan(three[301:304]).all()
    oe = fg.forecasts(new("oe", rule="none"), *signals("oe", 3, 50), horizons=2)
    assert oe.value.shape == (50, 1) and oe.horizons == (2,)


def test_frames_are_taken():
    u, y = signals("arx", 4, 200)
    frame = pd.DataFrame({"u": u, "y": y})
    made = fg.forecasts(new("arx"), frame[["u"]], frame["y"], horizons=[2])
    assert np.array_equal(made.value, fg.forecasts(new("arx"), u, y, horizons=[2]).value, True)


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda u, y: fg.forecasts(fg.RLS(2), u, y), "allowed: ARX, FIR"),
        (lambda u, y: fg.forecasts(fg.ARX(), u, y, level=0.0), "level = 0.0"),
        (lambda u, y: fg.forecasts(fg.ARX(), u, y, horizons=0), r"horizons = \[0\]"),
        (lambda u, y: fg.forecasts(fg.ARX(), u, y, horizons=[]), r"horizons = \[\]"),
        (lambda u, y: fg.forecasts(fg.ARX(), u, y, horizons=[1, 1]), "each once"),
        (lambda u, y: fg.forecasts(fg.ARX(), u, y, horizons=1.5), "horizons is 1.5"),
        (lambda u, y: fg.forecasts(fg.ARX(), None, y), "u has 0 input"),
        (lambda u, y: fg.forecasts(fg.OE(), u[:9], y), "u has 9 rows"),
        (lambda u, y: fg.forecasts(fg.ARX(), u, np.c_[y, y]), "y has 2 outputs"),
        (lambda u, y: fg.forecasts(fg.BJ(), u, np.c_[y, y]), "y has 2 outputs"),
    ],
)
def test_what_is_refused_is_named(call, words):
    with pytest.raises(fg.InvalidInput, match=words):
        call(*signals("arx", 5, 50))


@pytest.mark.parametrize("name", CLASSES)
def test_an_empty_record_has_no_forecasts(name):
    u, y = signals(name, 6, 5)
    made = fg.forecasts(new(name), rows(u, slice(0)), y[:0])
    assert made.value.shape == (0, 3)
    assert all(np.isnan(each["conformal"]) for each in made.coverage().values())
