"""The README tells the truth: its table is the registry's, its Python runs."""

import contextlib
import importlib.util
import io
import re
from pathlib import Path

ROOT = Path(__file__).parents[2]
TEXT = (ROOT / "README.md").read_text(encoding="utf-8")


def test_the_table_of_rules_is_the_registrys():
    spec = importlib.util.spec_from_file_location("readme", ROOT / "tools" / "readme.py")
    tool = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(tool)
    assert tool.page(TEXT) == TEXT, "run make stubs"


def test_the_python_runs_and_says_what_it_says():
    (code,) = re.findall(r"```python\n(.*?)```", TEXT, flags=re.DOTALL)
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec(compile(code, "README.md", "exec"), {})
    assert "[3.  0.5]" in printed.getvalue()
