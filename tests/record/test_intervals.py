"""`identify --level`: the intervals of one-step predictions, and what they held."""

from __future__ import annotations

import numpy as np
import pandas as pd
import pytest
from scipy.stats import norm

import forgetting as fg
from forgetting.record import identify


@pytest.fixture
def sensor() -> pd.DataFrame:
    """A line whose noise becomes four times as large in the middle."""
    rng = np.random.default_rng(8)
    u = rng.normal(size=4000)
    noise = np.where(np.arange(4000) < 2000, 0.1, 0.4) * rng.normal(size=4000)
    return pd.DataFrame({"u": u, "y": 1.0 + 2.0 * u + noise})


@pytest.mark.parametrize("rule", ["auto", "none", fg.Exponential(0.98)])
@pytest.mark.parametrize("level", [0.5, 0.95])
def test_the_columns_hold_the_level(sensor, rule, level):
    found = identify(sensor, formula="y ~ u", rule=rule, level=level)
    table = found.estimates()
    later = table.iloc[100:]
    inside = (later["lower:y"] <= later["measured:y"]) & (later["measured:y"] <= later["upper:y"])
    assert inside.mean() == pytest.approx(level, abs=0.01)
    told = found.summary()["intervals"]
    assert told["level"] == level
    assert told["coverage"]["y"]["conformal"] == pytest.approx(inside.mean(), abs=0.005)
    # one variance for all errors so far is too large before the change and too small behind it
    by_noise = told["coverage"]["y"]["mean_square"]
    assert by_noise == pytest.approx(shares(level), abs=0.03)


def shares(level):
    """What intervals of the variance so far hold of this noise: half of it at 0.1, half at 0.4."""
    k = np.arange(2000)
    far = np.sqrt((2000 * 0.01 + k * 0.16) / (2000 + k)) / 0.4 * norm.ppf(0.5 + level / 2)
    return (level + np.mean(2 * norm.cdf(far) - 1)) / 2


def test_the_half_width_of_a_rule_is_known_before_the_sample(sensor):
    found = identify(sensor, formula="y ~ u", rule="none", level=0.9)
    trace, row = found.trace, 500
    used = trace.error[2:row, 0] ** 2 / (1 + trace.leverage[2:row])
    expected = norm.ppf(0.95) * np.sqrt(used.mean() * (1 + trace.leverage[row]))
    assert found.intervals.mean_square[row, 0] == pytest.approx(expected, rel=1e-9)


def test_without_a_level_nothing_is_told(sensor):
    found = identify(sensor[:200], formula="y ~ u")
    assert found.intervals is None and found.summary()["intervals"] is None
    assert not any(name.startswith("lower") for name in found.estimates())


@pytest.mark.parametrize("level", [0.0, 1.0, -1.0, np.nan])
def test_a_level_out_of_range_is_refused(sensor, level):
    with pytest.raises(fg.InvalidInput, match="level"):
        identify(sensor, formula="y ~ u", level=level)
