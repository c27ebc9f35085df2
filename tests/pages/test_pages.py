"""The pages tell the truth: their Python and their commands run, in their order, as they stand.

``record.csv`` is the record that ships with the package, copied by the commands of the pages
themselves, or put there where a page does not; ``data`` is a folder of tables with devices.
"""

from __future__ import annotations

import contextlib
import io
import os
import re
import shlex
import shutil
import signal
import subprocess
import sys

import numpy as np
import pandas as pd
import pytest

from forgetting.cli import main
from forgetting.demo.battery import RECORD

from .pages import MARK, PAGES, ROOT, Block, blocks

NOT_RUN = {
    "firmware.md": ["make -C crates/forgetting-c install"],
    "streams.md": ["forgetting stream /var/log", "mosquitto_sub", "kcat", "socat"],
}
"""What is marked on the pages, by page and first words."""
SHELL = ("cp", "cat", "gzip", "grep")
"""Commands of the shell that a page may use."""
NEEDS = {"spark.md": "pyspark"}
"""Pages that need a library which `make test` does not install; `make spark` runs this one."""
ENDLESS = re.compile(r"--follow|tail .*-F")
"""What runs until Ctrl-C."""
WINDUP = 1
"""The exit code of `certify` where the covariance wound up."""


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """Where a reader would stand, with a command `forgetting` and a record."""
    command = tmp_path / "bin" / "forgetting"
    command.parent.mkdir()
    command.write_text(f'#!/bin/sh\nexec {shlex.quote(sys.executable)} -m forgetting "$@"\n')
    command.chmod(0o755)
    monkeypatch.setenv("PATH", str(command.parent), prepend=":")
    monkeypatch.chdir(tmp_path)
    shutil.copy(RECORD, tmp_path / "record.csv")
    many = {"device": np.arange(400) % 4, "t": np.arange(400), "u": np.sin(np.arange(400.0))}
    (tmp_path / "data").mkdir()
    pd.DataFrame(many | {"y": 2 * many["u"]}).to_parquet(tmp_path / "data" / "day.parquet")
    return tmp_path


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_page(page, folder, capsys):
    if page.name in NEEDS:
        pytest.importorskip(NEEDS[page.name])
    names: dict[str, object] = {"__name__": page.stem}
    for block in blocks(page.read_text(encoding="utf-8")):
        if not block.is_run:
            continue
        if block.kind == "command":
            run_command(block.text)
        else:
            run_python(block, names, page.name)
    capsys.readouterr()


def run_python(block: Block, names: dict[str, object], page: str) -> None:
    """Run a block behind those before it on its page."""
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec(compile(block.text, page, "exec"), names)
    if block.printed is not None:
        assert printed.getvalue() == block.printed, block.text


def run_command(line: str) -> None:
    """Run a line, or see that its target or extra exists where it would set up or build."""
    words = shlex.split(line, comments=True)
    if words[0] == "make":
        assert re.search(rf"^{words[1]}:", (ROOT / "Makefile").read_text(), re.MULTILINE), line
    elif words[:2] == ["pip", "install"]:
        check_extras(words[2])
    elif words[:2] == ["python", "-m"]:
        assert list(ROOT.glob(words[2].replace(".", "/") + "*")), line
    elif ENDLESS.search(line):
        run_until_stopped(line)
    elif words[0] == "forgetting" and not {"|", ">", "&&"} & set(words):
        code = main(words[1:])
        assert code == 0 or (words[1] == "certify" and code == WINDUP), line
    else:
        assert words[0] in (*SHELL, "forgetting"), f"{line} is no command that a page may use"
        done = subprocess.run(
            ["bash", "-o", "pipefail", "-c", line], capture_output=True, text=True, timeout=120
        )
        assert (done.returncode, done.stderr) == (0, ""), line


def run_until_stopped(line: str) -> None:
    """Run a line that has no end until it has written something, then press Ctrl-C."""
    with subprocess.Popen(
        ["bash", "-c", line], stdout=subprocess.PIPE, text=True, start_new_session=True
    ) as started:
        assert started.stdout is not None
        first = started.stdout.readline()
        os.killpg(started.pid, signal.SIGINT)
        assert first, line
        started.stdout.read()
        assert started.wait(60) in (0, 130, -signal.SIGINT), line


def check_extras(package: str) -> None:
    """See that the extras that pip is asked for are those of the package."""
    text = (ROOT / "pyproject.toml").read_text()
    name, _, extras = package.rstrip("]").partition("[")
    assert name in ("forgetting", "."), package
    for extra in filter(None, extras.split(",")):
        assert re.search(rf"^{extra} = \[", text, re.MULTILINE), package


def test_what_is_not_run_is_known():
    marked = {}
    for page in PAGES:
        for block in blocks(page.read_text(encoding="utf-8")):
            if not block.is_run:
                marked.setdefault(page.name, []).append(block.text)
    assert marked.keys() == NOT_RUN.keys(), f"{MARK}: {marked}"
    for page, texts in marked.items():
        assert len(texts) == len(NOT_RUN[page])
        for text, first in zip(texts, NOT_RUN[page], strict=True):
            assert text.startswith(first)


def test_blocks_of_all_kinds_are_found():
    page = (
        "text\n\n    make demo   # why\n\n- a list\n    goes on\n\n"
        "```python\nprint(1)\n```\n```text\n1\n```\n\n"
        "    forgetting rules\n    forgetting demo\n\n```text\nno output\n```\n"
    )
    assert [(block.kind, block.text, block.printed) for block in blocks(page)] == [
        ("command", "make demo   # why", None),
        ("python", "print(1)\n", "1\n"),
        ("command", "forgetting rules", None),
        ("command", "forgetting demo", None),
    ]
    count = sum(len(blocks(page.read_text(encoding="utf-8"))) for page in PAGES)
    assert count > 50
