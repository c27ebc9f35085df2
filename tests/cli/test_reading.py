"""What the command reads, how it says so, and what it will not write over."""

from __future__ import annotations

import io
import json
import os
import subprocess
import sys
import threading

import numpy as np
import pandas as pd
import pytest

COMMAND = [sys.executable, "-m", "forgetting.cli"]
COMMANDS = ("identify", "compare", "certify")
TEXT = "Zeit [s];I;V\n0;1,0;5\n1;2,0;?\n2;-200;11\n9;3,5;12,5\n10;4,0;14\n11;0,5;3,5\n"


@pytest.fixture
def logger(tmp_path):
    path = tmp_path / "logger.txt"
    path.write_text(f"Logger 7\nSerial;0815\n\n{TEXT}", encoding="utf-8")
    return path


@pytest.mark.parametrize("command", COMMANDS)
def test_show_says_how_a_record_is_read(forgetting, logger, command):
    run = forgetting(command, logger, "--show", "--missing", "-200")
    assert (run.code, run.err) == (0, "")
    for words in (
        "delimited text, separator semicolon, decimal comma, encoding utf-8",
        "6 of 3 columns",
        "'Zeit [s]' (numbers in s), 1 gap: 1 step over 1.5 s",
        "3 lines above the names",
        "? taken as missing, 1 cell",
        "-200 taken as missing, 1 cell",
    ):
        assert words in run.out, words


def test_the_result_says_it_too(forgetting, logger, tmp_path):
    model = ("-f", "V ~ 0 + lag(I)", "--missing", "-200", "-r", "none")
    run = forgetting("identify", logger, *model, "--report", tmp_path / "r.html")
    assert "clock 'Zeit [s]'" in run.out and "it cut the lags of 0 rows" in run.out
    page = (tmp_path / "r.html").read_text(encoding="utf-8")
    assert "separator semicolon" in page and "-200 taken as missing, 1 cell" in page
    wide = forgetting("identify", logger, "-f", "V ~ 0 + lag(I)", "--gap", "1min", "--json")
    strict = forgetting("identify", logger, "-f", "V ~ 0 + lag(I)", "--json")
    blind = forgetting("identify", logger, "-f", "V ~ 0 + lag(I)", "--time", "none", "--json")
    told = [json.loads(run.out)["clock"] for run in (wide, strict, blind)]
    assert [told[0]["lags_cut"], told[1]["lags_cut"], told[2]] == [0, 1, None]
    found = json.loads(strict.out)["read_as"]
    assert found["separator"] == "semicolon" and found["skipped"][0] == "3 lines above the names"


def test_all_commands_take_the_same_ways_of_reading(forgetting, logger):
    ways = ("--missing", "-200", "--gap", "1min", "--time", "Zeit [s]", "--encoding", "utf-8")
    for command in COMMANDS:
        run = forgetting(command, logger, "-f", "V ~ I", *ways)
        assert (run.code, run.err) == (0, ""), command
        assert "has no parts" in forgetting(command, logger, "--show", "--part", "x").sentence()
        assert "above zero" in forgetting(command, logger, "--show", "--gap", "soon").sentence()


@pytest.mark.parametrize("command", COMMANDS)
def test_standard_input_and_pipes(forgetting, monkeypatch, command, logger, tmp_path):
    arguments = ("-f", "V ~ I", "--missing", "-200")
    text = logger.read_bytes()
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(text)))
    run = forgetting(command, "-", *arguments)
    assert (run.code, run.err) == (0, "")
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    writer = threading.Thread(target=pipe.write_bytes, args=(text,))
    writer.start()
    again = forgetting(command, pipe, *arguments)
    writer.join()
    assert (again.code, again.err) == (0, "")
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO()))
    assert forgetting(command, "-").sentence() == "forgetting: standard input is empty.\n"


@pytest.fixture
def wound(tmp_path):
    """A record on which exponential forgetting winds up."""
    x = np.random.default_rng(0).normal(size=600)
    x[300:] = 0.0
    pd.DataFrame({"x": x, "y": 3 * x}).to_csv(tmp_path / "wound.csv", index=False)
    return tmp_path / "wound.csv"


