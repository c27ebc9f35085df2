"""Claims of the papers, each with what was measured beside what was printed."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from dataclasses import dataclass
from types import ModuleType
from typing import Literal

Verdict = Literal["reproduced", "corrected", "not reproducible"]
"""What became of a printed claim.

reproduced: it holds as printed. corrected: it fails as printed and holds in the form stated, and
both were measured. not reproducible: the text does not say enough; what can be said was measured.
"""

Finding = tuple[str, bool]
"""What was measured, in words and numbers, and whether the claim (as corrected) holds."""

SEEDS = 200
"""Noise realisations of a Monte Carlo claim."""


@dataclass(frozen=True)
class Claim:
    """One row of the table of claims.

    Attributes
    ----------
    source : str
        Paper and place.
    printed : str
        What the paper says.
    measured : str
        What was found.
    verdict : {"reproduced", "corrected", "not reproducible"}
    reason : str
        Why the claim had to be corrected or cannot be reproduced; settings that had to be chosen.
    holds : bool
        Whether the claim, in its corrected form where there is one, was found to hold.
    """

    source: str
    printed: str
    measured: str
    verdict: Verdict
    reason: str
    holds: bool


@dataclass(frozen=True)
class Check:
    """A claim that has not been measured yet; call it to measure."""

    source: str
    printed: str
    verdict: Verdict
    reason: str
    measure: Callable[..., Finding]
    case: str = ""

    @property
    def name(self) -> str:
        """Module and function, ``vdf.example09.covariance_form_diverges``, and the case if any."""
        name = f"{self.module}.{self.measure.__name__}"
        return f"{name}[{self.case}]" if self.case else name

    @property
    def module(self) -> str:
        """Where it is measured, ``vdf.example09``."""
        return self.measure.__module__.split("papers.")[-1]

    @property
    def needs_seeds(self) -> bool:
        """Whether the claim is about many noise realisations."""
        return "seeds" in inspect.signature(self.measure).parameters

    def __call__(self, seeds: int = SEEDS) -> Claim:
        """Measure.

        Parameters
        ----------
        seeds : int >= 2
            Noise realisations, for the claims that need them.
        """
        measured, holds = self.measure(seeds) if self.needs_seeds else self.measure()
        words = (self.source, self.printed, measured, self.verdict, self.reason)
        return Claim(*words, bool(holds))


def claim(
    source: str, printed: str, *, verdict: Verdict = "reproduced", reason: str = ""
) -> Callable[[Callable[..., Finding]], Check]:
    """Turn a function that measures into a `Check`."""

    def make(measure: Callable[..., Finding]) -> Check:
        return Check(source, printed, verdict, reason, measure)

    return make


def checks(module: ModuleType) -> list[Check]:
    """The checks of a module, in the order of its text; a tuple counts as its members."""
    found: list[Check] = []
    for item in vars(module).values():
        members = item if isinstance(item, tuple) else (item,)
        found += [each for each in members if isinstance(each, Check)]
    return found


def largest_gap(found: object, wanted: object) -> float:
    """Largest difference of two arrays relative to the largest element of the second."""
    import numpy as np

    a, b = np.asarray(found, dtype=float), np.asarray(wanted, dtype=float)
    return float(np.abs(a - b).max() / (np.abs(b).max() or 1.0))
