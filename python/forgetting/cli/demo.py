"""`forgetting demo`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer
from rich.markup import escape

from forgetting.cli.tables import console, print_written, table
from forgetting.words.errors import RecordError

NAMES = ("battery", "solar", "cycling")


def demo(
    name: Annotated[str, typer.Argument(help="battery, solar, cycling or all.")] = "battery",
    output: Annotated[
        Path,
        typer.Option("--output", "-o", help="Folder for what is written; made when absent."),
    ] = Path("forgetting-demo"),
) -> None:
    """Identify a record that comes with the package, and say where it is.

    battery: a computed cell of which the resistance grows; the record to try everything else on.
    solar, cycling: measured records inside other packages, which must be installed: five days of a
    solar array, nights without input; mass, rolling resistance and drag area of a rider from a
    power meter. Nothing is downloaded or opened.
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
        if outcome.next:
            out.print("\nTry next:")
        for line in outcome.next:
            out.print(f"    {escape(line)}")
