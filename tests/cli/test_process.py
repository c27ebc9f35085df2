"""The command as a process: exit codes, streams, missing extras, no network."""

from __future__ import annotations

import json
import subprocess
import sys

COMMAND = [sys.executable, "-m", "forgetting.cli"]


def run(*arguments, **options):
    return subprocess.run(
        [*COMMAND, *map(str, arguments)], capture_output=True, text=True, timeout=60, **options
    )


def test_identify_as_a_process(battery):
    done = run("identify", battery, "-f", "V ~ I", "--json")
    assert (done.returncode, done.stderr) == (0, "")
    assert json.loads(done.stdout)["record"] == "battery.csv"


def test_standard_input_of_a_process(battery):
    done = run("identify", "-", "-f", "V ~ I", "--json", input=battery.read_text())
    assert (done.returncode, done.stderr) == (0, "")
    assert json.loads(done.stdout)["record"] == "standard input"


def test_refusal_as_a_process(tmp_path):
    done = run("identify", tmp_path / "nothing.csv", "-f", "V ~ I")
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == f"forgetting: there is no file {tmp_path / 'nothing.csv'}.\n"


def test_reader_that_leaves(battery):
    """`forgetting rules | head -1` must not end in a traceback."""
    done = subprocess.run(
        ["sh", "-c", f"'{sys.executable}' -m forgetting.cli rules | head -1"],
        capture_output=True,
        text=True,
        timeout=60,
    )
    assert done.stderr == ""


def test_missing_extras_are_named():
    code = (
        "import sys\n"
        "import importlib.util as util\n"
        "find = util.find_spec\n"
        "util.find_spec = lambda name, *rest: None if name == 'typer' else find(name, *rest)\n"
        "from forgetting.cli import main\n"
        "sys.exit(main(['rules']))\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
    assert done.returncode == 2
    assert done.stderr == (
        "forgetting: the command needs typer; install it with pip install 'forgetting[cli]'.\n"
    )


def test_numpy_alone_is_enough_for_the_estimator():
    code = (
        "import sys, forgetting as fg\n"
        "from forgetting.analysis import excitation\n"
        "fg.ARX(1, 1, 0).fit([1.0, 2.0], [1.0, 2.0])\n"
        "excitation([[1.0], [2.0]], 1)\n"
        "heavy = {'pandas', 'matplotlib', 'formulaic', 'typer', 'rich', 'jinja2', 'pyarrow'}\n"
        "heavy |= {'scipy', 'narwhals'}\n"
        "print(sorted(heavy & set(sys.modules)))\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
    assert (done.returncode, done.stdout) == (0, "[]\n")
