"""The page of Spark tells the truth: its Python runs, in its order, and prints what it says."""

from __future__ import annotations

import contextlib
import importlib.util
import io
import shutil
import sys
from pathlib import Path

from cluster import SLOW, TRIES

ROOT = Path(__file__).parents[2]


def pages():
    """What reads the pages; in a folder that is no package here."""
    path = ROOT / "tests" / "pages" / "pages.py"
    spec = importlib.util.spec_from_file_location("page_blocks", path)
    module = importlib.util.module_from_spec(spec)
    sys.modules["page_blocks"] = module
    spec.loader.exec_module(module)
    return module


def run(text, names, folder):
    """Run a block; once more, without what it has written, where a query was too slow to start."""
    for _ in range(TRIES):
        try:
            exec(compile(text, "spark.md", "exec"), names)
            return
        except Exception as error:
            if SLOW not in str(error):
                raise
            for written in ("incoming", "checkpoint", "told"):
                shutil.rmtree(folder / written, ignore_errors=True)
    raise TimeoutError(f"{TRIES} times: {SLOW}")


def test_page(spark, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    names: dict[str, object] = {"__name__": "page"}
    text = (ROOT / "docs" / "spark.md").read_text(encoding="utf-8")
    found = [block for block in pages().blocks(text) if block.kind == "python"]
    assert len(found) == 3
    for block in found:
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            run(block.text, names, tmp_path)
        if block.printed is not None:
            assert printed.getvalue() == block.printed
