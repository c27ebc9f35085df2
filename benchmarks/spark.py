"""Rows a second on Spark: `forgetting.spark` beside plain pandas UDFs, in one run.

python -m benchmarks.spark [ROWS] [KEYS]    needs what `make spark` installs

Seconds are of the processor's time of all processes of Spark (driver, Java and Python workers), in
which others on the machine do not count; each case has run once, on fewer rows, before. What the
cases come to is compared before a time counts.
"""

from __future__ import annotations

from . import environment  # isort: skip  # noqa: F401

import os
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pyarrow as pa
from pyarrow import parquet
from pyspark.sql import SparkSession
from pyspark.sql import functions as F
from pyspark.sql.streaming import StatefulProcessor

import forgetting as fg
from forgetting.spark import identify, stateful

from .markdown import table

ROWS, KEYS, CORES = 1_000_000, 10_000, 2
BATCHES, DEVICES, SHARDS = 4, 2000, 4
SETTINGS: dict[str, Any] = {"rule": "subspace", "initial_covariance": 100.0}
DESIGN: dict[str, Any] = {"by": "key", "y": "y", "phi": ["u", "v"], "time": "t", **SETTINGS}
ROCKSDB = "org.apache.spark.sql.execution.streaming.state.RocksDBStateStoreProvider"
ESTIMATES = "key long, u double, v double"


def session(folder: Path) -> Any:
    """Spark on this machine alone."""
    os.environ |= {"SPARK_LOCAL_IP": "127.0.0.1", "PYSPARK_PYTHON": sys.executable}
    settings = {
        "spark.driver.host": "127.0.0.1",
        "spark.driver.memory": "3g",
        "spark.ui.enabled": "false",
        "spark.python.authenticate.socketTimeout": "120s",
        "spark.local.dir": str(folder),
        "spark.sql.shuffle.partitions": str(2 * CORES),
        "spark.sql.streaming.stateStore.providerClass": ROCKSDB,
    }
    builder = SparkSession.builder.master(f"local[{CORES},4]")
    for name, value in settings.items():
        builder = builder.config(name, value)
    spark = builder.getOrCreate()
    spark.sparkContext.setLogLevel("ERROR")
    return spark


def write(path: Path, rows: int, keys: int, files: int = 1) -> str:
    """Rows of many keys in any order, as Parquet."""
    random = np.random.default_rng(0)
    path.mkdir()
    for number in range(files):
        key = random.integers(0, keys, rows)
        u, v = random.standard_normal((2, rows))
        y = (1 + key / keys) * u - v + 0.1 * random.standard_normal(rows)
        times = number * rows + random.permutation(rows)
        columns = {"key": key, "t": times, "u": u, "v": v, "y": y}
        parquet.write_table(pa.table(columns), path / f"{number:03}.parquet")
    return str(path)


def batch_ours(df: Any) -> Any:
    """Rows told and states of the streams, by `identify`."""
    found = identify(df, **DESIGN).both
    return found.where("state is not null").select(
        "state.key", "state.`theta:u`", "state.`theta:v`"
    )


def batch_record(df: Any) -> Any:
    """A pandas UDF a key, which runs `RLS` over the key's rows."""

    def one(rows: pd.DataFrame) -> pd.DataFrame:
        rows = rows.sort_values("t")
        est = fg.RLS(2, **SETTINGS)
        est.run(rows[["u", "v"]].to_numpy(), rows["y"].to_numpy(), outputs=["error"])
        return pd.DataFrame([[rows["key"].iloc[0], *est.theta]], columns=["key", "u", "v"])

    return df.groupBy("key").applyInPandas(one, ESTIMATES)


def batch_samples(df: Any) -> Any:
    """A pandas UDF a key, which calls `RLS.update` for each row."""

    def one(rows: pd.DataFrame) -> pd.DataFrame:
        rows = rows.sort_values("t")
        est = fg.RLS(2, **SETTINGS)
        for phi, y in zip(rows[["u", "v"]].to_numpy(), rows["y"].to_numpy(), strict=True):
            est.update(phi, y)
        return pd.DataFrame([[rows["key"].iloc[0], *est.theta]], columns=["key", "u", "v"])

    return df.groupBy("key").applyInPandas(one, ESTIMATES)


class OneState(StatefulProcessor):
    """A state a key, an `RLS` as bytes, as one would write it without `stateful`."""

    def init(self, handle: Any) -> None:
        """Say what is kept."""
        self._kept = handle.getValueState("kept", "kept binary")

    def handleInputRows(self, key: Any, rows: Any, timerValues: Any) -> Iterator[Any]:
        """Take the key's rows of a micro-batch."""
        found = self._kept.get()
        est = fg.RLS(2, **SETTINGS) if found is None else fg.RLS.from_bytes(bytes(found[0]))
        frame = pd.concat(rows).sort_values("t")
        run = est.run(frame[["u", "v"]].to_numpy(), frame["y"].to_numpy(), outputs=["error"])
        self._kept.update((est.to_bytes(),))
        yield pd.DataFrame({"key": key[0], "t": frame["t"], "error": run.error})


