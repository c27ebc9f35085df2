"""`forgetting tune`."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Annotated

from forgetting.cli import options
from forgetting.cli.identify import check_targets
from forgetting.cli.progress import progress_bar
from forgetting.cli.source import read_record, show_record
from forgetting.cli.tables import print_written, say
from forgetting.cli.tuned import print_tuning
from forgetting.words.errors import RecordError

if TYPE_CHECKING:
    pass


def tune(
    record: options.model.RecordFile,
    formula: options.model.Formula = None,
    output: options.model.Outputs = None,
    input: options.model.Inputs = None,
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
    model: Annotated[
        str | None,
        options.option(
            options.MODEL,
            "Structure in the place of --arx: fir, ar, arx, arma, armax, oe or bj, and orders, "
            "each a number or a range, as in armax:na=1-3,nb=1-3,nc=0-2,nk=1-4; of those not named "
            "the usual ones.",
            "--model",
            metavar="NAME:ORDERS",
        ),
    ] = None,
    offset: options.model.Offset = True,
    time: options.reading.Time = None,
    gap: options.reading.Gap = None,
    missing: options.reading.Missing = None,
    part: options.reading.Part = None,
    encoding: options.reading.Encoding = None,
    show: options.reading.Show = False,
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
    share: options.rule.Share = 2 / 3,
    plot: options.writing.Plot = None,
    as_json: options.writing.Json = False,
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
            model=model,
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
