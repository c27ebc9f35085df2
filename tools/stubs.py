"""Writes python/forgetting/registry.pyi, which tells type checkers of the registries' classes.

python tools/stubs.py            writes the file
python tools/stubs.py --check    fails if it is not what would be written
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from forgetting import choices, registry

STUB = Path(__file__).parent.parent / "python" / "forgetting" / "registry.pyi"

HEAD = """\
# Written by tools/stubs.py from the registries of the core: do not edit.
# ruff: noqa: E501 (headers as they stand in the rule files)

from collections.abc import Callable, Mapping
from typing import Any, ClassVar, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._core import Evidence
from .choices import {written}
"""

TYPES = {
    "real": "float",
    "whole": "int",
    "matrix": "ArrayLike",
    "list": "ArrayLike",
    "rule": "Rule | str",
    "function": "Callable[[Evidence], float]",
}
MATRIX = "NDArray[np.float64]"
#: of R, phi and the error, all as matrices
MATRIX_FUNCTION = f"Callable[[{MATRIX}, {MATRIX}, {MATRIX}], ArrayLike]"


GATE_FUNCTION = 'Callable[[Evidence], Literal["update", "freeze", "hold"]]'


def parameter(entry: Mapping[str, Any], of: type[choices.Choice]) -> str:
    """One line of the constructor of `of`."""
    kind = entry["kind"]
    words = ", ".join(f'"{word}"' for word in entry["range"].split(", "))
    annotation = f"Literal[{words}]" if kind == "word" else TYPES[kind]
    if kind == "function" and issubclass(of, choices.Gate):
        annotation = GATE_FUNCTION
    if kind == "function" and issubclass(of, choices.Rule):
        annotation = MATRIX_FUNCTION
    if entry["required"]:
        return f"{entry['name']}: {annotation}"
    default = entry["default"]
    if default is None:
        return f"{entry['name']}: {annotation} | None = None"
    if kind == "whole":
        default = int(default)
    written = f'"{default}"' if isinstance(default, str) else repr(default)
    return f"{entry['name']}: {annotation} = {written}"


def constructor(kind: type[choices.Choice]) -> Iterator[str]:
    """The constructor, each parameter on a line of its own."""
    about = kind.about
    # the order of the real signature, in which the required parameters come first
    order = list(kind.__signature__.parameters)  # type: ignore[attr-defined]
    entries = {entry["name"]: parameter(entry, kind) for entry in about["parameters"]}
    if about.get("forgetting_factor"):
        entries["forgetting_factor"] = "forgetting_factor: ForgettingFactor = 0.99"
        entries["half_life"] = "half_life: Any = None"
    if not order:
        yield "    def __init__(self) -> None: ..."
        return
    yield "    def __init__("
    yield "        self,"
    for name in order:
        if name == "half_life":
            yield "        *,"
        yield f"        {entries[name]},"
    yield "    ) -> None: ..."


def stub_of(kind: type[choices.Choice]) -> Iterator[str]:
    """The class of one registry entry."""
    about = kind.about
    header = about["header"].replace("\\", "\\\\").rstrip().splitlines()
    yield f"class {kind.__name__}({kind.__bases__[0].__name__}):"
    yield f'    """{header[0]}'
    for line in header[1:]:
        yield f"    {line}".rstrip()
    yield '    """'
    yield ""
    yield "    about: ClassVar[Mapping[str, Any]]"
    yield "    name: ClassVar[str]"
    yield from constructor(kind)


def axis_of(axis: choices.Axis) -> Iterator[str]:
    """The base class of an axis, unless it is written by hand, and its two functions."""
    if axis.kind.__module__ != choices.__name__:
        yield f'class {axis.kind.__name__}(Choice):\n    """{axis.summary}"""\n'
    yield f"def {axis.name}(name: str, **parameters: Any) -> {axis.kind.__name__}: ..."
    yield f"def {axis.plural}() -> list[dict[str, Any]]: ..."


def stub() -> str:
    """The whole file."""
    axes = choices.AXES.values()
    written = {axis.kind.__name__ for axis in axes if axis.kind.__module__ == choices.__name__}
    made = len(written) < len(axes)
    imported = sorted({"ForgettingFactor", *written, *({"Choice"} if made else ())})
    lines = [HEAD.format(written=", ".join(imported))]
    lines += ["__all__ = [", *(f'    "{name}",' for name in sorted(registry.__all__)), "]", ""]
    for axis in axes:
        lines += [*axis_of(axis), ""]
    classes = {kind.__name__: kind for axis in axes for kind in axis.classes.values()}
    for name in sorted(classes):
        lines += [*stub_of(classes[name]), ""]
    return "\n".join(lines).rstrip() + "\n"


def main() -> int:
    """Write the file, or only compare it."""
    if "--check" not in sys.argv[1:]:
        STUB.write_text(stub(), encoding="utf-8")
        return 0
    if STUB.read_text(encoding="utf-8") == stub():
        return 0
    print(f"{STUB} is stale: run python tools/stubs.py", file=sys.stderr)
    return 1


if __name__ == "__main__":
    sys.exit(main())
