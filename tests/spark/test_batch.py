"""A table on a cluster of two workers: each row once, every stream as on one machine."""

from __future__ import annotations

import os
import threading
import time

import pyarrow as pa
import pytest
from cluster import executors, kill
from rows import SETTINGS, assert_equal_rows, assert_equal_states, table, told_alone

import forgetting as fg
from forgetting.spark import identify, load
from forgetting.tables import TableFleet

OUTPUTS = ("prediction", "error", "theta", "skipped")
DESIGN = {"by": "meter", "y": "y", "phi": ["u"], "time": "t", **SETTINGS}


def test_tables_one_after_the_other(spark, tmp_path):
    fleet, state = TableFleet("meter", "y", ["u"], time="t", **SETTINGS), None
    for day in range(2):
        given = table(seed=day, first=2000 * day, rows=2500)
        folder = str(tmp_path / f"day{day}")
        rows = spark.createDataFrame(given)
        identify(rows, state=state, outputs=OUTPUTS, keep="row", **DESIGN).save(folder)
        done = load(spark, folder)
        assert_equal_rows(done.told.toArrow(), told_alone(fleet, given, OUTPUTS))
        assert_equal_states(done.state.toArrow(), fleet)
        state = done.state
    with pytest.raises(fg.InvalidInput, match="is there already"):
        done.save(folder)
    with pytest.raises(fg.InvalidInput, match="state has the columns meter, t, row, prediction"):
        identify(rows, state=done.told, **DESIGN)


def test_a_folder_that_is_unfinished_is_refused_and_written_again(spark, tmp_path):
    folder = tmp_path / "unfinished"
    folder.mkdir()
    (folder / "part-00000.parquet").write_bytes(b"half")
    with pytest.raises(fg.InvalidInput, match="not there or unfinished"):
        load(spark, str(folder))
    given = table(rows=100, keys=3)
    identify(spark.createDataFrame(given), **DESIGN).save(str(folder))
    assert load(spark, str(folder)).told.count() == len(given)


def test_a_missing_key_ends_the_job_with_a_sentence(spark):
    given = table(rows=50, keys=3)
    keys = pa.array([None, *given.column("meter").to_pylist()[1:]], pa.string())
    rows = spark.createDataFrame(given.set_column(0, "meter", keys))
    with pytest.raises(Exception, match="key column 'meter' is missing in row"):
        identify(rows, **DESIGN).told.count()


def test_a_worker_killed_in_the_middle_of_a_job(spark, tmp_path):
    given = table(rows=60_000, keys=2000, seed=5)
    fleet = TableFleet("meter", "y", ["u"], time="t", **SETTINGS)
    expected = told_alone(fleet, given, OUTPUTS)
    before = executors(os.getpid())
    assert len(before) == 2
    killed: list[int] = []
    killer = threading.Thread(target=kill_at_work, args=(spark, before[:1], killed))
    done = identify(
        spark.createDataFrame(given), outputs=OUTPUTS, keep="row", partitions=16, **DESIGN
    )
    killer.start()
    done.save(str(tmp_path / "done"))
    killer.join()
    assert killed == before[:1]
    done = load(spark, str(tmp_path / "done"))
    assert_equal_rows(done.told.toArrow(), expected)
    assert_equal_states(done.state.toArrow(), fleet)


def kill_at_work(spark, workers, killed):
    """Kill workers when some tasks of the second stage are done and others are not."""
    tracker = spark.sparkContext.statusTracker()
    until = time.monotonic() + 120
    while time.monotonic() < until:
        for stage in tracker.getActiveStageIds():
            info = tracker.getStageInfo(stage)
            if info is not None and info.numTasks == 16 and info.numCompletedTasks >= 2:
                kill(workers)
                killed += workers
                return
        time.sleep(0.005)
