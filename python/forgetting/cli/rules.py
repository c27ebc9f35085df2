"""`forgetting rules`."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any

import typer
from rich.markup import escape
from rich.table import Table

import forgetting as fg
from forgetting.cli.rulebook import about
from forgetting.cli.tables import console, say

GUARANTEES = (
    ("proper", "proper"),
    ("bounded_above", "P bounded without excitation"),
    ("bounded_below", "P bounded below"),
)
"""Keys of the registry and their words; the header of a rule gives the exact statement."""


def rules(
    name: Annotated[
        str | None, typer.Argument(help="A rule; without it all rules are listed.")
    ] = None,
) -> None:
    """List the forgetting rules, or explain one: its equations, parameters and guarantees."""
    if name is not None:
        say(about(name)["header"].strip())
        return
    out = console()
    for entry in fg.rules():
        out.print(rule_table(entry))
        out.print()
    out.print("'forgetting rules NAME' explains one, with its equations.")


def rule_table(entry: Mapping[str, Any]) -> Table:
    """A rule in a few lines."""
    made = Table(
        title=f"[bold]{entry['name']}[/]: {escape(entry['summary'])}",
        title_justify="left",
        title_style="",
        box=None,
        show_header=False,
        padding=(0, 2, 0, 2),
    )
    made.add_column(style="dim", no_wrap=True)
    made.add_column(overflow="fold")
    for parameter in parameters(entry):
        made.add_row("parameter", escape(parameter))
    for key, words in GUARANTEES:
        made.add_row(words, escape(str(entry[key])))
    made.add_row("cost per sample", escape(entry["cost"]))
    return made


def parameters(entry: Mapping[str, Any]) -> list[str]:
    """Each parameter with range and default."""
    lines = ["forgetting_factor in (0, 1], default 0.99"] if entry["forgetting_factor"] else []
    for each in entry["parameters"]:
        default = "required" if each["required"] else f"default {each['default']}"
        lines.append(f"{each['name']} in {each['range']}, {default}: {each['about']}")
    return lines
