"""Command lines that the pages show with their output: they are run when the pages are written."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pandas as pd

from forgetting.demo.battery import RECORD

WIDTH, LONGEST, SECONDS = "92", 60, 300
"""Columns of the terminal, lines of output that are shown, and how long a run may take."""
RUNS = {
    "identify": [
        'forgetting identify record.csv --formula "V ~ I"',
        "forgetting identify record.csv --show",
        "forgetting identify record.csv --output V --input I --arx 1,2,0",
    ],
    "tune": ['forgetting tune record.csv --formula "V ~ I"'],
    "compare": ['forgetting compare record.csv --formula "V ~ I"'],
    "certify": ['forgetting certify record.csv --formula "V ~ I" --rule subspace'],
    "stream": ['grep -v "^,V" record.csv | forgetting stream --formula "V ~ I" | tail -n 2'],
    "fleet": [
        "forgetting fleet 'data/*.parquet' --by device --time t --output y --input u "
        "--state fleet.arrow",
        "forgetting fleet 'data/*.parquet' --by device --time t --output y --input u "
        "--state fleet.arrow",
    ],
    "rules": ["forgetting rules subspace"],
    "demo": ["forgetting demo"],
    "reproduce": ["forgetting reproduce vdf --example 9"],
}
"""Lines that are run for the page of a command, one after the other in the same folder."""


def runs(lines: list[str]) -> Iterator[str]:
    """Every line with what it prints."""
    with tempfile.TemporaryDirectory() as folder:
        prepare(Path(folder))
        for line in lines:
            yield f"```console\n$ {line}\n```"
            yield f"```{{code-block}} text\n:class: run\n\n{printed(line, Path(folder))}\n```"


def prepare(folder: Path) -> None:
    """A record, tables of four devices, and the command."""
    shutil.copy(RECORD, folder / "record.csv")
    k = np.arange(400)
    table = {"device": k % 4, "t": k, "u": np.sin(k)}
    (folder / "data").mkdir()
    pd.DataFrame(table | {"y": 2 * table["u"]}).to_parquet(folder / "data" / "day.parquet")
    command = folder / "bin" / "forgetting"
    command.parent.mkdir()
    command.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m forgetting "$@"\n')
    command.chmod(0o755)


def printed(line: str, folder: Path) -> str:
    """What a line prints; it must succeed."""
    path = f"{folder / 'bin'}{os.pathsep}{os.environ['PATH']}"
    done = subprocess.run(
        ["bash", "-o", "pipefail", "-c", line],
        cwd=folder,
        env={**os.environ, "PATH": path, "COLUMNS": WIDTH, "NO_COLOR": "1"},
        capture_output=True,
        text=True,
        timeout=SECONDS,
    )
    if done.returncode:
        raise RuntimeError(f"{line}: exit code {done.returncode}: {done.stderr}{done.stdout}")
    lines = [each.rstrip() for each in done.stdout.strip("\n").splitlines()]
    more = [f"... and {len(lines) - LONGEST} lines more"] if len(lines) > LONGEST else []
    return "\n".join([*lines[:LONGEST], *more])
