"""What a comparison of rules found."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from forgetting.record.identification import Identification, finite
from forgetting.tuning.candidate import tuned
from forgetting.tuning.problem import Split
from forgetting.tuning.runner import Trial


@dataclass(frozen=True)
class Compared:
    """A rule on a record.

    Attributes
    ----------
    name : str
        Registry name of the rule.
    found : Identification
        Its run over the whole record.
    error : float
        One-step root mean square error on the rest of the record, or, where nothing was chosen, on
        all of it; of several outputs the geometric mean.
    chosen_by : float or None
        The error on the first part, by which its factor was chosen; None where it was not.
    """

    name: str
    found: Identification
    error: float
    chosen_by: float | None

    @property
    def setting(self) -> tuple[str, Any] | None:
        """The parameter that says how much the rule forgets, and its value."""
        name = tuned(self.name)
        return None if name is None else (name, self.found.rule.arguments()[name])

    def summary(self) -> dict[str, Any]:
        """The rule for JSON."""
        ends = self.found.trace.eigenvalues[-1]
        return {
            "rule": self.name,
            "setting": None if self.setting is None else dict([self.setting]),
            "error": self.error,
            "error_on_first_part": self.chosen_by,
            "left_out": len(self.found.samples.y) - self.found.used,
            "largest_eigenvalue": float(ends[-1]),
            "covariance_ratio": self.found.covariance_ratio,
        }


@dataclass(frozen=True)
class Comparison:
    """Rules ranked by their error.

    Attributes
    ----------
    ranked : list of Compared
        The best first.
    refused : list of str
        Rules that did not get through the record, and why.
    split : Split or None
        The part that chose and the rest; None where nothing was chosen.
    unchosen : str or None
        Why nothing was chosen.
    trials : list of Trial
        All factors that were tried.
    """

    ranked: list[Compared]
    refused: list[str]
    split: Split | None
    unchosen: str | None
    trials: list[Trial]

    def scored_in_words(self) -> str:
        """Which samples the errors are of, and what was chosen."""
        if self.split is None:
            return f"all samples, {self.unchosen}"
        count = int(self.split.reporting.sum())
        return f"the last {count} samples, each rule with its best factor on those before"

    def summary(self) -> dict[str, Any]:
        """All of it for JSON: None where a number is not finite."""
        samples = self.ranked[0].found.samples if self.ranked else None
        found = {
            "record": None if samples is None else samples.source,
            "model": None if samples is None else samples.model,
            "scored": self.scored_in_words(),
            "first_row_of_the_rest": None if self.split is None else self.split.row,
            "rules": [each.summary() for each in self.ranked],
            "refused": self.refused,
        }
        return dict(finite(found))
