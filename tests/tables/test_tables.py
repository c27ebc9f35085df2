"""What comes in and what goes out: libraries, keys, times, counts."""

from __future__ import annotations

from datetime import datetime, timedelta

import numpy as np
import polars as pl
import pyarrow as pa
import pytest
from streams import ROWS, new, numbers, shuffled, table

import forgetting as fg
from forgetting.tables import TableFleet


@pytest.mark.parametrize(
    "exported",
    [
        lambda t: t,
        lambda t: t.to_batches()[0],
        lambda t: t.to_reader(),
        lambda t: pl.from_arrow(t),
        lambda t: pl.from_arrow(t).with_columns(pl.col("key").cast(pl.Categorical)),
        lambda t: t.to_pandas(),
        lambda t: t.to_pandas().astype({"key": "category"}),
        lambda t: t.to_pydict(),
        lambda t: pa.concat_tables([t.slice(0, 100), t.slice(100, 0), t.slice(100)]),
    ],
    ids=[
        "table",
        "batch",
        "reader",
        "polars",
        "categories",
        "pandas",
        "category",
        "dict",
        "chunks",
    ],
)
def test_whatever_exports_arrow(exported):
    given = shuffled(table())
    one, other = new(), new()
    told, expected = one.update(exported(given)), other.update(given)
    assert told.drop_columns("key").equals(expected.drop_columns("key"))
    assert [str(k) for k in told.column("key").to_pylist()] == given.column("key").to_pylist()
    assert [one[key].to_bytes() for key in one] == [other[k].to_bytes() for k in other]


def test_one_fleet_takes_tables_of_several_libraries():
    fleet, given = new(), table()
    for k, part in enumerate((given, pl.from_arrow(given), given.to_pandas())):
        fleet.update(part.slice(200 * k, 200) if k < 2 else part[400:])
    whole = new()
    whole.update(given)
    assert [fleet[key].to_bytes() for key in whole] == [whole[k].to_bytes() for k in whole]


@pytest.mark.parametrize(
    "keys",
    [
        [5, -3, 5, 0],
        [2**62, -(2**62), 2**62, 1],
        ["é", "", "é", "b"],
        [b"\0", b"", b"\0", b"x"],
        [1.5, -0.25, 1.5, 0.0],
        [datetime(2026, 1, 1), datetime(2025, 1, 1), datetime(2026, 1, 1), datetime(1969, 1, 1)],
        [timedelta(seconds=1), timedelta(0), timedelta(seconds=1), timedelta(days=3)],
    ],
    ids=lambda keys: type(keys[0]).__name__,
)
def test_keys_of_any_type(keys):
    fleet = TableFleet("key", "y", "x")
    given = pa.table({"key": keys, "x": [1.0, 2.0, 3.0, 4.0], "y": [2.0, 2.0, 6.0, 4.0]})
    told = fleet.update(given)
    assert told.column("key").equals(given.column("key"))
    assert fleet.keys() == [keys[0], keys[1], keys[3]]
    assert [fleet[key].samples for key in fleet] == [2, 1, 1]
    again = TableFleet.from_arrow(fleet.to_arrow())
    assert again.keys() == fleet.keys() and again.update(given).equals(fleet.update(given))


def test_few_rows_and_many_keys_find_the_same_streams():
    fleet = TableFleet("key", "y", "x")
    fleet.update({"key": np.arange(1000), "x": np.ones(1000), "y": np.arange(1000.0)})
    fleet.update({"key": [7, 2000, 7], "x": [1.0, 1.0, 1.0], "y": [7.0, 5.0, 7.0]})
    assert (fleet[7].samples, fleet[8].samples, fleet[2000].samples, len(fleet)) == (3, 1, 1, 1001)


def test_what_was_told_does_not_change_with_later_batches():
    fleet = new()
    told, standing = fleet.update(ROWS, "theta"), fleet.estimates()
    before = told.to_pylist(), standing.to_pylist()
    fleet.update(ROWS, "theta")
    assert (told.to_pylist(), standing.to_pylist()) == before


def test_late_rows_are_counted_and_left_out():
    fleet = new()
    fleet.update(ROWS)
    before = fleet["a"].to_bytes()
    told = fleet.update({"key": ["a", "b", "c"], "t": [1, 1, 0], "x": [1.0] * 3, "y": [9.0] * 3})
    assert told.column("skipped").to_pylist() == ["late", None, None]
    assert fleet["a"].to_bytes() == before and fleet["b"].samples == 2
    counts = fleet.estimates().select(["key", "t", "rows", "samples", "missing", "late"])
    assert counts.to_pylist() == [
        {"key": "a", "t": 2, "rows": 3, "samples": 2, "missing": 0, "late": 1},
        {"key": "b", "t": 1, "rows": 2, "samples": 2, "missing": 0, "late": 0},
        {"key": "c", "t": 0, "rows": 1, "samples": 1, "missing": 0, "late": 0},
    ]


