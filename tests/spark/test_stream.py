"""Rows as they come: each is told once, in the order of time, as one machine tells it."""

from __future__ import annotations

from typing import Any

import pyarrow as pa
import pytest
from cluster import finish
from pyspark.sql.functions import lit
from rows import (
    SETTINGS,
    assert_equal_rows,
    assert_equal_states,
    in_files,
    in_order,
    table,
    told_alone,
)

import forgetting as fg
from forgetting.spark import stateful, states
from forgetting.spark.streaming import PROVIDER
from forgetting.tables import TableFleet

OUTPUTS = ("prediction", "error", "skipped")
DESIGN = {"by": "meter", "y": "y", "phi": ["u"], "time": "t", **SETTINGS}
FILES, ROWS = 3, 1000


def rows_of(spark, folder) -> Any:
    schema = "meter string, t timestamp, u double, y double, row bigint"
    reader = spark.readStream.schema(schema).option("maxFilesPerTrigger", 1)
    return reader.parquet(folder)


def follow(told, folder) -> pa.Table:
    """Take what is there, and say what has been told."""
    written = told.writeStream.option("path", str(folder / "told"))
    kept = written.option("checkpointLocation", str(folder / "checkpoint"))
    finish(kept.trigger(availableNow=True).start)
    return told.sparkSession.read.parquet(str(folder / "told")).toArrow()


def test_rows_as_they_come(spark, tmp_path):
    parts = [table(ROWS, seed=k, first=ROWS * k, keys=20) for k in range(FILES)]
    parts[2] = pa.concat_tables([parts[2], late(parts[0])])
    source = in_files(tmp_path / "rows", parts)
    told = stateful(rows_of(spark, source), shards=3, outputs=OUTPUTS, keep="row", **DESIGN)
    found = follow(told, tmp_path)
    fleet = TableFleet("meter", "y", ["u"], time="t", **SETTINGS)
    alone = [told_alone(fleet, part, OUTPUTS) for part in parts]
    plain = pa.concat_tables(each.unify_dictionaries() for each in alone)
    assert "late" in plain.column("skipped").to_pylist()
    assert_equal_rows(found, plain.sort_by("row"))
    kept = states(spark, str(tmp_path / "checkpoint"))
    assert_equal_states(kept.toArrow(), fleet)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"shards": 0}, "shards = 0, allowed: whole numbers from 1"),
        ({"shards": "4"}, "shards = '4'"),
        ({"time": "row", "delay": "1 hour"}, "'row' of int64, allowed: timestamps"),
        ({"keep": "shard"}, "named 'shard'"),
        ({"start": "rows"}, "state has the columns meter, t, u"),
    ],
)
def test_what_is_refused(spark, change, words):
    rows = spark.createDataFrame(table(5)).withColumn("shard", lit(1))
    if "start" in change:
        change = {"start": rows}
    with pytest.raises(fg.InvalidInput, match=words):
        stateful(rows, **DESIGN | {"shards": 2} | change)


def test_another_state_store_is_refused_with_the_line_to_write(spark):
    before = spark.conf.get(PROVIDER)
    spark.conf.set(PROVIDER, before.replace("RocksDB", "HDFSBacked"))
    try:
        with pytest.raises(fg.InvalidInput, match="must be RocksDB"):
            stateful(spark.createDataFrame(table(5)), shards=2, **DESIGN)
    finally:
        spark.conf.set(PROVIDER, before)


def late(given: pa.Table) -> pa.Table:
    """Rows that come once more, under other numbers."""
    some = given.slice(0, 10)
    numbers = pa.array([-1 - k for k in range(len(some))])
    return some.set_column(some.column_names.index("row"), "row", numbers)


def test_rows_wait_for_those_before_them(spark, tmp_path):
    whole = in_order(table(FILES * ROWS, keys=20))
    mixed = [whole.take(pa.array(range(k, len(whole), FILES))) for k in range(FILES)]
    end = table(5, keys=1, first=10_000_000, seed=9)
    source = in_files(tmp_path / "rows", [*mixed, end])
    told = stateful(
        rows_of(spark, source), shards=3, delay="2 hours", outputs=OUTPUTS, keep="row", **DESIGN
    )
    found = follow(told, tmp_path)
    fleet = TableFleet("meter", "y", ["u"], time="t", **SETTINGS)
    assert_equal_rows(found, told_alone(fleet, whole, OUTPUTS))
    assert_equal_states(states(spark, str(tmp_path / "checkpoint")).toArrow(), fleet)
