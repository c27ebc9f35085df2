"""The table of `make accuracy`: every peer is in it, also one that fails."""

from __future__ import annotations

import importlib
import sys
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).parents[2]


@pytest.fixture
def accuracy(monkeypatch):
    """The benchmark, with peers of ours that fail in the two ways in which one can."""
    monkeypatch.syspath_prepend(str(ROOT))
    module = importlib.import_module("benchmarks.accuracy")

    def raising(phi, y):
        raise np.linalg.LinAlgError("singular")

    def diverging(phi, y):
        return np.full(len(y), np.nan)

    def perfect(phi, y):
        return np.full(len(y), 1e-9)

    peers = {
        "raises": ("numpy", raising),
        "diverges": ("numpy", diverging),
        "perfect": ("numpy", perfect),
        "absent": ("no_such_package", perfect),
    }
    monkeypatch.setattr(module, "PEERS", peers)
    yield module
    for name in [name for name in sys.modules if name.split(".")[0] == "benchmarks"]:
        del sys.modules[name]


def test_a_peer_that_fails_or_is_absent_is_told(accuracy):
    random = np.random.default_rng(0)
    phi = random.normal(size=(300, 2))
    y = phi.sum(axis=1) + random.normal(size=300)
    lines = list(accuracy.report(iter([("noise", phi, y)])))
    assert lines[0] == "not installed: no_such_package, so no absent"
    header, cells = lines[1].split(" | "), lines[3].split(" | ")
    by_name = dict(zip(header, cells, strict=True))
    assert by_name["raises"] == "LinAlgError" and by_name["diverges"] == "not finite"
    # the error of one step is 1, and hindsight is never worse than what is told nothing
    assert float(by_name["no forgetting"]) >= 1.0
    told = {line.split(" | ")[0].strip("| "): line.split(" | ")[1:] for line in lines[4:]}
    assert told["raises"] == ["- on 0 records", "no bound", "1 |"]
    assert told["no forgetting"][2] == "- |"


def test_what_is_reported_is_the_ratio_to_hindsight(accuracy):
    random = np.random.default_rng(1)
    phi = random.normal(size=(300, 2))
    y = phi.sum(axis=1) + random.normal(size=300)
    best = accuracy.hindsight(phi, y)
    value, failed = accuracy.ratio(lambda phi, y: np.full(len(y), 3.0 * best), phi, y, best)
    assert failed == "" and value == pytest.approx(3.0)
