"""How often 95 % prediction intervals are right, rule by rule: the table of docs/trust.md."""

import importlib.util
from pathlib import Path
from statistics import NormalDist

import numpy as np
import pytest

import forgetting as fg
from forgetting.analysis import Trajectory, confidence

TOOL = Path(__file__).resolve().parents[2] / "tools" / "coverage.py"
ROUNDED = 0.1
"""Percent: the table has one digit, and the last bit of a sum may differ between machines."""


def _load():
    spec = importlib.util.spec_from_file_location("coverage_table", TOOL)
    tool = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(tool)
    return tool


table = _load()


@pytest.mark.parametrize("name", table.ABOUT)
def test_the_page_says_what_is_measured(name):
    said = table.printed()[name]
    for factor, printed in zip(table.FACTORS, said, strict=True):
        if factor != table.FACTORS[0] and not table.rated(name):
            assert printed is None
            continue
        measured = table.coverage(table.make(name, factor))
        assert measured == pytest.approx(printed, abs=ROUNDED), "run make stubs"


def test_without_forgetting_the_intervals_are_right():
    assert 94.0 < table.coverage(fg.NoForgetting()) < 96.0


def test_the_intervals_are_those_of_confidence():
    phi, y = table.record(0)
    wanted = ("error", "covariance", "prior_covariance", "whitened_innovation")
    run = fg.RLS(table.PARAMETERS, rule=fg.Exponential(0.95), initial_covariance=table.START).run(
        phi, y, outputs=wanted
    )
    trajectory = Trajectory.from_run(run, phi, initial_covariance=table.START)
    found = confidence(trajectory, errors=run.error, noise_variance=1.0)
    quantile = NormalDist().inv_cdf(0.975)
    half = quantile * (run.error / run.whitened_innovation)[:, np.newaxis, np.newaxis]
    np.testing.assert_allclose(found.half_width, half, rtol=1e-9)
