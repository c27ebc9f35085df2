"""A finding, and what all of them come to."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import asdict, dataclass
from typing import Any, Literal

Severity = Literal["good", "warning", "wrong"]

RANK: dict[str, int] = {"wrong": 0, "warning": 1, "good": 2}
CAUSES = (
    "regressors",
    "residuals",
    "inputs",
    "memory",
    "poles",
    "windup",
    "excitation",
    "intervals",
    "baselines",
    "samples",
)
"""What is found, causes before what they cause: a missing input also spoils the intervals."""
HEADLINES = {
    "good": "Good: nothing found speaks against this estimate.",
    "warning": "Use with care.",
    "wrong": "Do not rely on this.",
}


@dataclass(frozen=True)
class Finding:
    """One thing found.

    Attributes
    ----------
    name : str
        One of `CAUSES`.
    severity : {"good", "warning", "wrong"}
    text : str
        A sentence with the figure.
    advice : str
        What to do; empty where nothing is to be done.
    """

    name: str
    severity: Severity
    text: str
    advice: str = ""

    def __str__(self) -> str:
        """The sentence and the advice."""
        return f"{self.text} {self.advice}".rstrip()


@dataclass(frozen=True)
class Judgement:
    """All findings, the worst first, and among those as bad the cause before its effect.

    Examples
    --------
    >>> print(judgement([Finding("windup", "good", "No windup.")]).verdict)
    Good: nothing found speaks against this estimate.
    """

    findings: tuple[Finding, ...]

    @property
    def severity(self) -> Severity:
        """That of the worst finding."""
        return self.findings[0].severity if self.findings else "good"

    @property
    def first(self) -> Finding | None:
        """The finding to act on first, None if there is nothing to do."""
        return self.findings[0] if self.findings and self.severity != "good" else None

    @property
    def verdict(self) -> str:
        """All of it in a line, with the first thing to do."""
        words = HEADLINES[self.severity]
        if self.first is None:
            return words
        return f"{words} First: {self.first.advice or self.first.text}"

    def __getitem__(self, name: str) -> Finding:
        """The finding of this name; KeyError if nothing was found of it, good or bad."""
        for finding in self.findings:
            if finding.name == name:
                return finding
        raise KeyError(name)

    def __contains__(self, name: object) -> bool:
        """Whether there is a finding of this name."""
        return any(finding.name == name for finding in self.findings)

    def sentences(self) -> list[str]:
        """Each finding with its advice."""
        return [str(finding) for finding in self.findings]

    def to_dict(self) -> dict[str, Any]:
        """Ready for JSON."""
        return {
            "severity": self.severity,
            "verdict": self.verdict,
            "first": None if self.first is None else self.first.name,
            "findings": [asdict(finding) for finding in self.findings],
        }


def judgement(findings: Iterable[Finding | None]) -> Judgement:
    """Sort findings into a judgement; of several of one name the worst stands."""
    worst: dict[str, Finding] = {}
    for finding in findings:
        if finding is None:
            continue
        known = worst.get(finding.name)
        if known is None or RANK[finding.severity] < RANK[known.severity]:
            worst[finding.name] = finding
    return Judgement(
        tuple(sorted(worst.values(), key=lambda f: (RANK[f.severity], CAUSES.index(f.name))))
    )
