"""Where every claim and every figure is, in the order of the papers."""

from __future__ import annotations

from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING

import forgetting as fg

from .claim import Check, checks

if TYPE_CHECKING:  # matplotlib is not needed to say which papers there are
    from .picture import Picture

PAPERS = {
    "vdf": "Recursive least squares with variable-direction forgetting (Goel, Bruce, Bernstein)",
    "gf": "Generalized forgetting recursive least squares (Lai, Bernstein)",
    "opd": "Variable-direction forgetting via oblique projection decomposition (Zhu, Yu, Wan)",
}
EXAMPLES = range(1, 13)
"""Examples of the tutorial, the only paper that numbers them."""
PARTS = {
    "vdf": (
        *(f"example{number:02d}" for number in EXAMPLES),
        "table3",
        "table4",
        "propositions",
        "variable_direction",
        "lyapunov",
        "sidebars",
        "theorem_s1",
    ),
    "gf": ("theorem1", "family", "theorem2", "theorem3"),
    "opd": ("decomposition", "convergence", "table1", "figures"),
}


def modules(paper: str | None = None, example: int | None = None) -> list[ModuleType]:
    """The modules of a paper, of one of its examples, or of all.

    Raises
    ------
    InvalidInput
        For a paper or an example that there is not.
    """
    if paper is not None and paper not in PAPERS:
        raise fg.InvalidInput(f"paper = {paper!r}, allowed: {', '.join(PAPERS)}")
    if example is not None:
        return [_example(paper, example)]
    chosen = PAPERS if paper is None else (paper,)
    return [
        import_module(f"{__package__}.{each}.{part}") for each in chosen for part in PARTS[each]
    ]


def _example(paper: str | None, number: int) -> ModuleType:
    if paper not in (None, "vdf"):
        raise fg.InvalidInput(f"example = {number}, allowed: none; only vdf numbers its examples")
    if number not in EXAMPLES:
        allowed = f"{EXAMPLES[0]} to {EXAMPLES[-1]}"
        raise fg.InvalidInput(f"example = {number}, allowed: {allowed}")
    return import_module(f"{__package__}.vdf.example{number:02d}")


def all_checks(paper: str | None = None, example: int | None = None) -> list[Check]:
    """Every claim of a paper, of one example, or of all, not measured yet."""
    return [check for module in modules(paper, example) for check in checks(module)]


def all_pictures(paper: str | None = None, example: int | None = None) -> list[Picture]:
    """Every figure of a paper, of one example, or of all, not drawn yet."""
    from .picture import pictures

    return [each for module in modules(paper, example) for each in pictures(module)]
