"""The commands on a long record: time and peak memory of each.

python -m benchmarks.scale [ROWS] [COLUMNS]    5,000,000 rows of 8 columns if not said
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

ROWS, COLUMNS = 5_000_000, 8
PIECE = 250_000
"""Rows made and written at a time, so that making the record needs no memory of its own."""
EVERYTHING = ["--report", "page.html", "--plot", "picture.png", "--estimates", "all.parquet"]
COMMANDS = {
    "read only": ["identify", "--show"],
    "identify": ["identify"],
    "identify, all that can be asked for": ["identify", *EVERYTHING],
    "identify, exponential": ["identify", "--rule", "exponential"],
    "certify, with its page": ["certify", "--report", "certificate.html"],
    "compare, 3 rules": ["compare", "--rules", "none,exponential,subspace"],
    "compare, all rules": ["compare", "--report", "ranking.html", "--plot", "factors.png"],
}


def write(path: Path, rows: int, columns: int) -> str:
    """Write a record y = sum of the columns + noise; returns its formula."""
    random = np.random.default_rng(0)
    names = [f"x{i}" for i in range(columns)]
    schema = pa.schema([(name, pa.float64()) for name in (*names, "y")])
    with pq.ParquetWriter(path, schema) as writer:
        for start in range(0, rows, PIECE):
            x = random.normal(size=(min(PIECE, rows - start), columns))
            y = x.sum(axis=1) + random.normal(size=len(x))
            writer.write_table(pa.table(dict(zip((*names, "y"), (*x.T, y), strict=True))))
    return f"y ~ 0 + {' + '.join(names)}"


def measured(arguments: list[str], folder: Path) -> tuple[float, float, float, int]:
    """Seconds, seconds of the processor, peak memory in GB and exit code of a command.

    It has a process of its own, and writes into `folder`.
    """
    began = time.perf_counter()
    child = subprocess.Popen(
        [sys.executable, "-m", "forgetting.cli", *arguments],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        cwd=folder,
    )
    _, status, usage = os.wait4(child.pid, 0)
    seconds, busy = time.perf_counter() - began, usage.ru_utime + usage.ru_stime
    return seconds, busy, usage.ru_maxrss / 1e6, os.waitstatus_to_exitcode(status)


def main(rows: int = ROWS, columns: int = COLUMNS) -> None:
    """Make the record, run the commands and print a table."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "record.parquet"
        formula = write(path, rows, columns)
        print(f"{rows:,} rows of {columns} columns, {path.stat().st_size / 1e6:.0f} MB of Parquet")
        print("| command | seconds | of the processor | peak memory, GB |\n|---|---|---|---|")
        for name, (command, *options) in COMMANDS.items():
            arguments = [command, str(path), "-f", formula, *options]
            seconds, busy, memory, code = measured(arguments, Path(folder))
            failed = f" (exit code {code})" if code else ""
            print(f"| {name}{failed} | {seconds:.1f} | {busy:.1f} | {memory:.2f} |", flush=True)


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
