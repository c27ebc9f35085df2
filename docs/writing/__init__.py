"""Pages that are written from the package itself, so that they cannot drift from it."""

from __future__ import annotations

from pathlib import Path

from forgetting.choices import AXES

from . import api, choices, command, papers


def write_pages(docs: Path) -> None:
    """Write every generated page under `docs`."""
    papers.pages(docs)
    command.pages(docs)
    api.pages(docs)
    for axis in AXES.values():
        choices.pages(docs, axis)
