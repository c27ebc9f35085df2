"""What the command prints."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from rich import box
from rich.console import Console
from rich.markup import escape
from rich.table import Table

from forgetting.words.rounding import brief, with_unit

if TYPE_CHECKING:
    from forgetting.judgement import Judgement
    from forgetting.record import Identification


CHANGES = 5
"""Changes that are printed; JSON and report have all of them."""


class Quiet(Console):
    """A console whose reader may leave: what is left is not printed, and the work goes on."""

    def on_broken_pipe(self) -> None:
        """Print nowhere from now on."""
        leave_quietly()


def console() -> Console:
    """A console on today's stdout (tests and pipes replace it)."""
    return Quiet(highlight=False, soft_wrap=True)


def say(text: str) -> None:
    """Print a text; a reader that has left (such as `head`) is no error."""
    try:
        print(text, flush=True)
    except BrokenPipeError:
        leave_quietly()


def leave_quietly() -> None:
    """Send what is still to be printed nowhere, so that the flush at exit finds no closed pipe."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def table(title: str, header: Sequence[str], rows: Sequence[Sequence[str]]) -> Table:
    """A plain table, numbers to the right; a long name is folded, a number never."""
    made = Table(title=title, title_justify="left", title_style="bold", box=box.SIMPLE_HEAD)
    made.add_column(header[0], overflow="fold")
    for position, name in enumerate(header[1:], start=1):
        width = max(len(row[position]) for row in [header, *rows])
        made.add_column(name, justify="right", min_width=width)
    for row in rows:
        made.add_row(*map(escape, row))
    return made


def print_identification(found: Identification) -> None:
    """Print the verdict, parameters, scores, counts and findings."""
    from forgetting.record.ahead import about_intervals

    out = console()
    samples = found.samples
    out.print(f"[bold]{escape(samples.source)}[/]  {escape(samples.model)}")
    for word, text in samples.facts()[1:]:
        out.print(escape(text if word == "clock" else f"{word} {text}"))
    out.print(f"rule {escape(found.rule_in_words)}")
    print_headline(found.judgement, out)
    out.print(parameters(found))
    out.print(escape(found.uncertainty), "\n")
    if found.memories is not None:
        out.print(escape(found.memories.describe()), "\n")
    out.print(scores(found))
    for sentence in about_intervals(found):
        out.print(escape(sentence), "\n")
    out.print(f"samples     {len(samples.y)}: {found.used} used, {found.left_out()}")
    for change in found.changes[:CHANGES]:
        out.print(escape(str(change)))
    if len(found.changes) > CHANGES:
        out.print(f"and {len(found.changes) - CHANGES} more changes, see --json")
    out.print(f"covariance  largest / smallest eigenvalue of P at the end: {spread(found)}")
    out.print()
    print_findings(found.judgement, out)


MARKS = {"wrong": ("✗", "red"), "warning": ("!", "yellow"), "good": ("✓", "green")}
"""A sign and a colour for each severity."""


def print_judgement(judgement: Judgement) -> None:
    """Print the verdict and all findings."""
    out = console()
    print_headline(judgement, out)
    print_findings(judgement, out)


def print_headline(judgement: Judgement, out: Console) -> None:
    """The verdict and the first thing to do, in the colour of its severity."""
    colour = MARKS[judgement.severity][1]
    out.print(f"[bold {colour}]verdict {escape(judgement.verdict)}[/]\n")


def print_findings(judgement: Judgement, out: Console) -> None:
    """A line for each finding, the worst first."""
    for finding in judgement.findings:
        mark, colour = MARKS[finding.severity]
        out.print(f"[{colour}]{mark}[/] {finding.name:<11} {escape(str(finding))}")


def spread(found: Identification) -> str:
    """Largest over smallest eigenvalue, with both."""
    ends = found.trace.eigenvalues[-1]
    largest, smallest = brief(float(ends[-1]), 3), brief(float(ends[0]), 3)
    return f"{largest} / {smallest} = {brief(found.covariance_ratio, 3)}"


def parameters(found: Identification) -> Table:
    """Final values ± standard errors."""
    from forgetting.record.parameters import table as in_words

    more, rows = in_words(found)
    header = ("regressor", "value", "± standard error")
    return table("Parameters", (*header, *more), rows)


def scores(found: Identification) -> Table:
    """One-step RMSE beside the baselines."""
    result = found.scores
    rows = [
        (
            with_unit(name, found.unit(name)),
            brief(result.model[j]),
            f"{result.fit[j]:.2f} %".replace("-", "−"),
            brief(result.no_forgetting[j]),
            brief(result.last_value[j]),
        )
        for j, name in enumerate(found.samples.outputs)
    ]
    title = f"One-step RMSE on {result.samples} samples"
    return table(title, ("output", "this model", "fit", "no forgetting", "last value"), rows)


def print_written(paths: Sequence[Path]) -> None:
    """Say where the files are."""
    out = console()
    for number, path in enumerate(paths):
        out.print(f"{'' if number else chr(10)}wrote {escape(str(path))}")