def test_rows_without_a_value_are_counted_and_left_out():
    fleet = new()
    told = fleet.update(
        {
            "key": ["a"] * 5,
            "t": [1, None, 3, 4, 5],
            "x": [1.0, 1.0, None, float("nan"), 1.0],
            "y": [1.0, 1.0, 1.0, 1.0, float("inf")],
        }
    )
    words = [None, "missing", "missing", "missing", "refused"]
    assert told.column("skipped").to_pylist() == words
    assert [error is None for error in told.column("error").to_pylist()] == [False] + [True] * 4
    (row,) = fleet.estimates().to_pylist()
    assert (row["rows"], row["samples"], row["missing"], row["t"]) == (5, 1, 3, 5)


def test_what_float32_cannot_hold_is_refused():
    fleet = TableFleet("key", "y", "x", dtype="float32")
    told = fleet.update({"key": [1] * 3, "x": [1.0, 1e300, 1.0], "y": [1.0, 1.0, -1e300]})
    assert told.column("skipped").to_pylist() == [None, "refused", "refused"]
    assert told.column("prediction").to_pylist() == [0.0, None, None]


def test_predictions_are_of_the_estimate_of_before():
    given, fleet = table(), new()
    told = fleet.update(given, ["prediction", "theta"])
    assert told.column_names == ["key", "t", "prediction", "theta:x"]
    for key in fleet:
        here = np.array(given.column("key").to_pylist()) == key
        x, y = numbers(given, "x", "y")[here].T
        theta = np.r_[0.0, numbers(told, "theta:x")[here, 0][:-1]]
        good = np.isfinite(x) & np.isfinite(y)
        prediction = numbers(told, "prediction")[here, 0]
        # y − error rounds once more than φθ
        np.testing.assert_allclose(prediction[good], x[good] * theta[good], atol=1e-12, rtol=0)
        assert np.isnan(prediction[~good]).all()


def test_times_of_any_type_order_rows():
    base = np.datetime64("2026-03-29T00:00", "s")
    order = np.array([2, 0, 3, 1])
    times = {
        "whole": order,
        "unsigned": order.astype(np.uint16),
        "real": order / 3.0,
        "dates": base + order,
        "days": (base + order * np.timedelta64(1, "D")).astype("M8[D]"),
        "durations": order.astype("m8[ms]"),
        "zoned": pa.array(base + order).cast(pa.timestamp("us", tz="Europe/Berlin")),
    }
    for name, time in times.items():
        fleet = new()
        x, y = order + 1.0, 2.0 * order + 1.0
        fleet.update({"key": ["a"] * 4, "t": time, "x": x, "y": y})
        est = fg.RLS(1)
        for k in np.argsort(order):
            est.update([x[k]], y[k])
        assert fleet["a"].to_bytes() == est.to_bytes(), name


@pytest.mark.parametrize("more", [{}, {"arx": (1, 2, 0)}], ids=["static", "lags"])
def test_an_empty_batch_is_no_news(more):
    fleet = new(**more)
    empty = pa.table(ROWS).slice(0, 0)
    assert len(fleet.update(empty)) == 0 and len(fleet) == 0
    assert fleet.estimates().num_rows == 0 and fleet.to_arrow().num_rows == 0
    again = TableFleet.from_arrow(fleet.to_arrow())
    assert len(again) == 0 and len(again.update(ROWS)) == 3
    fleet.update(ROWS)
    before = fleet.to_arrow()
    assert len(fleet.update(empty, ["theta", "skipped"])) == 0
    assert fleet.to_arrow().equals(before)


def test_units_never_matter():
    given, factor = table(), {"x": 1e6, "z": 1e-3, "y": 1024.0}
    scaled = pa.table(
        {
            n: given.column(n) if n not in factor else numbers(given, n)[:, 0] * factor[n]
            for n in given.column_names
        }
    )
    one, other = (TableFleet("key", "y", ["x", "z"], time="t", offset=True) for _ in range(2))
    told, expected = other.update(scaled), one.update(given)
    assert told.column("skipped").equals(expected.column("skipped"))
    both = numbers(told, "prediction") / 1024.0, numbers(expected, "prediction")
    np.testing.assert_allclose(*both, rtol=1e-9, atol=1e-9)
    assert other.estimates().column("status").equals(one.estimates().column("status"))
