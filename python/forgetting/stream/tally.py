"""How many lines came, and what was wrong with some; said on stderr, now and then."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import asdict, dataclass
from typing import Any

QUIET = 10.0
"""Seconds between two sentences while faults go on."""
TOLD = ("malformed", "late", "repeated", "out_of_range")
"""Faults that are told while the stream runs."""


@dataclass
class Tally:
    """Counts since the stream began.

    Attributes
    ----------
    rows : int
        Lines that are no names, comments or blank.
    used : int
        Rows the estimate learned from.
    malformed, late, repeated : int
        Lines that could not be read; whose time is before that of the line before; whose time and
        values are those of the line before.
    out_of_range : int
        Rows that would have left the range of numbers, and were left out.
    missing : int
        Well-formed rows in which a value was missing, or a lag that reaches before the stream or
        across a gap.
    gaps : int
    """

    rows: int = 0
    used: int = 0
    malformed: int = 0
    late: int = 0
    repeated: int = 0
    out_of_range: int = 0
    missing: int = 0
    gaps: int = 0

    def state(self) -> dict[str, Any]:
        """As ``Tally(**state)`` takes it."""
        return asdict(self)

    def __str__(self) -> str:
        faults = ", ".join(f"{getattr(self, name)} {words(name)}" for name in (*TOLD, "missing"))
        gaps = f"{self.gaps} gap{'s' * (self.gaps != 1)}"
        return f"{self.rows} rows: {self.used} used, {faults}; {gaps}"


def words(name: str) -> str:
    """A count's name in words."""
    return name.replace("_", " ")


class Teller:
    """Says what was wrong: the first fault at once, further ones together after a while.

    Parameters
    ----------
    tell : callable
        Takes a sentence.
    """

    def __init__(self, tell: Callable[[str], None]) -> None:
        self.tell = tell
        self.told: Tally = Tally()
        self.last = -float("inf")

    def look(self, tally: Tally, example: str) -> bool:
        """Say what is new, if it is time to; whether something was said."""
        news = [
            f"{getattr(tally, name) - getattr(self.told, name)} {words(name)}"
            for name in TOLD
            if getattr(tally, name) > getattr(self.told, name)
        ]
        now = time.monotonic()
        if not news or now - self.last < QUIET:
            return False
        self.last = now
        self.told = Tally(**tally.state())
        self.tell(
            f"up to row {tally.rows}: {', '.join(news)}" + (f"; {example}" if example else "")
        )
        return True
