"""A cluster on this machine: a driver and two workers in processes of their own."""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import forgetting

WORKERS, SHUFFLE = 2, 2
SHORT = "-XX:TieredStopAtLevel=1 -XX:+UseSerialGC"
"""Options of Java for processes that live a minute."""
ROCKSDB = "org.apache.spark.sql.execution.streaming.state.RocksDBStateStoreProvider"
TRIES, SLOW = 5, "Python worker failed to connect back"
EXECUTOR = "CoarseGrainedExecutorBackend"


def session(folder: Path) -> Any:
    """A session of Spark whose driver and workers listen on this machine only."""
    os.environ |= {
        "SPARK_LOCAL_IP": "127.0.0.1",
        "SPARK_LOCAL_HOSTNAME": "127.0.0.1",
        "PYSPARK_PYTHON": sys.executable,
        "PYSPARK_DRIVER_PYTHON": sys.executable,
    }
    from pyspark.sql import SparkSession

    settings = {
        "spark.driver.host": "127.0.0.1",
        "spark.driver.bindAddress": "127.0.0.1",
        "spark.ui.enabled": "false",
        "spark.python.authenticate.socketTimeout": "120s",
        "spark.sql.warehouse.dir": str(folder / "warehouse"),
        "spark.driver.extraJavaOptions": SHORT,
        "spark.executor.extraJavaOptions": SHORT,
        "spark.sql.codegen.wholeStage": "false",
        "spark.sql.shuffle.partitions": str(SHUFFLE),
        "spark.sql.streaming.stateStore.providerClass": ROCKSDB,
        "spark.sql.session.timeZone": "America/New_York",
        "spark.executorEnv.PYTHONPATH": str(Path(forgetting.__file__).parents[1]),
        "spark.executorEnv.OPENBLAS_NUM_THREADS": "1",
    }
    builder = SparkSession.builder.master(f"local-cluster[{WORKERS},1,1024]")
    for name, value in settings.items():
        builder = builder.config(name, value)
    started = builder.getOrCreate()
    started.sparkContext.setLogLevel("OFF")
    return started


def finish(start: Callable[[], Any]) -> None:
    """Run a query to its end, which goes on from its checkpoint if it must be started again.

    Spark gives the Python process of a stateful query ten seconds to start, whatever it is set
    to, which a busy machine may need more of.
    """
    for _ in range(TRIES):
        try:
            start().awaitTermination()
            return
        except Exception as error:
            if SLOW not in str(error):
                raise
    raise TimeoutError(f"{TRIES} times: {SLOW}")


def executors(driver: int) -> list[int]:
    """The processes of the workers below a driver's."""
    return [pid for pid in below(driver) if EXECUTOR in command(pid)]


def below(pid: int) -> list[int]:
    """All processes that a process has started, and those that these have."""
    found: list[int] = []
    for task in Path(f"/proc/{pid}/task").glob("*/children"):
        try:
            children = [int(child) for child in task.read_text().split()]
        except OSError:
            continue
        for child in children:
            found += [child, *below(child)]
    return found


def command(pid: int) -> str:
    """The command line of a process; empty when it has ended."""
    try:
        return Path(f"/proc/{pid}/cmdline").read_text().replace("\0", " ")
    except OSError:
        return ""


def kill(pids: list[int]) -> None:
    """End processes at once, as a failing machine does."""
    for pid in pids:
        os.kill(pid, signal.SIGKILL)
