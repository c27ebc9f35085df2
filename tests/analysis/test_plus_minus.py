"""How often two printed standard errors hold the true parameter: the table of docs/trust.md."""

import importlib.util
from dataclasses import fields
from pathlib import Path

import numpy as np
import pytest

from forgetting.record import drift, identify, trace

TOOL = Path(__file__).resolve().parents[2] / "tools" / "plus_minus.py"
RECORDS = range(12)
CHANCE = 4.0
"""Standard deviations that shares of few records may be off those of many."""


def _load():
    spec = importlib.util.spec_from_file_location("plus_minus", TOOL)
    tool = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(tool)
    return tool


table = _load()


def off(share, printed):
    """How many standard deviations of 12 records a share is from that of 100."""
    p = min(max(printed / 100, 0.03), 0.97)
    return abs(share - printed) / 100 / np.sqrt(p * (1 - p) / len(RECORDS))


@pytest.mark.parametrize("case", table.CASES)
def test_the_page_says_what_is_measured(case):
    bank, rule, said = table.printed()[case]
    assert bank >= 90.0, "the ± of the default must hold"
    assert rule >= 90.0 or said >= 90.0, "or it is said beside it"
    assert off(table.inside(case, "auto", RECORDS)[0], bank) < CHANCE
    measured, told = table.inside(case, "exponential", RECORDS)
    assert off(measured, rule) < CHANCE and off(told, said) < CHANCE


@pytest.mark.parametrize("pole", [0.0, 0.8, 0.95])
def test_correlation_of_the_noise_is_found(pole):
    frame, _ = table.record(
        {0.0: "fixed parameters, white noise"}.get(pole)
        or f"fixed, noise AR(1) {pole:g}, slow regressor",
        1,
    )
    assert identify(frame, formula="y ~ x").drift.correlation == pytest.approx(pole, abs=0.05)


@pytest.mark.parametrize("step", [0.01, 0.05])
def test_drift_is_found(step):
    """Steps of variance q σ²: within the grid's factor of ten."""
    frame, _ = table.record(f"random walk {step:g}", 2)
    found = identify(frame, formula="y ~ x").drift
    assert 1 / 6 < found.process_noise / (step / table.NOISE) ** 2 < 6
    assert "drift" in found.describe()


def test_units_and_zeros_change_no_course():
    frame, _ = table.record("random walk 0.01", 3)
    one = identify(frame, formula="y ~ x")
    moved = frame.assign(x=1e-3 * frame["x"] + 300.0, y=1e6 * frame["y"] - 5e7)
    other = identify(moved, formula="y ~ x")
    for a, b in zip(one.drift.courses, other.drift.courses, strict=True):
        assert (a.correlation, a.process_noise) == (b.correlation, b.process_noise)
        assert a.weight == pytest.approx(b.weight, rel=1e-3)
    ratio = other.standard_error[-1, 1, 0] / one.standard_error[-1, 1, 0]
    assert ratio == pytest.approx(1e9, rel=1e-3)


@pytest.mark.parametrize("rule", ["auto", "exponential"])
@pytest.mark.parametrize("model", [{"formula": "y ~ x"}, {"formula": "y ~ 0 + x"}])
def test_one_run_says_what_runs_row_by_row_say(model, rule, monkeypatch):
    """Bit for bit, with rows that are left out."""
    frame, _ = table.record("random walk 0.05", 4)
    frame.loc[50:60, "x"] = frame.loc[300, "y"] = np.nan
    found = []
    for at_once in (trace.AT_ONCE, 0):
        monkeypatch.setattr(drift, "AT_ONCE", at_once)
        monkeypatch.setattr(trace, "AT_ONCE", at_once)
        found.append(identify(frame, rule=rule, **model))
    one, other = found
    np.testing.assert_array_equal(one.drift.mean, other.drift.mean)
    np.testing.assert_array_equal(one.drift.variance, other.drift.variance)
    for each in fields(one.trace):
        np.testing.assert_array_equal(
            getattr(one.trace, each.name), getattr(other.trace, each.name)
        )


def test_half_of_the_interval_about_zero():
    """By integration: two-sided probability of a normal number with mean m within the width."""
    from scipy.stats import norm

    for m in (0.0, 0.3, 0.7, 1.2, 1.8, 2.0, 5.0):
        width = drift.half_width(np.array([m]))[0]
        assert norm.cdf(width - m) - norm.cdf(-width - m) == pytest.approx(0.9545, abs=2e-3)
