"""A worker and the driver are killed in the middle of their work, which then goes on."""

from __future__ import annotations

import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pyarrow as pa
from cluster import below, command, executors, kill
from driver import OUTPUTS, PARTITIONS
from pyarrow import parquet
from rows import SETTINGS, assert_equal_rows, assert_equal_states, in_files, table, told_alone

from forgetting.spark import load, states
from forgetting.tables import TableFleet

HOURS, LONGEST = 6, 300


def test_each_row_once_whatever_is_killed(spark, tmp_path):
    day = table(40_000, keys=1500)
    hours = [table(3000, keys=1500, seed=k, first=40_000 * (k + 1)) for k in range(HOURS)]
    parquet.write_table(day, tmp_path / "day.parquet")
    in_files(tmp_path / "hours", hours)

    with Driver(tmp_path) as driver:
        driver.wait(lambda: some_tasks_are_done(tmp_path / "day"))
        driver.die()
    assert not (tmp_path / "day" / "_SUCCESS").exists()

    with Driver(tmp_path) as driver:
        driver.wait(lambda: in_the_middle(tmp_path / "checkpoint", 1))
        kill(executors(driver.pid)[:1])
        driver.wait(lambda: in_the_middle(tmp_path / "checkpoint", 3))
        driver.die()
    assert not (tmp_path / "checkpoint" / "commits" / "3").exists()

    with Driver(tmp_path) as driver:
        assert driver.end() == 0

    fleet = TableFleet("meter", "y", ["u"], time="t", **SETTINGS)
    done = load(spark, str(tmp_path / "day"))
    assert_equal_rows(done.told.toArrow(), told_alone(fleet, day, OUTPUTS))
    alone = [told_alone(fleet, hour, OUTPUTS).unify_dictionaries() for hour in hours]
    told = spark.read.parquet(str(tmp_path / "told")).toArrow()
    assert_equal_rows(told, pa.concat_tables(alone).sort_by("row"))
    assert_equal_states(states(spark, str(tmp_path / "checkpoint")).toArrow(), fleet)


def some_tasks_are_done(folder: Path) -> bool:
    """Whether some files of a job are there, and others are not."""
    return 2 <= len(list(folder.glob("_temporary/0/task_*"))) < PARTITIONS


def in_the_middle(checkpoint: Path, number: int) -> bool:
    """Whether a micro-batch has begun and is not done."""
    begun, done = (checkpoint / name / str(number) for name in ("offsets", "commits"))
    return begun.exists() and not done.exists()


class Driver:
    """A driver in a process of its own."""

    def __init__(self, folder: Path) -> None:
        self._log = (folder / "log.txt").open("a")
        script = str(Path(__file__).with_name("driver.py"))
        self._process = subprocess.Popen(
            [sys.executable, script, str(folder)], stdout=self._log, stderr=self._log
        )
        self.pid = self._process.pid

    def __enter__(self) -> Driver:
        return self

    def __exit__(self, *_: object) -> None:
        if self._process.poll() is None:
            self.die()
        self._log.close()

    def wait(self, condition: Callable[[], bool]) -> None:
        """Wait until the work has come so far."""
        until = time.monotonic() + LONGEST
        while not condition():
            assert self._process.poll() is None, Path(self._log.name).read_text()[-20_000:]
            assert time.monotonic() < until, "the driver did not come so far in time"
            time.sleep(0.002)

    def die(self) -> None:
        """End the driver's processes, Python and Java, at once; workers notice by themselves."""
        workers = executors(self.pid)
        own = [pid for pid in below(self.pid) if "SparkSubmit" in command(pid)]
        kill([self.pid, *own])
        self._process.wait()
        until = time.monotonic() + LONGEST
        while any(command(pid) for pid in workers) and time.monotonic() < until:
            time.sleep(0.1)

    def end(self) -> int:
        """The exit code."""
        return self._process.wait(LONGEST)
