"""What a demo leaves behind."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Outcome:
    """Files written, the comparison page first, and a table of what was found.

    Attributes
    ----------
    files : list of Path
    title : str
    header : tuple of str
    rows : sequence of tuple of str
        One per rule.
    next : sequence of str
        Command lines to try next.
    """

    files: list[Path]
    title: str
    header: tuple[str, ...]
    rows: Sequence[tuple[str, ...]]
    next: Sequence[str] = ()
