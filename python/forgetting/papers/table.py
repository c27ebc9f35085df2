"""The table of claims: in the terminal and as CSV."""

from __future__ import annotations

import csv
from collections import Counter
from collections.abc import Sequence
from dataclasses import astuple, fields
from pathlib import Path

from rich import box
from rich.markup import escape
from rich.table import Table

from forgetting.cli.tables import console

from .claim import Claim

WIDTH = 150
"""Columns of the table in a file or a pipe."""
COLOURS = {"reproduced": "green", "corrected": "yellow", "not reproducible": "magenta"}


def print_claims(claims: Sequence[Claim], seconds: float) -> None:
    """Every claim a row, and the count."""
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
    out.print(f"{summary(claims)}, in {seconds:.0f} s")


def summary(claims: Sequence[Claim]) -> str:
    """How many of each, and how many do not hold."""
    count = Counter[str](claim.verdict for claim in claims)
    words = ", ".join(f"{count[name]} {name}" for name in COLOURS if count[name])
    failed = sum(not claim.holds for claim in claims)
    return f"{len(claims)} claims: {words}; {failed or 'none'} fail{'s' if failed == 1 else ''}"


def write_csv(claims: Sequence[Claim], path: Path) -> None:
    """One row a claim, one column a field."""
    with path.open("w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream)
        writer.writerow([field.name for field in fields(Claim)])
        writer.writerows(astuple(claim) for claim in claims)
