"""What `forgetting tune` prints."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from rich.markup import escape

from forgetting.cli.tables import console, say, table
from forgetting.models.orders import Orders
from forgetting.tuning.code import code
from forgetting.words.rounding import brief

if TYPE_CHECKING:
    from forgetting.tuning import Tuning

Table = tuple[tuple[str, ...], Sequence[tuple[str, ...]]]

BEST = 8
"""Rules that are shown."""


def print_tuning(found: Tuning) -> None:
    """Print what was tried, how it did on the rest, and the lines to use."""
    out = console()
    out.print(table("Chosen on the first part: the best of each rule", *tried(found)))
    out.print(table(title_of_rest(found), *errors(found)))
    out.print(f"{found.runs} runs over the first part")
    for verdict in found.verdicts():
        out.print(f"\n{escape(verdict)}", soft_wrap=False)
    print_lines(found)


def print_lines(found: Tuning) -> None:
    """Print the command line and the Python line of what is better, then those of the other."""
    both = [("what was chosen", found.lines), ("the bank", found.lines_of_bank)]
    for name, lines in reversed(both) if found.bank_is_better else both:
        say(f"\nTo use {name}:\n")
        for line in (lines.command, lines.python):
            if line is not None:
                say(f"    {line}")


def tried(found: Tuning) -> Table:
    """The best trial of each rule, best first."""
    best: dict[str, Any] = {}
    for trial in sorted(found.trials, key=lambda trial: trial.error):
        rule = trial.candidate.rule
        if trial.candidate.orders == found.orders:
            best.setdefault("bank" if rule is None else rule.name, trial)
    rows = [
        (called(trial.candidate.rule), brief(trial.error)) for trial in list(best.values())[:BEST]
    ]
    return ("rule", "one-step RMSE"), rows


def called(rule: Any) -> str:
    """A rule with what is not at its default."""
    return "the bank" if rule is None else code(rule).replace("fg.", "")


def title_of_rest(found: Tuning) -> str:
    """What the second table shows."""
    orders = found.orders
    if isinstance(orders, Orders):
        model = f" of ARX({orders})"
    else:
        model = "" if orders is None else f" of {orders}"
    count = int(found.split.reporting.sum())
    return f"One-step RMSE{model} on the rest, {count} samples that no choice has seen"


def errors(found: Tuning) -> Table:
    """One line for each output."""
    scores = found.rest.errors
    rows = [
        (output, *(brief(values[j]) for values in scores.values()))
        for j, output in enumerate(found.outputs)
    ]
    return ("output", *(name.replace("_", " ") for name in scores)), rows
