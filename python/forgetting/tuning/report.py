"""What was chosen, run over the rest of the record, beside what nobody had to choose."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from forgetting._core import NumericalRange
from forgetting.choices import AXES
from forgetting.tuning.baseline import last_measured, rms, typical
from forgetting.tuning.candidate import Candidate
from forgetting.tuning.difference import Difference, difference
from forgetting.tuning.problem import Array, Problem, Split
from forgetting.tuning.structures import ModelOrders

TUNED, BANK, NO_FORGETTING, LAST_VALUE = "tuned", "bank", "no_forgetting", "last_value"
WORDS = {
    TUNED: "tuned",
    BANK: "the bank",
    NO_FORGETTING: "no forgetting",
    LAST_VALUE: "the last value",
}
"""Whose errors are reported, and what they are called."""


@dataclass(frozen=True)
class Rest:
    """One-step errors on the rest of a record.

    Attributes
    ----------
    errors : dict
        Root mean square error of each output by "tuned", "bank", "no_forgetting" and "last_value",
        in the unit of the output.
    differences : dict
        What was chosen beside each of the others, a `Difference` each.
    failed : str or None
        Why what was chosen could not be run over the whole record.
    """

    errors: dict[str, tuple[float, ...]]
    differences: dict[str, Difference]
    failed: str | None = None

    def error(self, name: str) -> float:
        """One number for all outputs: the geometric mean."""
        return typical(self.errors[name])


def report(chosen: Candidate, orders: ModelOrders | None, problem: Problem, split: Split) -> Rest:
    """Run what was chosen and its baselines over the whole record, and score the rest.

    The estimators have run through the first part when the rest begins, and go on learning, as in
    use; their settings are fixed.
    """
    errors, failed = baselines(orders, problem), None
    try:
        errors[TUNED] = chosen.errors(problem)
    except NumericalRange as error:
        failed = str(error)
        errors[TUNED] = np.full(problem.y.shape, np.inf)
    unit = np.mean(errors[BANK][split.choosing] ** 2, axis=0)
    losses = {name: loss(error[split.reporting], unit) for name, error in errors.items()}
    differences = {
        name: difference(losses[TUNED], losses[name])
        for name in (BANK, NO_FORGETTING, LAST_VALUE)
        if failed is None and np.isfinite(losses[name]).all()
    }
    scores = {name: rms(errors[name][split.reporting]) for name in WORDS}
    return Rest(scores, differences, failed)


def baselines(orders: ModelOrders | None, problem: Problem) -> dict[str, Array]:
    """Errors of the bank, of no forgetting and of the last value, (T, m)."""
    return {
        BANK: Candidate(None, None, orders).errors(problem),
        NO_FORGETTING: Candidate(AXES["rule"].make("none"), None, orders).errors(problem),
        LAST_VALUE: problem.y - last_measured(problem.y),
    }


def loss(error: Array, unit: Array) -> Array:
    """Squared errors, summed over outputs, each in units of the bank's in the first part."""
    scaled: Array = (error**2 / np.where(unit > 0, unit, 1.0)).sum(axis=1)
    return scaled
