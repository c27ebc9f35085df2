"""The groups in which the help shows options, and an option of one of them."""

from __future__ import annotations

from typing import Any

import typer

MODEL, READING, RULE = "Model", "Reading the record", "Forgetting"
KNOWN = "What is known of parameters, by their names"
FILES = "What to write"


def option(group: str, text: str, *names: str, **more: Any) -> Any:
    """An option in a group of the help."""
    return typer.Option(*names, rich_help_panel=group, help=text, **more)
