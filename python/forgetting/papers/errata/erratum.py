"""An error of a paper, with the evidence."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

from ..claim import Check, Finding

Kind = Literal["error", "gap", "typo"]
"""error: the statement is false. gap: its proof does not prove it. typo: a slip of the pen."""


@dataclass(frozen=True)
class Erratum:
    """One entry of the errata page; call it for the evidence.

    Attributes
    ----------
    name : str
        "GF-3": paper and number.
    where : str
        Place in the paper.
    kind : {"error", "gap", "typo"}
    printed, corrected : str
    why : str
        What is wrong, and what becomes of the conclusion.
    measure : callable or None
        Returns what was measured, and whether the printed form was seen to fail while the
        corrected one holds. None for a slip that has nothing to measure.
    """

    name: str
    where: str
    kind: Kind
    printed: str
    corrected: str
    why: str = ""
    measure: Callable[[], Finding] | None = None

    def __call__(self) -> Finding:
        """Measure; a slip with nothing to measure says so."""
        if self.measure is None:
            return "a slip of the pen: nothing to measure", True
        words, confirmed = self.measure()
        return words, bool(confirmed)


def erratum(
    name: str, where: str, kind: Kind, printed: str, corrected: str, why: str = ""
) -> Callable[[Callable[[], Finding]], Erratum]:
    """Turn a function that measures into an `Erratum`."""

    def make(measure: Callable[[], Finding]) -> Erratum:
        return Erratum(name, where, kind, printed, corrected, why, measure)

    return make


def claimed(check: Check) -> Callable[[], Finding]:
    """The evidence of a claim that is in the table already."""

    def measure() -> Finding:
        claim = check()
        return claim.measured, claim.holds

    return measure


def refused(compute: Callable[[], object]) -> bool:
    """Whether matrices of these shapes cannot be multiplied or added."""
    try:
        compute()
    except ValueError:
        return True
    return False
