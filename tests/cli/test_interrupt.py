"""Ctrl-C ends every command with one line and exit code 130, and leaves no half file."""

from __future__ import annotations

import io
import signal
import subprocess
import sys
import time

import numpy as np
import pandas as pd
import pytest

from forgetting.record import read
from forgetting.record.formats import text

ROWS = 100_000
ARX = ["--output", "y", "--input", "u", "--arx", "3,3,0"]
UP = "import sys; from forgetting.cli import main; print('up', flush=True); "
COMMAND = UP + "sys.exit(main(sys.argv[1:]))"
ONE_STEP = UP + (
    "import hashlib, forgetting.cli.app as app\n"
    "from forgetting.files import whole\n"
    "def work(**_):\n"
    "    with whole('out.csv') as path:\n"
    "        path.write_text('half')\n"
    "        print('half', flush=True)\n"
    "        hashlib.pbkdf2_hmac('sha256', b'', b'', 2**31 - 1)\n"  # a quarter of an hour
    "app.app = work\n"
    "sys.exit(main(['rules']))\n"
)


@pytest.fixture(scope="module")
def record(tmp_path_factory):
    """A record on which every command works for seconds."""
    path = tmp_path_factory.mktemp("long") / "record.csv"
    u = np.random.default_rng(1).normal(size=ROWS)
    table = pd.DataFrame({"time": np.arange(ROWS), "u": u, "y": np.convolve(u, [1, 0.5])[:ROWS]})
    table.to_csv(path, index=False)
    return path


def interrupted(code, *arguments, folder, after="up", wait=0.0):
    """Start, press Ctrl-C some time after a line was printed, and give what is left."""
    started = subprocess.Popen(
        [sys.executable, "-c", code, *map(str, arguments)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        cwd=folder,
    )
    while started.stdout.readline().strip() != after:
        assert started.poll() is None, started.stderr.read()
    time.sleep(wait)
    started.send_signal(signal.SIGINT)
    _, told = started.communicate(timeout=60)
    return started.returncode, told


@pytest.mark.parametrize("wait", [0.1, 1.0])
@pytest.mark.parametrize(
    ("command", "outputs"),
    [
        ("identify", ["--report", "out.html", "--estimates", "out.csv", "--plot", "out.png"]),
        ("certify", []),
        ("compare", ["--report", "out.html"]),
        ("tune", ["--plot", "out.png"]),
    ],
)
def test_every_command_that_works_for_long(record, tmp_path, command, outputs, wait):
    done = interrupted(COMMAND, command, record, *ARX, *outputs, folder=tmp_path, wait=wait)
    assert done == (130, "forgetting: stopped.\n")
    assert list(tmp_path.iterdir()) == []


def test_one_step_of_a_library_that_never_ends(tmp_path):
    (tmp_path / "out.csv").write_text("old")
    done = interrupted(ONE_STEP, folder=tmp_path, after="half")
    assert done == (130, "forgetting: stopped.\n")
    assert [path.name for path in tmp_path.iterdir()] == ["out.csv"]
    assert (tmp_path / "out.csv").read_text() == "old"


def test_a_table_that_is_being_read(tmp_path, monkeypatch):
    """pandas forgets that it was Ctrl-C that stopped it."""
    path = tmp_path / "record.csv"
    path.write_text("t,x\n" + "1,2\n" * 10)

    class Stopped(io.TextIOWrapper):
        def read(self, *_):
            raise KeyboardInterrupt

    monkeypatch.setattr(text.io, "TextIOWrapper", Stopped)
    with pytest.raises(KeyboardInterrupt):
        read(path)
