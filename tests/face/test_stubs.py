"""What type checkers and editors are told is what is there."""

import importlib.util
import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


def load_tool():
    path = ROOT / "tools" / "stubs.py"
    spec = importlib.util.spec_from_file_location("stubs", path)
    tool = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(tool)
    return tool


def mypy(*arguments, module="mypy"):
    pytest.importorskip("mypy", reason="mypy is not installed")
    command = [sys.executable, "-m", module, *arguments]
    environment = {**os.environ, "MYPYPATH": str(ROOT / "python")}
    return subprocess.run(
        command, cwd=ROOT, env=environment, capture_output=True, text=True, check=False
    )


def test_the_stub_of_the_registries_is_fresh():
    tool = load_tool()
    assert tool.STUB.read_text(encoding="utf-8") == tool.stub(), "run python tools/stubs.py"


def test_the_stub_of_the_core_is_that_of_the_core():
    done = mypy("forgetting._core", module="mypy.stubtest")
    assert done.returncode == 0, done.stdout + done.stderr


GOOD = """
import forgetting as fg

def factor(evidence: fg.Evidence) -> float:
    return 1.0 - 0.1 * evidence.leverage

est = fg.RLS(2, rule=fg.Exponential(fg.Fortescue(memory=50.0)), weighting=fg.Huber(2.0))
fg.RLS(2, rule=fg.Subspace(factor, threshold=0.1))
fg.RLS(2, rule=fg.Exponential(fg.Schedule([0.9, 0.95], end="repeat")))
rule: fg.Rule = est.rule
kept: fg.Weighting = est.weighting
rate: fg.Rate = fg.rate("gradient")
"""

BAD = [
    'fg.Fortescue(memory="long")',
    "fg.Fortescue(window=3)",
    'fg.Schedule([0.9], end="stop")',
    "fg.Exponential(fg.Huber())",
    "fg.RLS(2, weighting=fg.Fortescue())",
    "fg.RmsRatio(short_window=2.5)",
]


def test_a_type_checker_tells_right_from_wrong(tmp_path):
    source = tmp_path / "use.py"
    lines = GOOD.strip().splitlines()
    source.write_text("\n".join(lines + BAD) + "\n", encoding="utf-8")
    done = mypy("--strict", "--no-error-summary", str(source))
    found = {line.split(":")[1] for line in done.stdout.splitlines() if ": error:" in line}
    wrong = {str(len(lines) + 1 + k) for k in range(len(BAD))}
    assert found == wrong, done.stdout + done.stderr
