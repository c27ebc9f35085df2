"""The layers of the Python package: no file imports upwards, and no files import in a circle.

The imports are read from the text of the files: those inside functions and those for type checkers
count like any other.
"""

from __future__ import annotations

import ast
from functools import cache
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

import forgetting

ROOT = Path(forgetting.__file__).parent
NAME = "forgetting"

LAYERS: tuple[tuple[tuple[str, ...], str], ...] = (
    (("_core",), "the estimators, compiled; all numbers come from here"),
    (("words", "extras"), "text and optional libraries; they need nothing of the package"),
    (("files", "frames"), "how files are written: whole or not at all; data frames in and out"),
    (("choice",), "what every rule, rate, weighting, gate and mixer is"),
    (("judgement",), "what speaks for and against an estimate, in words; the one judge"),
    (("choices", "health", "meter", "prediction"), "rules as classes; how one estimator fares"),
    (("delayed",), "intervals about forecasts, whose errors are known late"),
    (("registry", "fleet"), "all the classes by name; how many estimators fare"),
    (("polynomials",), "what an identified model is, whoever estimated it"),
    (("models",), "they make regressors and keep an estimator behind them"),
    (("tuning",), "runs many of them and says which predicts best"),
    (("tables",), "rows of tables go to the estimator of their key"),
    (("",), "what `import forgetting` shows: all of the above, and nothing above it"),
    (("sklearn", "river", "spark"), "the estimators as other libraries and engines want them"),
    (("analysis",), "the theory applied to arrays; it has never heard of files"),
    (("record",), "files become identifications, which quote the analysis"),
    (("stream",), "lines become estimates as they come, by what a record means"),
    (("plot",), "draws analyses and identifications"),
    (("report",), "puts pictures on pages"),
    (("papers", "demo"), "use all of it on known data; neither needs the other"),
    (("cli",), "the command; nothing imports it"),
    (("__main__",), "the command as a module"),
)
"""Lowest first. A package may import those below it, and itself."""

LEVEL = {part: level for level, (parts, _) in enumerate(LAYERS) for part in parts}


@cache
def files() -> dict[str, Path]:
    """Every module of the package by its dotted name; a package stands for its `__init__`."""
    found = {}
    for path in ROOT.rglob("*.py"):
        parts = path.relative_to(ROOT).with_suffix("").parts
        parts = parts[:-1] if parts[-1] == "__init__" else parts
        found[".".join((NAME, *parts))] = path
    return found


def part_of(module: str) -> str:
    """The layer's name of a module: its first part below the package."""
    return module.split(".")[1] if "." in module else ""


def absolute(node: ast.ImportFrom, module: str) -> str:
    """The module that ``from ... import`` names, its dots resolved."""
    if not node.level:
        return node.module or ""
    is_package = files()[module].name == "__init__.py"
    above = module.split(".")[: (1 if is_package else 0) - node.level or None]
    return ".".join([*above, *([node.module] if node.module else [])])


def imports(module: str, text: str | None = None) -> set[str]:
    """Modules of the package that a module imports, wherever in it."""
    tree = ast.parse(files()[module].read_text(encoding="utf-8") if text is None else text)
    named: set[str] = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            named |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            source = absolute(node, module)
            for alias in node.names:
                inner = f"{source}.{alias.name}"
                named.add(inner if inner in files() or alias.name == "_core" else source)
    return {name for name in named if name.split(".")[0] == NAME}


def test_every_part_has_a_layer():
    assert {part_of(module) for module in files()} | {"_core"} == set(LEVEL)


@pytest.mark.parametrize("part", LEVEL)
def test_no_part_imports_upwards(part):
    for module in files():
        if part_of(module) != part:
            continue
        for other in imports(module):
            other_part = part_of(other)
            below = LEVEL[other_part] < LEVEL[part]
            assert below or other_part == part, f"{module} imports {other}, which is not below it"


def test_no_files_import_in_a_circle():
    graph = {module: imports(module) - {module} for module in files()}
    try:
        TopologicalSorter(graph).prepare()
    except CycleError as error:
        pytest.fail(" -> ".join(reversed(error.args[1])))


def test_all_kinds_of_imports_are_read():
    text = (
        "import forgetting as fg\n"
        "from . import plot\n"
        "from .. import _core\n"
        "def later():\n"
        "    from forgetting.record import identify\n"
        "if TYPE_CHECKING:\n"
        "    from ..plot.style import BLUE\n"
    )
    assert imports("forgetting.report.single", text) == {
        "forgetting",
        "forgetting.report",
        "forgetting._core",
        "forgetting.record.identify",
        "forgetting.plot.style",
    }
