"""What is said where a library is not installed, and that nothing else needs it."""

from __future__ import annotations

import subprocess
import sys

import pytest

WITHOUT = """
import sys
for name in ("sklearn", "river", "narwhals", "pandas", "polars", "xarray"):
    sys.modules[name] = None
import forgetting as fg
"""


def run_without(code: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-c", WITHOUT + code]
    return subprocess.run(command, capture_output=True, text=True, check=False)


@pytest.mark.parametrize("name", ["sklearn", "river"])
def test_a_door_names_the_extra_that_brings_its_library(name):
    done = run_without(f"import forgetting.{name}")
    last = done.stderr.strip().splitlines()[-1]
    advice = f"pip install 'forgetting[{name}]' brings it"
    assert last == f"ImportError: forgetting.{name} needs {name}: {advice}"


def test_arrays_need_none_of_them():
    code = "print(fg.ARX(na=1, nb=0).fit(None, [1.0, 2.0, 4.0, 8.0]).theta_.shape)"
    done = run_without(code)
    assert done.stdout == "(1,)\n", done.stderr


def test_a_frame_names_the_extra_that_reads_it():
    code = """
class Frame:
    def __arrow_c_stream__(self): ...
fg.ARX(na=1, nb=0).fit(None, Frame())
"""
    last = run_without(code).stderr.strip().splitlines()[-1]
    advice = "pip install 'forgetting[frames]' brings it"
    assert last == f"ImportError: a data frame needs narwhals: {advice}"
