"""Polars and DuckDB: frames and relations in, batch by batch; one `RLS` a key, bit for bit."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import polars as pl
import pyarrow as pa
import pytest
from streams import alone, assert_told, numbers, of_key, shuffled, table

import forgetting as fg
from forgetting.tables import TableFleet

OUTPUTS = ("error", "theta", "variance", "skipped")


def new() -> TableFleet:
    return TableFleet("key", "y", ["x", "z"], time="t", rule="subspace")


def assert_one_estimator_a_key(fleet: TableFleet, told: pa.Table, given: pa.Table) -> None:
    assert set(fleet) == set(given.column("key").to_pylist())
    for key in fleet:
        rows, est = of_key(given, key), fg.RLS(2, rule="subspace")
        assert_told(told, key, alone(est, numbers(rows, "x", "z"), numbers(rows, "y")[:, 0]))
        assert fleet[key].to_bytes() == est.to_bytes()


def test_a_polars_frame_in_one_call():
    given, fleet = table(), new()
    frame = pl.from_arrow(shuffled(given)).lazy().filter(pl.col("t") > 0).collect()
    told = pl.from_arrow(fleet.update(frame, OUTPUTS))
    assert frame.select("key", "t").equals(told.select("key", "t"))
    assert_one_estimator_a_key(fleet, told.to_arrow(), given)


def test_polars_frames_one_after_the_other():
    given, fleet = table(), new()
    parts = [pl.from_arrow(fleet.update(p, OUTPUTS)) for p in pl.from_arrow(given).iter_slices(77)]
    assert_one_estimator_a_key(fleet, pl.concat(parts).to_arrow(), given)


def test_duckdb_relations_and_batches(tmp_path: Path):
    duckdb = pytest.importorskip("duckdb")
    given, fleet, whole = table(), new(), new()
    with duckdb.connect(str(tmp_path / "rows.duckdb")) as base:
        base.execute("create table measured as select * from given")
        whole.update(base.sql("select * from measured order by random()"))
        reader = base.sql("select * from measured order by t").to_arrow_reader(77)
        parts = [fleet.update(batch, OUTPUTS).unify_dictionaries() for batch in reader]
        told = pa.concat_tables(parts)
        late = "select key, count(*) as rows from told group by key order by key"
        counts = dict(base.sql(late).fetchall())
    assert len(parts) > 1
    assert_one_estimator_a_key(fleet, told, given)
    assert [whole[key].to_bytes() for key in fleet] == [fleet[key].to_bytes() for key in fleet]
    standing = fleet.estimates()
    keys, rows = (standing.column(name).to_pylist() for name in ("key", "rows"))
    assert counts == dict(zip(keys, rows, strict=True)) and sum(rows) == len(given)


def test_a_nanosecond_clock_of_pandas():
    given, fleet, other = table(), new(), new()
    frame = given.to_pandas()
    frame["t"] = np.datetime64("2026-01-01", "ns") + frame["t"].to_numpy() * np.timedelta64(1, "s")
    fleet.update(frame.sample(frac=1.0, random_state=3))
    other.update(given)
    assert [fleet[key].to_bytes() for key in other] == [other[key].to_bytes() for key in other]
