"""Rows a second on Spark: `forgetting.spark` beside plain pandas UDFs, in one run.

python -m benchmarks.spark [ROWS] [KEYS]    needs what `make spark` installs
python -m benchmarks.spark streams          only files as they come

Seconds are of the processor's time of all processes of Spark (driver, Java and Python workers), in
which others on the machine do not count. Each case of a table has run once, on fewer rows, before;
that of a stream counts from its second micro-batch on. What the cases come to is compared before a
time counts.
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
BATCHES, DEVICES, SHARDS = 8, 2000, 4
SETTLED = 2
"""Micro-batches after which a stream is in steady state: its workers have started."""
SETTINGS: dict[str, Any] = {"rule": "subspace", "initial_covariance": 100.0}
DESIGN: dict[str, Any] = {"by": "key", "y": "y", "phi": ["u", "v"], "time": "t", **SETTINGS}
STARTS = 10
"""Times that a query is started before its workers count as unable to."""
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


def follow(
    of: Callable[[Any], Any], spark: Any, path: str, folder: Path
) -> tuple[pd.DataFrame, int, float, float]:
    """Files as they come, one a micro-batch.

    Returns what is told of all rows; how many of them came after the first `SETTLED` micro-batches,
    and what these took, seconds of the processor and of the clock.
    """
    schema = spark.read.parquet(path).schema
    rows = spark.readStream.schema(schema).option("maxFilesPerTrigger", 1).parquet(path)
    written = of(rows).writeStream.option("path", str(folder / "told"))
    kept = written.option("checkpointLocation", str(folder / "checkpoint"))
    query, first = settled(kept.trigger(availableNow=True))
    _, processor, clock = timed(query.awaitTermination)
    steady = [each["numInputRows"] for each in query.recentProgress if each["batchId"] >= first]
    print(state_written(folder / "checkpoint"), file=sys.stderr)
    found = spark.read.parquet(str(folder / "told")).select("key", "t", F.col("error"))
    return found.toPandas().sort_values(["t"], ignore_index=True), sum(steady), processor, clock


def settled(writer: Any) -> tuple[Any, int]:
    """A query that is done with its first `SETTLED` micro-batches, and with how many.

    Spark gives the Python process of a stateful query ten seconds to start. On a busy machine that
    is not always enough; the next start goes on.
    """
    for _ in range(STARTS):
        query = writer.start()
        while query.isActive and ended(query) < SETTLED:
            time.sleep(0.02)
        if query.exception() is None:
            break
    return query, ended(query)


def ended(query: Any) -> int:
    """How many micro-batches a query is done with."""
    last = query.lastProgress
    return 0 if last is None else int(last["batchId"]) + 1


def state_written(checkpoint: Path) -> str:
    """What the state store has written for all micro-batches; Spark keeps the last hundred."""
    files = [path for path in (checkpoint / "state").rglob("*") if path.is_file()]
    total = sum(path.stat().st_size for path in files)
    batches = len(list((checkpoint / "commits").glob("[0-9]*")))
    return f"state written: {total / batches / 1e6:.2f} MB a micro-batch, {batches} of them"


def show(cases: dict[str, tuple[pd.DataFrame, int, float, float]]) -> None:
    """Compare what cases come to, and print rows a second of each."""
    first = next(iter(cases.values()))[0]
    lines = []
    for name, (found, rows, processor, clock) in cases.items():
        pd.testing.assert_frame_equal(first, found, check_exact=True)
        lines.append([name, f"{rows / processor:,.0f}", f"{rows / clock:,.0f}"])
    print(table(["", "rows a second of the processor", "by the clock"], lines))


def tables(spark: Any, folder: Path, rows: int, keys: int) -> None:
    """A table at once."""
    print(f"{rows:,} rows of {keys:,} keys in a table, two regressors, {CORES} cores:\n")
    paths = write(folder / "few", rows // 50, keys // 50), write(folder / "many", rows, keys)
    ways = {
        "`identify`: every row told, every state kept": batch_ours,
        "pandas UDF a key, `RLS.run`: estimates only": batch_record,
        "pandas UDF a key, `RLS.update`: estimates only": batch_samples,
    }
    cases = {}
    for name, of in ways.items():
        estimates(of, spark, paths[0])
        found, processor, clock = timed(lambda of=of: estimates(of, spark, paths[1]))
        cases[name] = (found, rows, processor, clock)
        print(f"done: {name}", file=sys.stderr)
    show(cases)


def streams(spark: Any, folder: Path, rows: int) -> None:
    """Files as they come."""
    print(f"\nMicro-batches {SETTLED + 1} to {BATCHES} of {rows:,} rows of {DEVICES:,} keys:\n")
    path = write(folder / "long", rows, DEVICES, BATCHES)
    ways = {
        f"`stateful`, {SHARDS} shards: every row told": stream_ours,
        "`transformWithStateInPandas`, a state a key: every row told": stream_one_state,
    }
    cases = {}
    for name, of in ways.items():
        cases[name] = follow(of, spark, path, Path(tempfile.mkdtemp(dir=folder)))
        print(f"done: {name}", file=sys.stderr)
    show(cases)


def main(*arguments: str) -> None:
    """Tables, then streams."""
    sizes = [int(each) for each in arguments if each != "streams"]
    rows, keys = (*sizes, *(ROWS, KEYS)[len(sizes) :])
    with tempfile.TemporaryDirectory() as made:
        spark = session(Path(made))
        if "streams" not in arguments:
            tables(spark, Path(made), rows, keys)
        streams(spark, Path(made), rows // 10)
        spark.stop()


if __name__ == "__main__":
    main(*sys.argv[1:])
