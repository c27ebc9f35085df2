"""SIGKILL at random moments: no estimate is lost, none differs, and only the last are told twice.

With FORGETTING_FULL=1 over a million lines and ten kills.
"""

from __future__ import annotations

import json
import os
import subprocess
import time
from pathlib import Path

import numpy as np
import pytest

from .conftest import COMMAND, PLANT, as_csv, plant
from .test_state import rows_in

FULL = bool(os.environ.get("FORGETTING_FULL"))
ROWS, KILLS = (1_000_000, 10) if FULL else (120_000, 4)


@pytest.fixture(scope="module")
def source(tmp_path_factory) -> Path:
    path = tmp_path_factory.mktemp("kill") / "plant.csv"
    path.write_bytes(as_csv(plant(ROWS)))
    return path


@pytest.fixture(scope="module")
def whole(source) -> bytes:
    """What a process says that nobody kills."""
    out = source.with_name("whole")
    run(source, source.with_name("state of the whole"), out, True, None)
    return out.read_bytes()


def run(source: Path, state: Path, out: Path, follow: bool, enough: int | None) -> None:
    """One process, its lines behind those before; killed once it wrote so many bytes, or never."""
    arguments = [*COMMAND, *PLANT, "--fields", "row,error,theta", "--state", str(state)]
    if follow:
        arguments.insert(len(COMMAND), str(source))
    before = out.stat().st_size if out.exists() else 0
    with source.open("rb") as lines, out.open("ab") as stream:
        given = subprocess.DEVNULL if follow else lines
        process = subprocess.Popen(arguments, stdin=given, stdout=stream, stderr=subprocess.PIPE)
        deadline = time.monotonic() + 600
        while process.poll() is None and time.monotonic() < deadline:
            if enough is not None and out.stat().st_size - before >= enough:
                time.sleep(0.1 * (enough % 5))
                break
            time.sleep(0.005)
        process.kill()
        _, said = process.communicate()
    assert enough is not None or process.returncode == 0, said


@pytest.mark.parametrize("follow", [False, True], ids=["offered again", "file"])
def test_killed_and_resumed(tmp_path, source, whole, follow):
    state, out = tmp_path / "state", tmp_path / "out"
    expected = [line for line in whole.splitlines() if b'"alarm"' not in line]
    rng = np.random.default_rng(8 + follow)
    share = len(whole) // (KILLS + 1)
    saved, begins = [0], []
    for _ in range(KILLS):
        begins.append(count(out))
        run(source, state, out, follow, int(rng.integers(1, share)))
        saved.append(rows_in(state) if state.exists() else 0)
    begins.append(count(out))
    run(source, state, out, follow, None)
    lines = out.read_bytes().splitlines()
    told: set[int] = set()
    for process, start in enumerate(begins):
        stop = begins[process + 1] if process + 1 < len(begins) else len(lines)
        rows = check_process(lines[start:stop], expected)
        # It went on from the state of before: nothing before it twice, nothing behind it left out.
        if rows:
            assert rows == list(range(saved[process] + 1, saved[process] + 1 + len(rows)))
        told.update(rows)
        assert saved[process] <= len(told)
    assert told == set(range(1, ROWS + 1))
    assert max(saved) > 0


def count(out: Path) -> int:
    """Lines so far; one that was torn counts, since the next process ends it."""
    return len(out.read_bytes().splitlines()) if out.exists() else 0


def check_process(lines: list[bytes], expected: list[bytes]) -> list[int]:
    """Rows that one process told: each as the process that nobody killed told it."""
    rows: list[int] = []
    for place, line in enumerate(lines):
        try:
            told = json.loads(line)
        except ValueError:
            assert place == len(lines) - 1, "a torn line is the last of its process"
            continue
        if "alarm" in told:
            continue
        assert line == expected[told["row"] - 1]
        rows.append(told["row"])
    return rows
