"""What a stream on Spark costs, a model of it, and where the model leads: up to 10⁹ streams.

python -m benchmarks.scale_out    needs what `make spark` installs; no Java

1. The work of one shard in one micro-batch (its bytes to streams, its rows taken, its streams to
   bytes) is timed for several numbers of streams and rows, and a + b rows + c streams fitted.
   Sizes that were not fitted, up to four times larger, say how far the model can be trusted.
2. Which shards a micro-batch touches, and how evenly shards lie on partitions, are drawn at random
   and compared with their formulas.
3. What follows for more streams than this machine holds: extrapolated, and called so.

Seconds are of the processor's time.
"""

from __future__ import annotations

from . import environment  # isort: skip  # noqa: F401

import time
from types import SimpleNamespace
from typing import Any

import numpy as np
import pyarrow as pa

from forgetting.spark.columns import types
from forgetting.spark.design import design_of
from forgetting.spark.packing import packs, unpacked
from forgetting.spark.shard import Layout

from .markdown import table

SETTINGS: dict[str, Any] = {"rule": "subspace", "initial_covariance": 100.0}
OUTPUTS = ("prediction", "error", "skipped")
N = 4
FITTED = [(s, r) for s in (250, 1000, 4000) for r in (1000, 4000, 16_000, 64_000)]
CHECKED = [(500, 500), (2000, 250_000), (16_000, 2000), (16_000, 250_000)]
REPEATS = 5
SPARK_ROW = 23.0
"""Microseconds of the processor that a row costs outside our own work (reading, shuffle, Java to
Python and back): that of `identify` in `python -m benchmarks.spark`."""
WRITES, PACKED, SECONDS = 2, 0.38, 60
"""Times that Spark writes what has changed (RocksDB's file, and its copy in the checkpoint); what
RocksDB's compression leaves of it, measured with two parameters; seconds of a micro-batch, in which
each stream has one row."""


def rows_of(streams: int, rows: int, regressors: int, first: int) -> Any:
    """Rows of random streams in any order."""
    random = np.random.default_rng(first)
    columns: dict[str, Any] = {f"x{j}": random.standard_normal(rows) for j in range(regressors)}
    key = random.integers(0, streams, rows) if first else np.arange(rows) % streams
    columns |= {"y": random.standard_normal(rows), "t": first + random.permutation(rows)}
    return pa.table({"key": key, **columns})


def layout_of(regressors: int) -> Layout:
    """How such rows are taken."""
    given = rows_of(1, 1, regressors, 0)
    df = SimpleNamespace(columns=given.column_names, schema=types(given.schema))
    names = [f"x{j}" for j in range(regressors)]
    columns = {"key": "key", "y": "y", "phi": names, "time": "t"}
    return Layout(design_of(df, OUTPUTS, (), columns | SETTINGS), 1, waits=False)


def take(layout: Layout, kept: bytes | None, packed: list[bytes]) -> tuple[bytes, int]:
    """What a worker does with a shard in a micro-batch; its bytes after it, and rows told."""
    rows = unpacked(packed, layout.design.rows)
    fleet = layout.fleet(kept)
    told = list(packs(layout.design.tell(fleet, layout.in_order(rows))))
    return layout.kept(fleet), len(told)


def begun(layout: Layout, streams: int, regressors: int) -> bytes:
    """A shard whose streams are all there."""
    rows = rows_of(streams, streams, regressors, 0).select(layout.design.rows.names)
    return take(layout, None, list(packs(rows)))[0]


def seconds(layout: Layout, streams: int, rows: int) -> float:
    """Of one micro-batch of a shard: the least of a few."""
    kept, least = begun(layout, streams, N), np.inf
    for number in range(REPEATS):
        new = rows_of(streams, rows, N, 10**6 * (number + 1)).select(layout.design.rows.names)
        packed = list(packs(new))
        start = time.process_time()
        take(layout, kept, packed)
        least = min(least, time.process_time() - start)
    return float(least)


