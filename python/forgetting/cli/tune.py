"""`forgetting tune`."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import TYPE_CHECKING, Annotated, Any

from rich.markup import escape

from forgetting.cli import options
from forgetting.cli.identify import check_targets
from forgetting.cli.progress import progress_bar
from forgetting.cli.source import read_record, show_record
from forgetting.cli.tables import console, print_written, say, table
from forgetting.tuning.code import code
from forgetting.words.errors import RecordError
from forgetting.words.rounding import brief

if TYPE_CHECKING:
    from forgetting.tuning import Tuning

Table = tuple[tuple[str, ...], Sequence[tuple[str, ...]]]

BEST = 8
"""Rules and factors that are shown."""


def tune(
    record: options.RecordFile,
    formula: options.Formula = None,
    output: options.Outputs = None,
    input: options.Inputs = None,
    arx: Annotated[
        str | None,
        options.option(
            options.MODEL,
            "Orders of an ARX model, each a number or a range as in 1-4,1-4,0-3, which is what is "
            "tried without this option.",
            "--arx",
            metavar="NA,NB,NK",
        ),
    ] = None,
    offset: options.Offset = True,
    time: options.Time = None,
    gap: options.Gap = None,
    missing: options.Missing = None,
    part: options.Part = None,
    encoding: options.Encoding = None,
    show: options.Show = False,
    rules: Annotated[
        str,
        options.option(options.RULE, "shortlist, all, or registry names with commas.", "--rules"),
    ] = "shortlist",
    rates: Annotated[
        bool,
        options.option(options.RULE, "Whether variable factors are tried.", "--rates/--no-rates"),
    ] = True,
    priors: Annotated[
        bool,
        options.option(
            options.RULE,
            "Whether priors are tried beside the one that follows the data.",
            "--priors/--no-priors",
        ),
    ] = True,
    share: options.Share = 2 / 3,
    plot: options.Plot = None,
    as_json: options.Json = False,
) -> None:
    """Choose rule, forgetting factor, rate, prior and orders, and say whether it pays.

    Chosen on the first part of the record by the one-step error, and reported on the rest, which no
    choice has seen, beside the bank (of which nothing is chosen), no forgetting and the last value.
    Prints the line to use.
    """
    from forgetting.record.tune import tune as tune_record

    check_targets(record, None, None, plot)
    if show:
        return show_record(read_record(record, time, gap, missing, part, encoding))
    with progress_bar(f"tuning on {record.name}") as progress:
        found = tune_record(
            record,
            formula=formula,
            output=output or (),
            input=input or (),
            arx=None if arx is None else parse_ranges(arx),
            offset=offset,
            rules=parse_rules(rules),
            rates=rates,
            priors=priors,
            share=share,
            time=time,
            gap=gap,
            missing=missing or (),
            part=part,
            encoding=encoding,
            progress=progress,
        )
    written = [] if plot is None else [plot]
    if plot is not None:
        from forgetting.plot.tuning import save_tuning

        save_tuning(found, plot)
    if as_json:
        result = found.summary() | {"written": [str(path) for path in written]}
        return say(json.dumps(result, indent=2, ensure_ascii=False))
    print_tuning(found)
    print_written(written)


def parse_rules(text: str) -> str | list[str]:
    """One word, or names with commas."""
    if text in ("shortlist", "all"):
        return text
    names = [name.strip() for name in text.split(",") if name.strip()]
    if not names:
        raise RecordError("--rules names no rule; say shortlist, all, or names with commas")
    return names


def parse_ranges(text: str) -> list[list[int]]:
    """Read na,nb,nk, each a number or a range.

    Examples
    --------
    >>> parse_ranges("1-3,2,0-1")
    [[1, 2, 3], [2], [0, 1]]
    """
    try:
        ends = [[int(end) for end in part.split("-", 1)] for part in text.split(",")]
    except ValueError:
        ends = []
    if len(ends) != 3 or any(each[0] > each[-1] or each[-1] > 1000 for each in ends):
        raise RecordError(
            "--arx takes na,nb,nk, each a whole number up to 1000 or a range such as 1-4, "
            f"but got {text!r}"
        )
    return [list(range(each[0], each[-1] + 1)) for each in ends]


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
    model = "" if orders is None else f" of ARX({orders.na},{orders.nb},{orders.nk})"
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
