"""The layers of the Rust crates: no room imports upwards, and no files import in a circle.

A room is a folder (or a file) directly in the `src` of a crate. The imports are read from the text
of the files, paths in the code included; comments and unit tests are left out.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

CRATES = Path(__file__).parents[2] / "crates"

LAYERS: dict[str, tuple[str, ...]] = {
    # what the loops compute with; the loops, which know slices and numbers only
    "forgetting-kernels": ("number", "kernel"),
    # types that choose instructions, and the registers of one processor
    "forgetting-cpu": ("level", "fused", "x86"),
    "forgetting": (
        "error defaults",  # what can be refused; what an estimator is when nothing is said
        "intervals",  # about predictions, from their errors alone
        "memory",  # where numbers are kept, and how they are saved
        "units",  # what regressors are measured in
        "covariance",  # P = U D Uᵀ
        "sample",  # what is learned from a sample, and what it brought
        "choice",  # parameters, registries
        "models",  # what makes regressors of signals
        "rules rates weightings gates mixers",  # the choices; none needs another
        "monitor",  # windup, excitation, noise
        "estimator",  # one recursion
        "fleet bank",  # many of them: on samples of their own, or on the same
        "saved",  # all of it as bytes
        "compact",  # one of them, or the default bank, in as few numbers as there are
    ),
    "forgetting-runtime": (
        "error",  # what is refused, and how it is said
        "missing",  # samples of which a number is missing
        "number",  # numbers and arrays as they come and go; the number types
        "shape",  # which shapes fit
        "update",  # one sample
        "function",  # functions of the user's
        "choice",  # choices by name
        "settings",  # what an estimator is made from; defaults
        "configure",  # from settings to an estimator
        "estimator bounds window",
        "bank",
        "fleet",
        "model",  # what makes regressors of signals, with an estimator behind it
    ),
    # what only C needs
    "forgetting-c": (
        "number code",  # number types; what went wrong
        "report settings",  # structures of C
        "model",  # what is asked of an estimator
        "kind",  # the same as a table of functions
        "kinds",  # every table
        "api",  # the functions of C
    ),
    # what only Python needs
    "forgetting-py": (
        "errors",
        "conversion",
        "arrays pickle prediction",
        "bounds callable",
        "choice",
        "settings registry run update bank_update shared time",
        "samples",
        "window",
        "intervals",
        "rls bank",
        "fleet",
        "model",
    ),
    # what only JavaScript needs
    "forgetting-wasm": (
        "error types",
        "object",
        "array",
        "choice",
        "settings registry record update health",
        "rls bank",
    ),
}
"""Lowest first. A room may import those below it, and itself; rooms of one line are level."""

USE = re.compile(r"^[ \t]*(?:pub(?:\([a-z: ]+\))? )?use ([^;]+);", re.MULTILINE)
PATH = re.compile(r"(?<![$\w])(?:crate|super)(?:::\w+)+")


def code(path: Path) -> str:
    """The text of a file without comments and unit tests, which `tests.rs` is as a whole."""
    if path.name == "tests.rs":
        return ""
    text = path.read_text(encoding="utf-8")
    text = re.split(r"^#\[cfg\(test\)\]\n(?:pub )?mod \w+ \{", text, maxsplit=1, flags=re.M)[0]
    return re.sub(r"//.*", "", text)


def module_of(path: Path, source: Path) -> tuple[str, ...]:
    """The module of a file, from the root of its crate."""
    parts = path.relative_to(source).with_suffix("").parts
    return parts[:-1] if parts[-1] in ("mod", "lib") else parts


def leaves(tree: str) -> Iterator[tuple[str, ...]]:
    """Every path that a tree of `use` names."""
    tree = tree.strip()
    before, brace, inside = tree.partition("{")
    if not brace:
        if tree:
            yield tuple(part.strip() for part in tree.split(" as ")[0].split("::"))
        return
    prefix = tuple(part.strip() for part in before.split("::") if part.strip())
    depth, start, inside = 0, 0, inside.rsplit("}", 1)[0]
    for at, letter in enumerate(inside + ","):
        depth += (letter == "{") - (letter == "}")
        if letter == "," and depth == 0:
            yield from (prefix + leaf for leaf in leaves(inside[start:at]))
            start = at + 1


def absolute(path: tuple[str, ...], module: tuple[str, ...]) -> tuple[str, ...] | None:
    """A path from the root of the crate; None if it leads into another one."""
    if path[0] == "crate":
        return path[1:]
    if path[0] == "self":
        return module + path[1:]
    above = 0
    while above < len(path) and path[above] == "super":
        above += 1
    if not above:
        return None
    return module[: len(module) - above] + path[above:]


def imports(path: Path, source: Path) -> Iterator[tuple[str, ...]]:
    """The paths within the crate that a file names, from the root of the crate."""
    module, text = module_of(path, source), code(path)
    named = [leaf for tree in USE.findall(text) for leaf in leaves(tree)]
    named += [tuple(found.split("::")) for found in PATH.findall(USE.sub("", text))]
    for leaf in named:
        if (found := absolute(leaf, module)) is not None:
            yield found


def files(source: Path) -> dict[tuple[str, ...], Path]:
    """Every file of a crate by its module."""
    return {module_of(path, source): path for path in source.rglob("*.rs")}


def owner(path: tuple[str, ...], modules: dict[tuple[str, ...], Path]) -> tuple[str, ...]:
    """The module in whose file a path is defined."""
    while path not in modules:
        path = path[:-1]
    return path


@pytest.mark.parametrize("crate", LAYERS)
def test_no_room_imports_upwards(crate):
    source = CRATES / crate / "src"
    level = {room: k for k, rooms in enumerate(LAYERS[crate]) for room in rooms.split()}
    modules = files(source)
    assert {module[0] for module in modules if module} - {"testing"} == set(level)
    upward = []
    for module, path in modules.items():
        if not module or module[0] == "testing":
            continue
        for found in imports(path, source):
            other = owner(found, modules)
            if not other:
                upward.append(f"{path.relative_to(source)} takes {'::'.join(found)} from lib.rs")
            elif other[0] != module[0] and level[other[0]] >= level[module[0]]:
                upward.append(f"{path.relative_to(source)} takes {'::'.join(found)}")
    assert not upward, "\n".join(upward)


@pytest.mark.parametrize("crate", sorted(path.name for path in CRATES.iterdir()))
def test_no_files_import_in_a_circle(crate):
    source = CRATES / crate / "src"
    modules = files(source)
    graph = {}
    for module, path in modules.items():
        others = {owner(found, modules) for found in imports(path, source)}
        # a folder and its `mod.rs` are one: what a file takes from there is no step back
        graph[module] = {other for other in others if module[: len(other)] != other}
    try:
        TopologicalSorter(graph).prepare()
    except CycleError as error:
        pytest.fail(" -> ".join("::".join(module) for module in reversed(error.args[1])))


def test_all_kinds_of_imports_are_read():
    tree = "crate::{a::{B, c::D as E}, f}"
    assert list(leaves(tree)) == [("crate", "a", "B"), ("crate", "a", "c", "D"), ("crate", "f")]
    assert absolute(("super", "super", "x"), ("a", "b", "c")) == ("a", "x")
    assert absolute(("core", "fmt"), ("a",)) is None