def stream_ours(df: Any) -> Any:
    """`stateful`, a few shards."""
    return stateful(df, shards=SHARDS, outputs="error", **DESIGN)


def stream_one_state(df: Any) -> Any:
    """`transformWithStateInPandas` with a state a key."""
    return df.groupBy("key").transformWithStateInPandas(
        OneState(), "key long, t long, error double", "append", "none"
    )


def processor_seconds() -> float:
    """Of this process and all below it, those that have ended too."""
    ticks, pids = 0, [os.getpid()]
    while pids:
        pid = pids.pop()
        try:
            fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
            ticks += sum(map(int, fields[11:15]))
            for task in Path(f"/proc/{pid}/task").glob("*/children"):
                pids += map(int, task.read_text().split())
        except OSError:
            continue
    return ticks / os.sysconf("SC_CLK_TCK")


def timed(work: Callable[[], Any]) -> tuple[Any, float, float]:
    """What the work gives; seconds of the processor and of the clock."""
    before, start = processor_seconds(), time.perf_counter()
    found = work()
    return found, processor_seconds() - before, time.perf_counter() - start


def estimates(of: Callable[[Any], Any], spark: Any, path: str) -> pd.DataFrame:
    """The last estimates of every key."""
    found = of(spark.read.parquet(path)).toPandas()
    return found.set_axis(["key", "u", "v"], axis=1).sort_values("key", ignore_index=True)


def follow(of: Callable[[Any], Any], spark: Any, path: str, folder: Path) -> pd.DataFrame:
    """What is told of files as they come, one a micro-batch."""
    schema = spark.read.parquet(path).schema
    rows = spark.readStream.schema(schema).option("maxFilesPerTrigger", 1).parquet(path)
    written = of(rows).writeStream.option("path", str(folder / "told"))
    kept = written.option("checkpointLocation", str(folder / "checkpoint"))
    kept.trigger(availableNow=True).start().awaitTermination()
    print(state_written(folder / "checkpoint"), file=sys.stderr)
    found = spark.read.parquet(str(folder / "told")).select("key", "t", F.col("error"))
    return found.toPandas().sort_values(["t"], ignore_index=True)


def state_written(checkpoint: Path) -> str:
    """What the state store has written for all micro-batches; Spark keeps the last hundred."""
    files = [path for path in (checkpoint / "state").rglob("*") if path.is_file()]
    total = sum(path.stat().st_size for path in files)
    batches = len(list((checkpoint / "commits").glob("[0-9]*")))
    return f"state written: {total / batches / 1e6:.2f} MB a micro-batch, {batches} of them"


def report(cases: dict[str, tuple[Callable[[str], Any], int]], paths: tuple[str, str]) -> None:
    """Run all cases, compare what they come to, and print a table."""
    rows, first = [], None
    for name, (work, count) in cases.items():
        work(paths[0])
        found, processor, clock = timed(lambda work=work: work(paths[1]))
        first = found if first is None else first
        pd.testing.assert_frame_equal(first, found, check_exact=True)
        rows.append([name, f"{count / processor:,.0f}", f"{count / clock:,.0f}"])
        print(f"done: {name}", file=sys.stderr)
    print(table(["", "rows a second of the processor", "by the clock"], rows))


def tables(spark: Any, folder: Path, rows: int, keys: int) -> None:
    """A table at once."""
    print(f"{rows:,} rows of {keys:,} keys in a table, two regressors, {CORES} cores:\n")
    paths = write(folder / "few", rows // 50, keys // 50), write(folder / "many", rows, keys)
    ways = {
        "`identify`: every row told, every state kept": batch_ours,
        "pandas UDF a key, `RLS.run`: estimates only": batch_record,
        "pandas UDF a key, `RLS.update`: estimates only": batch_samples,
    }
    report({k: (lambda p, f=f: estimates(f, spark, p), rows) for k, f in ways.items()}, paths)


def streams(spark: Any, folder: Path, rows: int) -> None:
    """Files as they come."""
    print(f"\n{BATCHES} micro-batches of {rows:,} rows of {DEVICES:,} keys, RocksDB:\n")
    short = write(folder / "short", 1000, DEVICES // 50, 2)
    long = write(folder / "long", rows, DEVICES, BATCHES)
    ways = {
        f"`stateful`, {SHARDS} shards": stream_ours,
        "`transformWithStateInPandas`, a state a key": stream_one_state,
    }

    def run(of: Callable[[Any], Any]) -> Callable[[str], Any]:
        return lambda path: follow(of, spark, path, Path(tempfile.mkdtemp(dir=folder)))

    report({k: (run(f), BATCHES * rows) for k, f in ways.items()}, (short, long))


def main(rows: int = ROWS, keys: int = KEYS) -> None:
    """Tables, then streams."""
    with tempfile.TemporaryDirectory() as made:
        spark = session(Path(made))
        tables(spark, Path(made), rows, keys)
        streams(spark, Path(made), rows // 10)
        spark.stop()


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
