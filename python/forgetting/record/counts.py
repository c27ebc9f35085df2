"""How many samples were used, and why the others were not."""

from __future__ import annotations

from dataclasses import dataclass

from forgetting.record.trace import (
    DEAD_ZONE,
    FROZEN,
    HELD,
    MISSING,
    USED,
    WITHIN_BOUND,
    Trace,
)


@dataclass(frozen=True)
class Counts:
    """Counts of the samples of a run, read from its trace."""

    trace: Trace

    @property
    def used(self) -> int:
        """Samples the estimate learned from."""
        return int((self.trace.skipped == USED).sum())

    @property
    def missing(self) -> int:
        """Samples skipped because a value was missing or a lag crossed a gap."""
        return int((self.trace.skipped == MISSING).sum())

    @property
    def dead_zone(self) -> int:
        """Samples skipped because they carried too little information."""
        return int((self.trace.skipped == DEAD_ZONE).sum())

    @property
    def within_bound(self) -> int:
        """Samples skipped because their error was within the rule's bound on the noise."""
        return int((self.trace.skipped == WITHIN_BOUND).sum())

    @property
    def held(self) -> int:
        """Samples that the gate held: neither forgotten nor learned from."""
        return int((self.trace.skipped == HELD).sum())

    @property
    def frozen(self) -> int:
        """Samples that the gate froze: learned from, while nothing was forgotten."""
        return int((self.trace.gate == FROZEN).sum())

    def counts(self) -> dict[str, int]:
        """Rows of the record, and how many were used or left out for each reason."""
        return {
            "rows": len(self.trace.skipped),
            "used": self.used,
            "missing": self.missing,
            "dead_zone": self.dead_zone,
            "within_bound": self.within_bound,
            "held": self.held,
            "frozen": self.frozen,
        }

    def left_out(self) -> str:
        """Samples that were not used, in words, and those that were frozen."""
        counts = [
            (self.missing, "missing"),
            (self.dead_zone, "in the dead zone"),
            (self.within_bound, "within the bound on the noise"),
            (self.held, "held by the gate"),
            (self.frozen, "frozen by the gate"),
        ]
        always = counts[:2]
        return ", ".join(f"{n} {words}" for n, words in counts if n or (n, words) in always)
