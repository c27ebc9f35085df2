"""The same rows through every door: arrays, `TableFleet`, the command, Polars, DuckDB and Spark.

python -m benchmarks.engines [ROWS] [KEYS]    needs what `make spark` installs

Prints a table with what each took, and fingerprints of all rows told and all estimates; ends with
an error unless they are equal, bit for bit. Seconds are of the processor's time of all processes.
"""

from __future__ import annotations

from . import environment  # isort: skip  # noqa: F401

import sys
import tempfile
from collections.abc import Callable
from contextlib import redirect_stdout
from hashlib import sha256
from io import StringIO
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
from pyarrow import parquet

import forgetting as fg
from forgetting.tables import TableFleet

from .markdown import table
from .spark import session, timed

ROWS, KEYS, FILES = 1_000_000, 10_000, 4
SETTINGS: dict[str, Any] = {"rule": "subspace"}
COLUMNS: dict[str, Any] = {"key": "key", "y": "y", "phi": ["u", "v"], "time": "t"}
Told = tuple[Any, Any]
"""Rows told with their number, and estimates with their key, in any order."""


def made(rows: int, keys: int) -> Any:
    """Rows by time, of keys in any order; some have no measurement."""
    random = np.random.default_rng(0)
    key = random.integers(0, keys, rows)
    u, v = random.standard_normal((2, rows))
    y = (1 + key / keys) * u - v + 0.1 * random.standard_normal(rows)
    y[random.uniform(size=rows) < 0.01] = np.nan
    return pa.table({"key": key, "t": np.arange(rows), "u": u, "v": v, "y": y})


def new() -> TableFleet:
    """A fleet that has seen nothing."""
    return TableFleet(**COLUMNS, **SETTINGS)


def finished(told: Any, estimates: Any) -> Told:
    """Of tables of Arrow: the times number the rows."""
    return told.select(["t", "error"]), estimates.select(["key", "theta:u", "theta:v"])


def arrays(given: Any, folder: Path) -> Told:
    """One `RLS` a key, and a record of arrays for it."""
    key, t, *columns = (given.column(name).to_numpy() for name in ("key", "t", "u", "v", "y"))
    order = np.argsort(key, kind="stable")
    found, starts = np.unique(key[order], return_index=True)
    error, theta = np.empty(len(key)), np.empty((len(found), 2))
    for j, rows in enumerate(np.split(order, starts[1:])):
        u, v, y = (column[rows] for column in columns)
        est = fg.RLS(2, **SETTINGS)
        error[rows] = est.run(np.column_stack([u, v]), y, outputs=["error"], missing="skip").error
        theta[j] = est.theta
    told = pa.table({"t": t, "error": pa.array(error, from_pandas=True)})
    names = {"theta:u": theta[:, 0], "theta:v": theta[:, 1]}
    return finished(told, pa.table({"key": found, **names}))


def fleet(given: Any, folder: Path) -> Told:
    """`TableFleet`, one table."""
    made = new()
    return finished(made.update(given), made.estimates())


def command(given: Any, folder: Path) -> Told:
    """`forgetting fleet` over a few files."""
    from forgetting.cli import main

    for number in range(FILES):
        size = -(-len(given) // FILES)
        parquet.write_table(given.slice(number * size, size), folder / f"{number}.parquet")
    words = ["fleet", str(folder / "*.parquet"), "--by", "key", "--time", "t", "--output", "y"]
    words += ["--input", "u", "--input", "v", "--no-offset", "--rule", SETTINGS["rule"]]
    told, streams = folder / "told", folder / "streams.parquet"
    with redirect_stdout(StringIO()):
        code = main([*words, "--out", str(told), "--streams", str(streams), "--json"])
    if code:
        raise RuntimeError("forgetting fleet has failed")
    return finished(parquet.read_table(told), parquet.read_table(streams))


def polars(given: Any, folder: Path) -> Told:
    """Frames of Polars, one after the other."""
    import polars as pl

    made, frame = new(), pl.from_arrow(given)
    assert isinstance(frame, pl.DataFrame)
    told = [pl.from_arrow(made.update(part)) for part in frame.iter_slices(100_000)]
    return finished(pl.concat(told).to_arrow(), pl.from_arrow(made.estimates()).to_arrow())


def duckdb(given: Any, folder: Path) -> Told:
    """A query of DuckDB, batch by batch."""
    import duckdb as db

    made, base = new(), db.connect()
    base.register("given", given)
    reader = base.sql("select * from given order by t").to_arrow_reader(100_000)
    told = [made.update(batch, "error") for batch in reader]
    return finished(pa.concat_tables(told), made.estimates())


def spark(given: Any, folder: Path) -> Told:
    """`forgetting.spark.identify`, saved and loaded."""
    from forgetting.spark import identify, load

    started = session(folder)
    parquet.write_table(given, folder / "given.parquet")
    rows = started.read.parquet(str(folder / "given.parquet"))
    names = {"by": "key"} | {name: COLUMNS[name] for name in ("y", "phi", "time")}
    identify(rows, outputs="error", **names, **SETTINGS).save(str(folder / "done"))
    done = load(started, str(folder / "done"))
    found = finished(done.told.toArrow(), done.state.toArrow())
    started.stop()
    return found


WAYS: dict[str, Callable[[Any, Path], Told]] = {
    "arrays, an `RLS` a key": arrays,
    "`TableFleet`": fleet,
    "`forgetting fleet`": command,
    "Polars": polars,
    "DuckDB": duckdb,
    "Spark, with its start": spark,
}


def fingerprint(found: Any) -> str:
    """Of all numbers, sorted by the first column; a null and NaN are one."""
    ordered = found.sort_by(found.column_names[0])
    columns = [column.cast(pa.float64()).to_numpy() for column in ordered.columns]
    numbers = np.column_stack(columns)
    numbers[np.isnan(numbers)] = np.nan
    return sha256(np.ascontiguousarray(numbers).tobytes()).hexdigest()[:12]


def main(rows: int = ROWS, keys: int = KEYS) -> None:
    """Go all ways, print what they come to, and compare."""
    given, lines = made(rows, keys), []
    for name, way in WAYS.items():
        with tempfile.TemporaryDirectory() as folder:
            told, processor, clock = timed(lambda way=way, at=folder: way(given, Path(at)))
        prints = [fingerprint(each) for each in told]
        times = [f"{processor:.2f}", f"{clock:.1f}"]
        lines.append([name, f"{len(told[0]):,}", f"{len(told[1]):,}", *times, *prints])
    header = ["", "rows told", "streams", "seconds of the processor", "by the clock"]
    print(table([*header, "errors", "estimates"], lines))
    if len({(*line[1:3], *line[5:]) for line in lines}) > 1:
        sys.exit("the ways differ")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
