"""What a comparison of rules found."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from forgetting.record.samples import Samples
from forgetting.tuning.candidate import tuned
from forgetting.tuning.problem import Split
from forgetting.tuning.runner import Trial
from forgetting.words.finite import finite

OWN_REGRESSORS = (
    "The model is not linear in its parameters: each rule makes its regressors from its own "
    "estimates. Errors compare as ever; eigenvalues of P are each of other regressors."
)


@dataclass(frozen=True)
class Compared:
    """A rule on a record.

    Attributes
    ----------
    name : str
        Registry name of the rule.
    rule : Rule
        With its setting.
    error : float
        One-step root mean square error on the rest of the record, or, where nothing was chosen, on
        all of it; of several outputs the geometric mean.
    chosen_by : float or None
        The error on the first part, by which its factor was chosen; None where it was not.
    left_out : int
        Samples of the whole record that were not used.
    eigenvalues : ndarray, shape (n,)
        Of P at the end of the record, ascending.
    """

    name: str
    rule: Any
    error: float
    chosen_by: float | None
    left_out: int
    eigenvalues: NDArray[np.float64]

    @property
    def setting(self) -> tuple[str, Any] | None:
        """The parameter that says how much the rule forgets, and its value."""
        name = tuned(self.name)
        return None if name is None else (name, self.rule.arguments()[name])

    @property
    def covariance_ratio(self) -> float:
        """Largest over smallest eigenvalue; inf when rounding made P singular."""
        smallest, largest = self.eigenvalues[[0, -1]]
        return float(largest / smallest) if smallest > 0 else float("inf")

    def summary(self) -> dict[str, Any]:
        """The rule for JSON."""
        return {
            "rule": self.name,
            "setting": None if self.setting is None else dict([self.setting]),
            "error": self.error,
            "error_on_first_part": self.chosen_by,
            "left_out": self.left_out,
            "largest_eigenvalue": float(self.eigenvalues[-1]),
            "covariance_ratio": self.covariance_ratio,
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
    samples : Samples
        Regressors and outputs.
    choosing : int or None
        Rows by which factors were chosen, where these are fewer than the first part.
    """

    ranked: list[Compared]
    refused: list[str]
    split: Split | None
    unchosen: str | None
    trials: list[Trial]
    samples: Samples
    choosing: int | None = None

    def scored_in_words(self) -> str:
        """Which samples the errors are of, and what was chosen."""
        if self.split is None:
            return f"all samples, {self.unchosen}"
        count = int(self.split.reporting.sum())
        by = "those before" if self.choosing is None else f"the {self.choosing} rows before"
        return f"the last {count} samples, each rule with its best factor on {by}"

    @property
    def reservation(self) -> str | None:
        """What must be known of rules whose regressors follow from their estimates; else None."""
        return OWN_REGRESSORS if self.samples.is_pseudolinear else None

    def summary(self) -> dict[str, Any]:
        """All of it for JSON: None where a number is not finite."""
        samples = self.samples if self.ranked else None
        found = {
            "record": None if samples is None else samples.source,
            "model": None if samples is None else samples.model,
            "scored": self.scored_in_words(),
            "first_row_of_the_rest": None if self.split is None else self.split.row,
            "rows_that_choose": self.choosing,
            "rules": [each.summary() for each in self.ranked],
            "refused": self.refused,
            "reservation": self.reservation,
        }
        return dict(finite(found))
