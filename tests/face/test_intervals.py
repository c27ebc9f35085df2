"""Intervals that hold what they promise."""

from __future__ import annotations

import copy
import importlib
import os
import pickle
from pathlib import Path

import numpy as np
import pytest

import forgetting as fg

ROOT = Path(__file__).resolve().parents[2]


@pytest.mark.parametrize("level", [0.5, 0.9, 0.99])
@pytest.mark.parametrize("kind", ["gaussian", "heavy", "drift", "jump", "coloured"])
def test_the_share_inside_is_the_level(kind, level):
    rng = np.random.default_rng(1)
    errors = rng.normal(size=20_000)
    k = np.arange(len(errors))
    if kind == "heavy":
        errors = rng.standard_cauchy(size=len(errors))
    if kind == "drift":
        errors = errors * 10.0 ** (2 * np.sin(k / 1500))
    if kind == "jump":
        errors = errors * np.where(k // 5000 % 2, 1e-4, 1e4)
    if kind == "coloured":
        errors = np.convolve(errors, np.ones(30))[: len(errors)]
    intervals = fg.Intervals(level)
    half_widths = intervals.run(errors)
    inside = np.abs(errors[1:]) <= half_widths[1:]
    assert np.isnan(half_widths[0])
    assert intervals.coverage == pytest.approx(inside.mean(), abs=1e-12)
    assert inside.mean() == pytest.approx(level, abs=0.01)
    # over every stretch of three thousand samples, too; a fall by eight powers of ten costs more
    for stretch in np.array_split(inside, 6):
        assert stretch.mean() == pytest.approx(level, abs=0.05 if kind == "jump" else 0.02)


def test_a_record_is_samples_one_by_one_in_any_unit():
    errors = np.random.default_rng(2).standard_t(3, size=500)
    errors[[3, 100]] = np.nan
    whole, single, other = (fg.Intervals(0.9, skip=4) for _ in range(3))
    widths = whole.run(errors)
    one_by_one = []
    for error in errors:
        one_by_one.append(single.half_width)
        single.update(error)
    assert np.array_equal(widths, one_by_one, equal_nan=True)
    scaled = other.run(1024.0 * errors) / 1024.0
    assert scaled == pytest.approx(widths, nan_ok=True, rel=1e-12)
    assert np.isnan(widths[:5]).all() and np.isfinite(widths[6:]).all()


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: fg.Intervals(1.0), "level = 1, allowed: between 0 and 1"),
        (lambda: fg.Intervals(0.9, rate=0.0), "rate = 0"),
        (lambda: fg.Intervals(0.9, factor=-1.0), "factor = -1"),
        (lambda: fg.Intervals(0.9).update(np.inf), "error = inf"),
        (lambda: fg.Intervals(0.9).run([1.0, np.inf]), "sample 1: error = inf"),
        (lambda: fg.Intervals(0.9).run([[1.0]]), "errors has shape"),
    ],
)
def test_what_is_refused_is_named(call, words):
    with pytest.raises(fg.InvalidInput, match=words):
        call()


def test_a_refused_record_changes_nothing():
    intervals = fg.Intervals(0.9)
    intervals.run([1.0, 2.0])
    before = intervals.half_width
    with pytest.raises(fg.InvalidInput):
        intervals.run([3.0, np.inf])
    assert intervals.half_width == before


def test_it_pickles_and_copies():
    intervals = fg.Intervals(0.8, skip=2)
    intervals.run(np.random.default_rng(3).normal(size=50))
    for again in (pickle.loads(pickle.dumps(intervals)), copy.deepcopy(intervals)):
        errors = [1.0, -3.0, 0.2]
        twin = copy.copy(intervals)
        assert np.array_equal(again.run(errors), twin.run(errors))
        assert again.coverage == twin.coverage


RECORDS = Path(os.environ.get("FORGETTING_SHARED", ROOT.parent / "shared")) / "data"
NOISELESS = 0.05
"""Share of errors that are nothing but rounding, above which a record has no share to hold."""


@pytest.mark.skipif(not RECORDS.is_dir(), reason="the measured records are not here")
def test_measured_records_hold_the_level(monkeypatch):
    monkeypatch.syspath_prepend(str(ROOT))
    pytest.importorskip("pandas")
    records = importlib.import_module("benchmarks.accuracy_records")
    held = 0
    for name, phi, y in records.of_folder(RECORDS, None):
        n = phi.shape[1]
        errors = fg.Bank(n).run(phi, y, outputs="error").error
        if np.mean(np.abs(errors[3 * n :]) < 1e-9 * np.abs(y).max()) > NOISELESS:
            continue
        for level in (0.5, 0.9, 0.95, 0.99):
            intervals = fg.Intervals(level, skip=3 * n)
            intervals.run(errors)
            assert intervals.coverage == pytest.approx(level, abs=0.005), name
        held += 1
    assert held >= 11
