"""The page of tables tells the truth: its Python runs and prints what it says."""

from __future__ import annotations

import contextlib
import importlib.util
import io
import re
from pathlib import Path

import pytest

PAGE = Path(__file__).parents[2] / "docs" / "fleets.md"
BLOCK = re.compile(r"```python\n(.*?)```\n(?:```text\n(.*?)```)?", flags=re.DOTALL)
HAS_DUCKDB = importlib.util.find_spec("duckdb") is not None


@pytest.mark.parametrize("part", ["all but DuckDB", "all"])
def test_the_python_of_the_page_runs_and_prints_what_it_says(part, tmp_path, monkeypatch):
    if part == "all" and not HAS_DUCKDB:
        pytest.skip("duckdb is not installed")
    monkeypatch.chdir(tmp_path)
    text = PAGE.read_text(encoding="utf-8")
    blocks = BLOCK.findall(text if part == "all" else text[: text.index("## DuckDB")])
    assert len(blocks) > 8
    names: dict[str, object] = {}
    for code, said in blocks:
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            exec(compile(code, PAGE.name, "exec"), names)
        assert printed.getvalue() == said, code
