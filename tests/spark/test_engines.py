"""A million rows through every door; with FORGETTING_FULL=1."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


@pytest.mark.skipif(not os.environ.get("FORGETTING_FULL"), reason="takes minutes")
def test_all_engines_come_to_the_same():
    command = [sys.executable, "-m", "benchmarks.engines"]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    assert done.stdout.count("1,000,000") == 6
