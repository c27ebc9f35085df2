"""Intervals about forecasts many steps ahead that hold what they promise."""

from __future__ import annotations

import copy
import pickle

import numpy as np
import pytest
from scipy.signal import lfilter

import forgetting as fg


def errors_of(kind, steps, samples=20_000):
    """Errors of forecasts so many steps ahead: they overlap, and so go together."""
    rng = np.random.default_rng(1)
    own = rng.standard_cauchy(size=samples) if kind == "heavy" else rng.normal(size=samples)
    made = lfilter(0.9 ** np.arange(steps), [1.0], own)
    k = np.arange(samples)
    if kind == "drift":
        made = made * 10.0 ** (2 * np.sin(k / 1500))
    if kind == "jump":
        made = made * np.where(k // 5000 % 2, 1e-4, 1e4)
    return made


@pytest.mark.parametrize("level", [0.5, 0.9, 0.95])
@pytest.mark.parametrize("kind", ["gaussian", "heavy", "drift", "jump"])
@pytest.mark.parametrize("steps", [1, 5, 20])
def test_the_share_inside_is_the_level(kind, steps, level):
    errors = errors_of(kind, steps)
    intervals = fg.DelayedIntervals(steps, level)
    half_widths = intervals.run(errors)
    assert np.isnan(half_widths[:steps]).all() and np.isfinite(half_widths[steps:]).all()
    inside = np.abs(errors[steps:]) <= half_widths[steps:]
    assert intervals.coverage == pytest.approx(inside.mean(), abs=1e-12)
    assert inside.mean() == pytest.approx(level, abs=0.01)


def test_one_step_is_what_intervals_do():
    errors = np.random.default_rng(2).standard_t(4, size=80)
    errors[[3, 40]] = np.nan
    ours, theirs = fg.DelayedIntervals(1, 0.9, skip=4), fg.Intervals(0.9, skip=4)
    # up to a hundred errors both have the same mean square
    assert ours.run(errors) == pytest.approx(theirs.run(errors), rel=1e-12, nan_ok=True)
    assert ours.half_width == pytest.approx(theirs.half_width, rel=1e-12)
    assert ours.coverage == theirs.coverage


def test_an_interval_is_known_when_its_forecast_is_made():
    errors = errors_of("drift", 5, 300)
    whole, single = fg.DelayedIntervals(5, 0.9, skip=7), fg.DelayedIntervals(5, 0.9, skip=7)
    had, issued = whole.run(errors), []
    for error in errors:
        single.update(error)
        issued.append(single.half_width)
    assert np.array_equal(had[5:], issued[:-5], equal_nan=True)
    # what comes later does not change it
    other = np.r_[errors[:200], 1e3 * errors[200:]]
    assert np.array_equal(fg.DelayedIntervals(5, 0.9, skip=7).run(other)[:205], had[:205], True)


def test_units_do_not_matter():
    errors = errors_of("gaussian", 5, 500)
    plain, other = (fg.DelayedIntervals(5, 0.9).run(scale * errors) for scale in (1.0, 1e-9))
    assert other * 1e9 == pytest.approx(plain, rel=1e-9, nan_ok=True)


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: fg.DelayedIntervals(0), "steps = 0, allowed: whole numbers from 1 on"),
        (lambda: fg.DelayedIntervals(1.5), "steps = 1.5"),
        (lambda: fg.DelayedIntervals(2, 1.0), "level = 1"),
        (lambda: fg.DelayedIntervals(2, rate=0.0), "rate = 0"),
        (lambda: fg.DelayedIntervals(2, skip=-1), "skip = -1"),
        (lambda: fg.DelayedIntervals(2).update(np.inf), "error = inf"),
        (lambda: fg.DelayedIntervals(2).run([1.0, np.inf]), "sample 1: error = inf"),
        (lambda: fg.DelayedIntervals(2).run([[1.0]]), "errors has shape"),
    ],
)
def test_what_is_refused_is_named(call, words):
    with pytest.raises(fg.InvalidInput, match=words):
        call()


def test_a_refused_record_changes_nothing_and_it_pickles():
    intervals = fg.DelayedIntervals(3, 0.8)
    intervals.run(errors_of("gaussian", 3, 50))
    before = pickle.dumps(intervals)
    with pytest.raises(fg.InvalidInput):
        intervals.run([3.0, np.inf])
    with pytest.raises(fg.InvalidInput):
        intervals.update(-np.inf)
    assert pickle.dumps(intervals) == before
    again, errors = copy.deepcopy(intervals), [1.0, -3.0, 0.2, 1.0]
    assert np.array_equal(again.run(errors), pickle.loads(before).run(errors))