@pytest.fixture
def closed():
    """The end of a pipe that can be written to, whose reader has left."""
    read_end, write_end = os.pipe()
    os.close(read_end)
    with os.fdopen(write_end, "w") as end:
        yield end


@pytest.mark.parametrize(("rule", "code"), [("exponential", 1), ("subspace", 0)])
@pytest.mark.parametrize("form", [[], ["--json"]])
def test_a_closed_pipe_changes_no_exit_code(
    forgetting, monkeypatch, wound, closed, rule, code, form
):
    monkeypatch.setattr(sys, "stdout", closed)
    run = forgetting("certify", wound, "-f", "y ~ 0 + x", "-r", rule, "-l", "0.95", *form)
    assert (run.code, run.err) == (code, "")


def test_a_closed_pipe_changes_no_exit_code_of_a_process(wound, closed):
    """What Python flushes at its exit would make it 120."""
    arguments = ["certify", str(wound), "-f", "y ~ 0 + x", "-r", "exponential", "-l", "0.95"]
    done = subprocess.run([*COMMAND, *arguments], stdout=closed, stderr=subprocess.PIPE)
    assert (done.returncode, done.stderr) == (1, b"")


@pytest.mark.parametrize("arguments", [["rules"], ["rules", "subspace"], ["--help"]])
def test_a_closed_pipe_is_quiet(closed, arguments):
    done = subprocess.run([*COMMAND, *arguments], stdout=closed, stderr=subprocess.PIPE)
    assert (done.returncode, done.stderr) == (0, b"")


def test_a_closed_pipe_stops_no_report(forgetting, monkeypatch, wound, closed, tmp_path):
    monkeypatch.setattr(sys, "stdout", closed)
    report = tmp_path / "r.html"
    run = forgetting("identify", wound, "-f", "y ~ 0 + x", "--report", report)
    assert (run.code, run.err) == (0, "")
    assert report.exists()


@pytest.mark.parametrize("how", ["same", "link", "hard"])
@pytest.mark.parametrize("suffix", ["csv", "parquet"])
def test_the_record_is_not_written_over(forgetting, battery, tmp_path, how, suffix):
    record = tmp_path / f"record.{suffix}"
    table = pd.read_csv(battery)
    table.to_csv(record, index=False) if suffix == "csv" else table.to_parquet(record)
    before = record.read_bytes()
    target = record if how == "same" else tmp_path / f"other.{suffix}"
    if how == "link":
        target.symlink_to(record)
    elif how == "hard":
        target.hardlink_to(record)
    run = forgetting("identify", record, "-f", "V ~ I", "--estimates", target)
    assert "is the record that is read" in run.sentence()
    assert record.read_bytes() == before


def test_two_outputs_are_refused_before_the_work(forgetting, battery, tmp_path):
    (tmp_path / "a.html").write_text("old")
    (tmp_path / "b.png").hardlink_to(tmp_path / "a.html")
    outputs = ("--report", tmp_path / "a.html", "--plot", tmp_path / "b.png")
    run = forgetting("identify", battery, "-f", "V ~ I", *outputs)
    assert "--plot and --report are one file" in run.sentence()
    assert (tmp_path / "a.html").read_text() == "old"
    record = battery.rename(tmp_path / "odd.html")
    run = forgetting("compare", record, "-f", "V ~ I", "--report", record)
    assert "is the record that is read" in run.sentence()


def test_many_regressors_take_seconds_not_minutes(forgetting, tmp_path):
    rng = np.random.default_rng(0)
    frame = pd.DataFrame(rng.normal(size=(600, 150)), columns=[f"x{k}" for k in range(150)])
    frame.assign(y=frame.sum(axis=1)).to_parquet(tmp_path / "wide.parquet")
    terms = " + ".join(frame.columns)
    run = forgetting("identify", tmp_path / "wide.parquet", "-f", f"y ~ 0 + {terms}", "--json")
    assert json.loads(run.out)["samples"]["used"] == 600
