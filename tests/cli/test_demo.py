"""`forgetting demo`: what it prints, and the sentence when the records are not installed."""

from __future__ import annotations

import importlib.util
import shlex
import subprocess
import sys
from importlib.metadata import PackageNotFoundError
from io import StringIO
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from forgetting.demo import DEMOS
from forgetting.demo.battery import RECORD, identified
from forgetting.demo.outcome import Outcome

ROOT = Path(__file__).parents[2]


def test_prints_the_table_and_the_files(forgetting, tmp_path, monkeypatch):
    folders = []

    def fake(folder):
        folders.append(folder)
        return Outcome([folder / "page.html"], "Title", ("rule", "mass"), [("none", "[87] ± 2")])

    for name in DEMOS:
        monkeypatch.setitem(DEMOS, name, fake)
    run = forgetting("demo", "all", "--output", tmp_path / "new" / "folder")
    assert run.code == 0 and folders == [tmp_path / "new" / "folder"] * len(DEMOS)
    assert folders[0].is_dir()
    assert "[87] ± 2" in run.out and f"wrote {folders[0] / 'page.html'}" in run.out
    assert forgetting("demo", "solar", "-o", tmp_path).code == 0 and len(folders) == len(DEMOS) + 1


@pytest.mark.parametrize(
    ("name", "package"), [("solar", "pvanalytics==0.2.2"), ("cycling", "sweat==0.25.0")]
)
def test_records_that_are_not_installed(forgetting, tmp_path, monkeypatch, name, package):
    def nothing(_):
        raise PackageNotFoundError

    monkeypatch.setattr("forgetting.demo.packaged.distribution", nothing)
    run = forgetting("demo", name, "-o", tmp_path)
    assert f"which is not installed; pip install --no-deps {package}" in run.sentence()


def test_the_record_that_ships(forgetting, tmp_path, monkeypatch):
    """It is copied and identified without any other package, and the lines to try next run."""
    monkeypatch.chdir(tmp_path)
    run = forgetting("demo")
    record = Path("forgetting-demo/battery.csv")
    assert run.code == 0 and f"wrote {record}" in run.out
    assert record.read_bytes() == RECORD.read_bytes() and RECORD.stat().st_size < 100_000
    lines = run.out.partition("Try next:")[2].strip().splitlines()
    assert len(lines) == 4
    for line in lines:
        assert forgetting(*shlex.split(line)[1:]).code == 0, line


def test_the_resistance_that_the_record_was_computed_with_is_found():
    """45 mΩ at the end; the resistance grows by 1.5 mΩ in the 200 samples behind an estimate."""
    found = identified()["bank"]
    resistance = -1000 * found.theta[:, 1, 0]
    assert resistance[-1] == pytest.approx(45.0, abs=1.5)
    assert resistance[100:500].mean() == pytest.approx(30 + 15 * 300 / 2000, abs=1.5)


def test_the_record_is_what_its_generator_writes():
    spec = importlib.util.spec_from_file_location("battery", ROOT / "tools" / "battery.py")
    tool = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(tool)
    made, kept = (
        pd.read_csv(file, skiprows=3, header=None) for file in (StringIO(tool.text()), RECORD)
    )
    assert made[0].equals(kept[0]) and np.array_equal(made.isna(), kept.isna())
    # another machine may round a number the other way
    apart = np.abs(made[[1, 2, 3]] - kept[[1, 2, 3]]).max()
    assert (apart < [0.0011, 0.011, 0.11]).all()


def test_the_package_is_a_command():
    done = subprocess.run(
        [sys.executable, "-m", "forgetting", "--help"], capture_output=True, text=True, timeout=60
    )
    assert done.returncode == 0 and "Usage: forgetting" in done.stdout and done.stderr == ""
