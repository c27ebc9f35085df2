"""What must not be hidden: where we lose, and who is missing."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from .markdown import table


@dataclass
class Ledger:
    """Filled by every part, printed at the end."""

    lost: list[tuple[str, str, str, float]] = field(default_factory=list)
    missing: dict[str, str] = field(default_factory=dict)

    def compare(self, question: str, where: str, rival: str, ratio: float) -> str:
        """`ratio` (rival's time over ours) for a table; below 1 it is a loss."""
        if ratio < 1:
            self.lost.append((question, where, rival, ratio))
        return f"{ratio:.2f}" if ratio < 10 else f"{ratio:.0f}"

    def unavailable(self, name: str, reason: object) -> str:
        """Note that a side could not run; a table's word for it."""
        self.missing[name] = str(reason)
        return "not available"

    def absent(self, name: str) -> str:
        """A table's word where a side did not run: it could not, or was not meant to."""
        return "not available" if name in self.missing else ""

    def report(self) -> Iterator[str]:
        """Markdown."""
        yield "## Where we lose\n"
        rows = [[*key, ", ".join(where)] for key, where in self.by_rival().items()]
        header = ["question", "faster", "where (its time over ours)"]
        yield table(header, rows) if rows else "Nowhere."
        yield "\n## Not available\n"
        yield from (f"- {name}: {reason}" for name, reason in self.missing.items())
        if not self.missing:
            yield "Everything was."

    def by_rival(self) -> dict[tuple[str, str], list[str]]:
        """What was lost, one line a rival."""
        found: dict[tuple[str, str], list[str]] = {}
        for question, where, rival, ratio in self.lost:
            found.setdefault((question, rival), []).append(f"{where} ({ratio:.2f})")
        return found
