"""How often 95 % prediction intervals are right, rule by rule: the table of docs/trust.md."""

import re
from pathlib import Path
from statistics import NormalDist

import numpy as np
import pytest

import forgetting as fg
from forgetting.analysis import Trajectory, confidence

PAGE = Path(__file__).resolve().parents[2] / "docs" / "trust.md"
RUNS, SAMPLES, PARAMETERS, START = 100, 1000, 3, 4.0
FACTORS = (0.99, 0.95)
ROUNDED = 0.1
"""Percent: the table has one digit, and the last bit of a sum may differ between machines."""
ABOUT = {about["name"]: about for about in fg.rules()}


def _make(name, factor):
    """The rule with its defaults and this λ; `custom` is exponential."""
    if name == "custom":
        return fg.Custom(lambda r, phi, error: (1 - factor) * r)
    return fg.rule(name, **({"forgetting_factor": factor} if _rated(name) else {}))


def _rated(name):
    return ABOUT[name]["forgetting_factor"] or name == "custom"


def _record(seed):
    """Fixed parameters drawn from the prior, white regressors and noise of variance 1."""
    rng = np.random.default_rng(seed)
    phi = rng.normal(size=(SAMPLES, PARAMETERS))
    theta = START**0.5 * rng.normal(size=PARAMETERS)
    return phi, phi @ theta + rng.normal(size=SAMPLES)


def coverage(rule):
    """Share of 100,000 outputs in their 95 % interval, in percent."""
    quantile, inside = NormalDist().inv_cdf(0.975), 0
    for seed in range(RUNS):
        est = fg.RLS(PARAMETERS, rule=rule, initial_covariance=START)
        run = est.run(*_record(seed), outputs=["whitened_innovation"])
        inside += int((np.abs(run.whitened_innovation) <= quantile).sum())
    return 100 * inside / (RUNS * SAMPLES)


def table():
    """Coverage by rule, as the page has it."""
    rows = re.findall(r"^\| `(\w+)` \| ([\d.]+|–) \| ([\d.]+|–) \|$", PAGE.read_text("utf-8"), re.M)
    return {name: tuple(float(x) if x != "–" else None for x in row) for name, *row in rows}


@pytest.mark.parametrize("name", ABOUT)
def test_the_page_says_what_is_measured(name):
    said = table()[name]
    for factor, printed in zip(FACTORS, said, strict=True):
        if factor != FACTORS[0] and not _rated(name):
            assert printed is None
            continue
        assert coverage(_make(name, factor)) == pytest.approx(printed, abs=ROUNDED)


def test_without_forgetting_the_intervals_are_right():
    assert 94.0 < coverage(fg.NoForgetting()) < 96.0


def test_the_intervals_are_those_of_confidence():
    phi, y = _record(0)
    wanted = ("error", "covariance", "prior_covariance", "whitened_innovation")
    run = fg.RLS(PARAMETERS, rule=fg.Exponential(0.95), initial_covariance=START).run(
        phi, y, outputs=wanted
    )
    trajectory = Trajectory.from_run(run, phi, initial_covariance=START)
    found = confidence(trajectory, errors=run.error, noise_variance=1.0)
    quantile = NormalDist().inv_cdf(0.975)
    half = quantile * (run.error / run.whitened_innovation)[:, :, np.newaxis]
    np.testing.assert_allclose(found.half_width, half, rtol=1e-9)


if __name__ == "__main__":  # writes the rows of the table
    for each in ABOUT:
        cells = [f"{coverage(_make(each, factor)):.1f}" for factor in FACTORS]
        print(f"| `{each}` | {cells[0]} | {cells[1] if _rated(each) else '–'} |")
