"""How many lines a second does `forgetting stream` take, and how much memory?

    python -m benchmarks.stream [--rows 1000000]

A regression with four parameters (three inputs and a constant) by the default bank, CSV in a file,
JSON with the usual fields to a file. Seconds are those of the processor, of one process on one
core, without the start; so they depend little on what else the machine does.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np

FEW = 100
COMMAND = [sys.executable, "-m", "forgetting.cli", "stream", "-y", "y", "-u", "u,v,w"]
WAYS = {
    "usual fields": [],
    "csv": ["--to", "csv"],
    "without standard errors": ["--fields", "row,time,prediction,error,theta"],
    "a rule (exponential)": ["--rule", "exponential"],
    "with --state": ["--state", "state"],
}


@dataclass(frozen=True)
class Cost:
    """What a process took: seconds of the processor, bytes of memory at most."""

    seconds: float
    memory: int


def write(path: Path, rows: int) -> None:
    """Lines of a plant, with five decimals as sensors have them."""
    rng = np.random.default_rng(0)
    inputs = rng.normal(size=(rows, 3))
    y = inputs @ [1.0, 2.0, 3.0] + 4.0 + 0.1 * rng.normal(size=rows)
    table = np.column_stack([np.arange(rows) / 10, inputs, y])
    np.savetxt(path, table, "%.5f", ",", header="time_s,u,v,w,y", comments="")


def run(folder: Path, source: Path, more: list[str]) -> Cost:
    """Run the command and ask the system what it took."""
    environment = os.environ | {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
    with source.open("rb") as lines, (folder / "out").open("wb") as out:
        process = subprocess.Popen(
            [*COMMAND, *more], stdin=lines, stdout=out, stderr=subprocess.DEVNULL, cwd=folder,
            env=environment,
        )  # fmt: skip
        _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    assert process.returncode == 0
    (folder / "state").unlink(missing_ok=True)
    return Cost(usage.ru_utime + usage.ru_stime, usage.ru_maxrss * 1024)


def main() -> None:
    """Print a table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rows", type=int, default=1_000_000)
    rows = parser.parse_args().rows
    print(
        "| | lines a second | µs a line | MB at the end | MB after a tenth |\n|---|---|---|---|---|"
    )
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for file, count in (("few", FEW), ("tenth", rows // 10), ("all", rows)):
            write(folder / file, count)
        for way, more in WAYS.items():
            start, tenth, whole = (run(folder, folder / f, more) for f in ("few", "tenth", "all"))
            line = (whole.seconds - start.seconds) / rows
            sizes = f"{whole.memory / 1e6:.0f} | {tenth.memory / 1e6:.0f}"
            print(f"| {way} | {1 / line:,.0f} | {1e6 * line:.1f} | {sizes} |", flush=True)


if __name__ == "__main__":
    main()
