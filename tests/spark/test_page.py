"""The page of Spark tells the truth: its Python runs, in its order, and prints what it says."""

from __future__ import annotations

import contextlib
import importlib.util
import io
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]


def pages():
    """What reads the pages; in a folder that is no package here."""
    path = ROOT / "tests" / "pages" / "pages.py"
    spec = importlib.util.spec_from_file_location("page_blocks", path)
    module = importlib.util.module_from_spec(spec)
    sys.modules["page_blocks"] = module
    spec.loader.exec_module(module)
    return module


def test_page(spark, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    names: dict[str, object] = {"__name__": "page"}
    text = (ROOT / "docs" / "spark.md").read_text(encoding="utf-8")
    found = [block for block in pages().blocks(text) if block.kind == "python"]
    assert len(found) == 3
    for block in found:
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            exec(compile(block.text, "spark.md", "exec"), names)
        if block.printed is not None:
            assert printed.getvalue() == block.printed
