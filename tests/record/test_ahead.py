"""`identify --level --ahead`: forecasts many steps ahead along a record, and what they held."""

from __future__ import annotations

import json

import numpy as np
import pandas as pd
import pytest
from typer.testing import CliRunner

import forgetting as fg
from forgetting.cli.app import app
from forgetting.record import identify
from forgetting.record.ahead import about_intervals
from forgetting.words.errors import RecordError


@pytest.fixture(scope="module")
def plant() -> pd.DataFrame:
    """A plant whose noise is coloured, and becomes four times as large in the middle."""
    rng = np.random.default_rng(9)
    u, e = rng.normal(size=(2, 3000))
    e *= np.where(np.arange(3000) < 1500, 0.1, 0.4)
    y = np.full(3000, 5.0)
    for k in range(1, 3000):
        y[k] = 1.0 + 0.8 * y[k - 1] + u[k - 1] + e[k] + 0.5 * e[k - 1]
    return pd.DataFrame({"u": u, "y": y})


MODELS = ({"arx": (1, 1, 1)}, {"model": "arx:na=1,nb=1,nk=1"}, {"model": "armax:na=1,nb=1,nc=1"})


@pytest.mark.parametrize("rule", ["auto", fg.Exponential(0.99)])
@pytest.mark.parametrize("model", MODELS)
def test_the_share_inside_is_the_level(plant, model, rule):
    found = identify(plant, output="y", input="u", rule=rule, level=0.9, ahead=[1, 10], **model)
    told = found.summary()["ahead"]
    assert told["output"] == "y" and told["level"] == 0.9
    for each, steps in zip(told["horizons"], (1, 10), strict=True):
        assert each["steps"] == steps
        assert each["conformal"] == pytest.approx(0.9, abs=0.01)
        assert each["half_width"] > 0.4
    assert len(about_intervals(found)) == 3


def test_one_step_is_the_prediction(plant):
    for model in MODELS:
        found = identify(plant, output="y", input="u", level=0.9, ahead=1, **model)
        forecast = found.ahead.forecasts.value[100:, 0]
        assert forecast == pytest.approx(found.prediction[100:, 0], abs=1e-6)
    # of the last the noise is that of the linear regression, so the readings agree nearly
    held = found.ahead.forecasts.coverage()[1]
    assert held["noise"] == pytest.approx(
        found.intervals.coverage(found.intervals.mean_square)[0], abs=0.03
    )


def test_they_are_those_of_the_class(plant):
    found = identify(
        plant, output="y", input="u", model="armax:na=1,nb=1,nc=1", rule="none", level=0.9, ahead=5
    )
    model = fg.ARMAX(1, 1, 1, offset=True, rule="none")
    alone = fg.forecasts(model, plant["u"], plant["y"], horizons=5, level=0.9)
    assert np.array_equal(found.ahead.forecasts.value, alone.value, equal_nan=True)
    assert np.array_equal(found.ahead.forecasts.half_width, alone.half_width, equal_nan=True)


@pytest.mark.parametrize("model", [*MODELS, {"model": "arma:na=1,nc=1"}])
def test_nothing_is_forecast_across_a_gap(plant, model):
    time = np.arange(3000.0)
    time[2000:] += 50.0
    inputs = () if "arma:" in str(model) else "u"
    found = identify(
        plant.assign(t=time), output="y", input=inputs, level=0.9, ahead=[1, 30], time="t", **model
    )
    value = found.ahead.forecasts.value
    assert value.shape == (3000, 2)
    assert np.isnan(value[2000:2030, 1]).all() and np.isfinite(value[2040:, 1]).all()
    assert np.isnan(value[2000, 0]) and np.isfinite(value[1950:2000, 1]).all()


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        ({"arx": (1, 1, 1), "ahead": 5}, "say the level"),
        ({"arx": (1, 1, 1), "ahead": 0, "level": 0.9}, r"horizons = \[0\]"),
        ({"arx": (1, 1, 1), "ahead": [2, 2], "level": 0.9}, "each once"),
        ({"arx": (1, 1, 1), "ahead": 1, "level": 0.9, "fixed": {"offset": 1.0}}, "fixed values"),
        ({"model": "oe:nb=1,nf=1", "ahead": 5}, "say the level"),
    ],
)
def test_what_is_refused_is_named(plant, settings, words):
    with pytest.raises(RecordError, match=words):
        identify(plant, output="y", input="u", **settings)


def test_a_formula_and_several_outputs_have_none(plant):
    with pytest.raises(RecordError, match="not by a formula"):
        identify(plant, formula="y ~ u", level=0.9, ahead=1)
    both = plant.assign(z=plant["y"])
    with pytest.raises(RecordError, match="of one output"):
        identify(both, output=["y", "z"], input="u", arx=(1, 1, 1), level=0.9, ahead=1)


def test_the_command_tells_it(plant, tmp_path):
    path = tmp_path / "plant.csv"
    plant[:500].to_csv(path, index=False)
    line = ["identify", str(path), "-y", "y", "-u", "u", "--arx", "1,1,1", "--level", "0.9"]
    shown = CliRunner().invoke(
        app, [*line, "--ahead", "1,10", "--report", str(tmp_path / "r.html")]
    )
    assert shown.exit_code == 0
    words = " ".join(shown.output.split())
    assert "Of the forecasts of y 10 samples ahead" in words
    assert "10 samples ahead" in (tmp_path / "r.html").read_text(encoding="utf-8")
    said = CliRunner().invoke(app, [*line, "--ahead", "10", "--json"])
    assert json.loads(said.output)["ahead"]["horizons"][0]["steps"] == 10
    wrong = CliRunner().invoke(app, [*line, "--ahead", "soon"])
    assert wrong.exit_code != 0
