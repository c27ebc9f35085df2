"""Forgetting by the clock of a record, through Python and through the command."""

from __future__ import annotations

import json

import numpy as np
import pandas as pd
import pytest

import forgetting as fg
from forgetting.cli import main
from forgetting.record import identify
from forgetting.words.errors import RecordError


def log(samples: int = 300) -> pd.DataFrame:
    """A slope that drifts, read every minute or, by chance, much later."""
    random = np.random.default_rng(8)
    steps = np.where(random.random(samples) < 0.1, 900.0, 60.0)
    time = pd.Timestamp("2026-03-01") + pd.to_timedelta(np.cumsum(steps), unit="s")
    x = random.normal(size=samples)
    y = (1.0 + 0.002 * np.arange(samples)) * x + 0.1 * random.normal(size=samples)
    return pd.DataFrame({"time": time, "x": x, "y": y})


def test_forgets_by_the_clock():
    frame = log()
    found = identify(frame, formula="y ~ 0 + x", rule="exponential", half_life="30min")
    seconds = (frame["time"] - frame["time"][0]).dt.total_seconds().to_numpy()
    est = fg.RLS(1, rule=fg.Exponential(half_life=1800.0))
    theta = est.run(frame[["x"]].to_numpy(), frame["y"].to_numpy(), time=seconds).theta
    np.testing.assert_allclose(found.theta[:, 0, 0], theta[:, 0], rtol=1e-12)
    factors = found.trace.forgetting_factor
    np.testing.assert_allclose(factors[1:], 2 ** (-np.diff(seconds) / 1800.0), rtol=1e-12)


def test_a_bare_number_counts_samples():
    frame = log()
    found = identify(frame, formula="y ~ 0 + x", rule="exponential", half_life=50)
    assert found.trace.forgetting_factor == pytest.approx(2 ** (-1 / 50))


def test_what_cannot_be_is_refused():
    frame = log()
    for arguments, words in (
        ({"half_life": "30min"}, "auto"),
        ({"half_life": "30min", "rule": "random_walk"}, "random_walk"),
        ({"half_life": "often", "rule": "exponential"}, "often"),
        ({"half_life": "30min", "rule": "exponential", "time": "none"}, "clock"),
    ):
        with pytest.raises(RecordError, match=words):
            identify(frame, formula="y ~ 0 + x", **arguments)


def test_on_the_command_line(tmp_path, capsys):
    path = tmp_path / "log.csv"
    log().to_csv(path, index=False)
    command = ["identify", str(path), "--formula", "y ~ 0 + x", "--rule", "exponential"]
    assert main([*command, "--half-life", "30min", "--json"]) == 0
    value = json.loads(capsys.readouterr().out)["parameters"][0]["value"]
    found = identify(log(), formula="y ~ 0 + x", rule="exponential", half_life="30min")
    assert value == pytest.approx(found.theta[-1, 0, 0], rel=1e-9)
    assert main([*command, "--half-life", "30min", "--forgetting-factor", "0.9"]) == 2
    assert "--half-life" in capsys.readouterr().err