def fitted(layout: Layout) -> np.ndarray:
    """a, b and c in seconds, by least squares of relative errors."""
    measured = np.array([seconds(layout, *size) for size in FITTED])
    x = np.array([[1.0, rows, streams] for streams, rows in FITTED])
    return np.linalg.lstsq(x / measured[:, None], np.ones(len(measured)), rcond=None)[0]


def check(layout: Layout, model: np.ndarray) -> str:
    """Sizes that were not fitted."""
    rows = []
    for streams, count in CHECKED:
        said, found = float(model @ [1.0, count, streams]), seconds(layout, streams, count)
        cells = [f"{streams:,}", f"{count:,}", f"{1e3 * said:.1f}", f"{1e3 * found:.1f}"]
        rows.append([*cells, f"{said / found:.2f}"])
    return table(["streams", "rows", "model, ms", "measured, ms", "ratio"], rows)


def sizes() -> str:
    """Bytes that a stream's state takes in its shard."""
    rows = []
    for regressors in (1, 2, 4, 6, 10, 20):
        kept = begun(layout_of(regressors), 4000, regressors)
        rows.append([str(regressors), f"{len(kept) / 4000:.0f}"])
    return table(["parameters", "bytes a stream"], rows)


def drawn() -> str:
    """Shards that a micro-batch touches, and the fullest partition, beside their formulas."""
    random, rows = np.random.default_rng(0), []
    for shards, partitions, count in ((64, 8, 100), (1000, 100, 1000), (20_000, 2000, 100_000)):
        draws = 20
        touched = [len(np.unique(random.integers(0, shards, count))) for _ in range(draws)]
        fullest = [
            np.bincount(random.integers(0, partitions, shards), minlength=partitions).max()
            for _ in range(draws)
        ]
        mean = shards / partitions
        said = (
            shards * (1 - (1 - 1 / shards) ** count),
            mean + np.sqrt(2 * mean * np.log(partitions)),
        )
        cells = [f"{shards:,}", f"{partitions:,}", f"{count:,}", f"{said[0]:,.0f}"]
        cells += [f"{np.mean(touched):,.0f}", f"{said[1] / mean:.2f}"]
        rows.append([*cells, f"{np.mean(fullest) / mean:.2f}"])
    header = ["shards", "partitions", "rows", "touched: formula", "drawn"]
    return table([*header, "fullest partition over mean: formula", "drawn"], rows)


def extrapolated(model: np.ndarray, bytes_: float) -> str:
    """Each stream has one row a minute, and a micro-batch is a minute."""
    per_shard, rows = 3000, []
    for streams in (10**6, 10**7, 10**8, 10**9):
        shards = streams / per_shard
        own = shards * float(model @ [1.0, per_shard, per_shard])
        cores = (own + 1e-6 * SPARK_ROW * streams) / SECONDS
        cells = [
            f"10^{round(np.log10(streams))}",
            f"{shards:,.0f}",
            f"{streams * bytes_ / 1e9:,.1f}",
        ]
        cells += [f"{streams / SECONDS:,.0f}", f"{cores:,.1f}"]
        written = WRITES * PACKED * streams * bytes_ / SECONDS / 1e6
        rows.append([*cells, f"{own / (own + 1e-6 * SPARK_ROW * streams):.0%}", f"{written:,.0f}"])
    header = ["streams", "shards", "state, GB", "rows/s", "cores", "of these our work"]
    return table([*header, "state written, MB/s"], rows)


def main() -> None:
    """All of it."""
    layout = layout_of(N)
    model = fitted(layout)
    a, b, c = 1e6 * model
    said = f"{a:.0f} us + {b:.2f} us a row + {c:.1f} us a stream"
    print(f"One shard, one micro-batch, n = {N}: {said}\n")
    print(check(layout, model), "\n")
    print(sizes(), "\n")
    print(drawn(), "\n")
    kept = len(begun(layout, 3000, N)) / 3000
    print(f"Extrapolated, {kept:.0f} bytes a stream, a row a stream and minute:\n")
    print(extrapolated(model, kept))


if __name__ == "__main__":
    main()
