"""`forgetting demo`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from forgetting.cli.tables import console, print_written, table
from forgetting.words.errors import RecordError

NAMES = ("solar", "cycling")


def demo(
    name: Annotated[str, typer.Argument(help="solar, cycling or all.")] = "all",
    output: Annotated[
        Path, typer.Option("--output", "-o", help="Folder for the reports; made when absent.")
    ] = Path("forgetting-demo"),
) -> None:
    """Identify measured records that ship inside other packages, and write reports.

    solar: five days of a solar array, nights without input. cycling: mass, rolling resistance and
    drag area of a rider from a power meter. Nothing is downloaded or opened.
    """
    if name not in (*NAMES, "all"):
        raise RecordError(f"there is no demo {name!r}; choose {', '.join(NAMES)} or all")
    from forgetting.demo import DEMOS

    output.mkdir(parents=True, exist_ok=True)
    out = console()
    for chosen in NAMES if name == "all" else (name,):
        outcome = DEMOS[chosen](output)
        out.print(table(outcome.title, outcome.header, outcome.rows))
        print_written(outcome.files)
