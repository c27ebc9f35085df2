"""Memory that nobody uses any more, given back before more is asked for."""

from __future__ import annotations

import gc
import sys

LONG = 100_000
"""Rows of a record from which on it is worth the time."""


def release(rows: int) -> None:
    """Give back what is left of a table of so many rows.

    What formulaic makes refers to itself, so only the garbage collector finds it; and Arrow keeps
    memory for later.
    """
    if rows < LONG:
        return
    gc.collect()
    arrow = sys.modules.get("pyarrow")
    if arrow is not None:
        arrow.default_memory_pool().release_unused()
