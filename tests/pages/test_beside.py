"""The page beside other packages names files that exist, and figures that come out again."""

import importlib
import sys

import pytest

from .pages import ROOT

TEXT = (ROOT / "docs" / "beside.md").read_text(encoding="utf-8")
ROWS = {"a parameter goes": "change", "inputs stand still": "silence", "one of 500": "missing"}
"""First words of the rows that are measured, and what measures them."""


@pytest.fixture
def beside(monkeypatch):
    monkeypatch.syspath_prepend(str(ROOT))
    yield importlib.import_module("benchmarks.beside")
    for name in [name for name in sys.modules if name.split(".")[0] == "benchmarks"]:
        del sys.modules[name]


def test_every_test_that_is_named_exists():
    rows = [line.strip("| ").split(" | ") for line in TEXT.splitlines() if line.count("|") == 8]
    named = [name for row in rows if len(row) == 7 for name in row[-1].split(", ")]
    named = [name for name in named if name not in ("shown by", "---")]
    assert len(named) > 20
    for name in named:
        folder, _, file = name.partition(": ")
        assert (ROOT / "tests" / folder / (f"test_{file}.py" if file else "")).exists(), name


@pytest.mark.parametrize(("row", "situation"), ROWS.items())
def test_figures_come_out_again(row, situation, beside):
    line = next(line for line in TEXT.splitlines() if line.startswith(f"| {row}"))
    cells = [cell.strip() for cell in line.strip("|").split("|")][1:]
    for cell, run in list(zip(cells, beside.PACKAGES.values(), strict=True))[:3]:
        found = beside.answer(getattr(beside, situation), run)
        if cell.startswith("NaN"):
            assert found.startswith("NaN")
        elif float(cell) > 0.5:  # a covariance that grows: rounding decides how far
            assert float(found) > 0.5
        else:
            assert float(found) == pytest.approx(float(cell), abs=0.001)
