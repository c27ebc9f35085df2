"""The table of claims in the terminal."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from rich import box
from rich.markup import escape
from rich.table import Table

from forgetting.cli.tables import console

if TYPE_CHECKING:
    from forgetting.papers import Claim

WIDTH = 150
"""Columns of the table in a file or a pipe."""
COLOURS = {"reproduced": "green", "corrected": "yellow", "not reproducible": "magenta"}


def print_claims(claims: Sequence[Claim], closing: str) -> None:
    """Every claim a row, and a closing sentence."""
    table = Table(box=box.SIMPLE_HEAD, padding=(0, 1, 0, 0))
    for name in ("source", "printed", "measured", "verdict", "holds"):
        table.add_column(name, overflow="fold")
    for claim in claims:
        verdict = f"[{COLOURS[claim.verdict]}]{claim.verdict}[/]"
        holds = "yes" if claim.holds else "[bold red]NO[/]"
        words = (claim.source, claim.printed, claim.measured)
        table.add_row(*map(escape, words), verdict, holds)
    out = console()
    if not out.is_terminal:
        out.width = WIDTH
    out.print(table, soft_wrap=False)
    out.print(closing)
