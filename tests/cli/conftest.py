"""Run the command in this process, as a shell would see it, on the records of these tests.

`fleet_rows` is a module beside them.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

from forgetting.cli import main

sys.path.insert(0, str(Path(__file__).resolve().parent))


@dataclass(frozen=True)
class Finished:
    """Exit code and streams of a command."""

    code: int
    out: str
    err: str

    def sentence(self) -> str:
        """The complaint of a refused command: one line on stderr, never a traceback."""
        assert self.code == 2
        assert self.err.startswith("forgetting: ") and self.err.endswith(".\n")
        assert self.err.count("\n") == 1 and "Traceback" not in self.err
        return self.err


@pytest.fixture
def forgetting(capsys) -> Callable[..., Finished]:
    """Call the command with arguments."""

    def run(*arguments: object) -> Finished:
        code = main([str(each) for each in arguments])
        out, err = capsys.readouterr()
        return Finished(code, out, err)

    return run


@pytest.fixture
def battery(tmp_path: Path) -> Path:
    """A cell under load: V = 0.9 V(k-1) + 0.4 + 0.05 I(k) - 0.03 I(k-1), 200 samples of 1 s."""
    rng = np.random.default_rng(11)
    current = rng.normal(size=200)
    voltage = np.full(200, 4.0)
    for k in range(1, 200):
        voltage[k] = 0.9 * voltage[k - 1] + 0.4 + 0.05 * current[k] - 0.03 * current[k - 1]
    rows = [f"{k},{current[k]!r},{voltage[k]!r}" for k in range(200)]
    rows = [row.replace("np.float64(", "").replace(")", "") for row in rows]
    path = tmp_path / "battery.csv"
    path.write_text("\n".join(["time_s,I,V", *rows]) + "\n")
    return path


@pytest.fixture
def data(tmp_path: Path) -> Path:
    """A folder of partitions of a fleet."""
    from fleet_rows import write

    folder = tmp_path / "data"
    folder.mkdir()
    write(folder)
    return folder
