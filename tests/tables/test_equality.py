"""Every stream is what one estimator a key gives, bit for bit up to ten parameters."""

from __future__ import annotations

from typing import Any

import numpy as np
import pyarrow as pa
import pytest
from streams import alone, assert_told, numbers, of_key, shuffled, table

import forgetting as fg
from forgetting.tables import TableFleet

OUTPUTS = ("prediction", "error", "leverage", "theta", "variance", "skipped")
SETTINGS: dict[str, dict[str, Any]] = {
    "default": {},
    "subspace": {"rule": "subspace", "initial_covariance": 100.0},
    "exponential": {"rule": fg.Exponential(0.9)},
    "huber": {"rule": fg.Exponential(0.95), "weighting": "huber"},
    "gated": {"rule": "exponential", "gate": fg.DeadZone(0.5), "initial_covariance": 10.0},
    "float32": {"rule": "subspace", "dtype": "float32"},
}


def phi_of(rows: pa.Table) -> np.ndarray:
    return np.column_stack([numbers(rows, "x", "z"), np.ones(len(rows))])


@pytest.mark.parametrize("settings", SETTINGS.values(), ids=list(SETTINGS))
@pytest.mark.parametrize("skewed", [False, True])
@pytest.mark.parametrize("batches", [1, 4])
def test_one_estimator_a_key(settings, skewed, batches):
    given = table(skewed=skewed)
    fleet = TableFleet("key", "y", ["x", "z"], time="t", offset=True, **settings)
    size = -(-len(given) // batches)
    parts = [shuffled(given.slice(k * size, size), k) for k in range(batches)]
    told = pa.concat_tables([fleet.update(part, OUTPUTS).unify_dictionaries() for part in parts])
    for key in set(given.column("key").to_pylist()):
        rows, est = of_key(given, key), fg.RLS(3, **settings)
        dtype = np.dtype(settings.get("dtype", "float64"))
        phi, y = phi_of(rows).astype(dtype), numbers(rows, "y")[:, 0].astype(dtype)
        assert_told(told, key, alone(est, phi, y))
        assert fleet[key].to_bytes() == est.to_bytes()


@pytest.mark.parametrize("alone_costs", [0.0, 1e12])
def test_rounds_and_records_are_the_same(monkeypatch, alone_costs):
    """Whether streams go side by side or one by one changes nothing, whatever it costs."""
    monkeypatch.setattr("forgetting.tables.pages.ALONE", alone_costs)
    test_one_estimator_a_key(SETTINGS["default"], True, 2)


def test_many_pages(monkeypatch):
    monkeypatch.setattr("forgetting.tables.pages.PAGE", 3)
    monkeypatch.setattr("forgetting.tables.pages.ROUNDS_AT_ONCE", 20)
    given = table(rows=900, keys=20)
    fleet = TableFleet("key", "y", ["x", "z"], time="t", offset=True)
    told = fleet.update(shuffled(given), OUTPUTS)
    for key in set(given.column("key").to_pylist()):
        rows, est = of_key(given, key), fg.RLS(3)
        assert_told(told, key, alone(est, phi_of(rows), numbers(rows, "y")[:, 0]))
        assert fleet[key].to_bytes() == est.to_bytes()


@pytest.mark.parametrize("batches", [1, 5])
def test_lags_are_those_of_the_own_stream(batches):
    given = table(rows=400, keys=5)
    fleet = TableFleet("key", "y", ["z"], time="t", arx=(2, 2, 1), offset=True)
    size = len(given) // batches
    for k in range(batches):
        fleet.update(shuffled(given.slice(k * size, size), k))
    for key in set(given.column("key").to_pylist()):
        y, z = numbers(of_key(given, key), "y", "z").T
        phi = np.full((len(y), 5), np.nan)
        for k in range(2, len(y)):
            phi[k] = [y[k - 1], y[k - 2], z[k - 1], z[k - 2], 1.0]
        est = fg.RLS(5)
        est.run(phi, y, missing="skip")
        assert fleet[key].to_bytes() == est.to_bytes()


@pytest.mark.parametrize("batches", [1, 5, 50])
def test_lags_do_not_reach_across_a_gap(batches):
    given = table(rows=400, keys=5)
    fleet = TableFleet("key", "y", ["z"], time="t", arx=(2, 2, 1), gap="40min")
    size = len(given) // batches
    for k in range(batches):
        fleet.update(shuffled(given.slice(k * size, size), k))
    for key in set(given.column("key").to_pylist()):
        t, y, z = numbers(of_key(given, key), "t", "y", "z").T
        phi = np.full((len(y), 4), np.nan)
        for k in range(2, len(y)):
            if t[k] - t[k - 1] <= 2400 and t[k - 1] - t[k - 2] <= 2400:
                phi[k] = [y[k - 1], y[k - 2], z[k - 1], z[k - 2]]
        assert 20 < np.isnan(phi[:, 2]).sum() < len(y) - 10
        est = fg.RLS(4)
        est.run(phi, y, missing="skip")
        assert fleet[key].to_bytes() == est.to_bytes()


@pytest.mark.parametrize("batches", [1, 3])
@pytest.mark.parametrize("dates", [False, True])
def test_half_lives_go_by_the_clock_of_each_stream(batches, dates):
    given = table(rows=300, keys=4)
    if dates:
        position = given.column_names.index("t")
        stamps = given.column("t").cast(pa.timestamp("s")).cast(pa.timestamp("ns"))
        given = given.set_column(position, "t", stamps)
    rule, size = fg.Exponential(half_life="1h"), len(given) // batches
    fleet = TableFleet("key", "y", "x", time="t", half_life="1h", rule="exponential")
    parts = [fleet.update(shuffled(given.slice(k * size, size), k)) for k in range(batches)]
    told = pa.concat_tables([part.unify_dictionaries() for part in parts])
    for key in set(given.column("key").to_pylist()):
        rows, est = of_key(given, key), fg.RLS(1, rule=rule)
        x, y = numbers(rows, "x", "y").T
        time = rows.column("t").to_numpy().astype(np.int64) / (1e9 if dates else 1.0)
        assert_told(told, key, alone(est, x[:, None], y, time))
        assert fleet[key].to_bytes() == est.to_bytes()


def test_more_than_ten_parameters_agree_to_rounding():
    random = np.random.default_rng(2)
    phi, key = random.normal(size=(500, 12)), random.integers(0, 4, size=500)
    columns = {f"x{j}": phi[:, j] for j in range(12)}
    y = phi @ random.normal(size=12) + key
    fleet = TableFleet("key", "y", list(columns))
    fleet.update({"key": key, "y": y, **columns})
    for k in range(4):
        est = fg.RLS(12)
        est.run(phi[key == k], y[key == k])
        # measured 4e-13, from sums in another order
        np.testing.assert_allclose(fleet[k].theta, est.theta, rtol=0, atol=1e-10)


@pytest.mark.parametrize("bad", [np.inf, np.nan])
@pytest.mark.parametrize("batches", [1, 3])
def test_rows_that_are_left_out_take_no_time_of_their_own(bad, batches):
    fleet = TableFleet("key", "y", "x", time="t", half_life=5.0, rule="exponential")
    rows = pa.table({"key": [1] * 3, "t": [0.0, 7.0, 20.0], "x": [1.0, bad, 2.0], "y": [1.0] * 3})
    for k in range(batches):
        fleet.update(rows.slice(k * 3 // batches, 3 // batches))
    est = fg.RLS(1, rule=fg.Exponential(half_life=5.0))
    est.update([1.0], 1.0)
    est.update([2.0], 1.0, elapsed=20.0)
    assert fleet[1].to_bytes() == est.to_bytes()
