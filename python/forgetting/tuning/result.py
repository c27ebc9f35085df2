"""What a search found, in words and as data."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

from forgetting.choices import Rule
from forgetting.models.named import NamedModel
from forgetting.models.orders import Each, Orders
from forgetting.tuning.candidate import Candidate
from forgetting.tuning.code import code
from forgetting.tuning.problem import Split
from forgetting.tuning.report import BANK, NO_FORGETTING, WORDS, Rest
from forgetting.tuning.runner import Trial
from forgetting.tuning.structures import ModelOrders
from forgetting.words.rounding import brief

NO_RULE_FORGETS = "none"


@dataclass(frozen=True)
class Lines:
    """How to use a choice.

    Attributes
    ----------
    python : str
        An expression, or a line of several statements, where `fg` is the package.
    command : str or None
        The same for the shell, where there is a record in a file.
    """

    python: str
    command: str | None = None


@dataclass(frozen=True)
class Tuning:
    """What `forgetting.tune` found: chosen on the first part of a record, reported on the rest.

    Attributes
    ----------
    best : Trial
        What was chosen, with its error on the samples that choose.
    rest : Rest
        Errors on the rest, beside the bank, no forgetting and the last value, and their tests.
    split : Split
        The two parts of the record.
    trials : list of Trial
        All that was tried, in order.
    lines, lines_of_bank : Lines
        Python and, for a record in a file, the command line that use what was chosen, and the bank.
    outputs : tuple of str
        Names of the outputs.
    """

    best: Trial
    rest: Rest
    split: Split
    trials: list[Trial]
    lines: Lines
    lines_of_bank: Lines
    outputs: tuple[str, ...] = field(default=("y",))

    @property
    def candidate(self) -> Candidate:
        """What was chosen."""
        return self.best.candidate

    @property
    def rule(self) -> Rule:
        """The rule that was chosen, with its factor or rate."""
        assert self.candidate.rule is not None
        return self.candidate.rule

    @property
    def initial_covariance(self) -> tuple[float, ...] | None:
        """The diagonal of P before the first sample; None where it follows the data."""
        return self.candidate.initial_covariance

    @property
    def orders(self) -> ModelOrders | None:
        """Orders of the ARX model, or the other structure, that was chosen."""
        return self.candidate.orders

    @property
    def runs(self) -> int:
        """Runs over the first part."""
        return len(self.trials)

    @property
    def python(self) -> str:
        """The Python line that uses what was chosen."""
        return self.lines.python

    @property
    def command(self) -> str | None:
        """The command line that uses what was chosen."""
        return self.lines.command

    @property
    def bank_is_better(self) -> bool:
        """Whether the bank predicts the rest better than what was chosen, by more than chance."""
        found = self.rest.differences.get(BANK)
        return self.rest.failed is not None or (
            found is not None and found.beyond_chance and found.ratio > 1
        )

    def verdicts(self) -> list[str]:
        """Plain sentences: how the choice did on samples that it never saw."""
        if self.rest.failed is not None:
            return [
                f"What was chosen did not get through the rest: {self.rest.failed}. Use the bank."
            ]
        found = [
            difference.words(WORDS[name])
            for name, difference in self.rest.differences.items()
            if not (name == NO_FORGETTING and self.rule.name == NO_RULE_FORGETS)
        ]
        if self.rule.name == NO_RULE_FORGETS:
            found.append("What was chosen is no forgetting.")
        return [*found, self.advice()]

    def advice(self) -> str:
        """Which of the two to use."""
        if self.bank_is_better:
            return "Use the bank, of which nothing need be chosen."
        bank = self.rest.differences.get(BANK)
        if bank is None or bank.beyond_chance:
            return "Tuning pays on this record."
        return "The bank does as well and needs no choice; one rule costs less to run."

    def summary(self) -> dict[str, Any]:
        """All of it for JSON: None where a number is not finite."""
        chosen = self.candidate
        return {
            "rule": code(self.rule),
            "initial_covariance": None
            if chosen.initial_covariance is None
            else list(chosen.initial_covariance),
            "orders": orders_as_data(chosen.orders),
            "chosen_on": int(self.split.choosing.sum()),
            "reported_on": int(self.split.reporting.sum()),
            "first_row_of_the_rest": self.split.row,
            "runs": self.runs,
            "error_on_first_part": finite(self.best.error),
            "errors_on_rest": {
                name: {
                    output: finite(value)
                    for output, value in zip(self.outputs, values, strict=True)
                }
                for name, values in self.rest.errors.items()
            },
            "differences": {
                name: {
                    "ratio": finite(each.ratio),
                    "p_value": finite(each.p_value),
                    "statistic": finite(each.statistic),
                    "lags": each.lags,
                    "beyond_chance": each.beyond_chance,
                }
                for name, each in self.rest.differences.items()
            },
            "verdicts": self.verdicts(),
            "python": self.lines.python,
            "command": self.lines.command,
            "python_of_bank": self.lines_of_bank.python,
            "command_of_bank": self.lines_of_bank.command,
            "trials": [as_data(trial) for trial in self.trials],
        }

    def __str__(self) -> str:
        """What to print."""
        errors = ", ".join(
            f"{WORDS[name]} {brief(self.rest.error(name))}" for name in self.rest.errors
        )
        used = self.lines_of_bank if self.bank_is_better else self.lines
        return "\n".join([f"one-step error on the rest: {errors}", *self.verdicts(), used.python])


def as_data(trial: Trial) -> dict[str, Any]:
    """A trial for JSON."""
    candidate = trial.candidate
    prior = candidate.initial_covariance
    return {
        "stage": trial.stage,
        "rule": "bank" if candidate.rule is None else code(candidate.rule),
        "orders": orders_as_data(candidate.orders),
        "initial_covariance": None if prior is None else list(prior),
        "error": finite(trial.error),
    }


def orders_as_data(orders: ModelOrders | None) -> Sequence[Each] | str | None:
    """na, nb, nk; or the structure and its orders as one text."""
    return [orders.na, orders.nb, orders.nk] if isinstance(orders, Orders) else text_of(orders)


def text_of(named: NamedModel | None) -> str | None:
    """As ``--model`` takes it."""
    return None if named is None else str(named)


def finite(value: float) -> float | None:
    """The number, or None."""
    return value if abs(value) < float("inf") else None
