"""`forgetting compare`."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

import forgetting as fg
from forgetting.cli import options
from forgetting.cli.identify import check_targets
from forgetting.cli.parse import parse_covariance
from forgetting.cli.progress import progress_bar
from forgetting.cli.rulebook import about
from forgetting.cli.source import show_record, told
from forgetting.cli.tables import console, print_written, say, table
from forgetting.words.errors import RecordError
from forgetting.words.rounding import brief

if TYPE_CHECKING:
    from forgetting.record.comparison import Compared, Comparison

MEANING = (
    "Factor: the forgetting factor, of a random walk its process noise. Each prediction is made "
    "before its sample is learned. Left out: samples that were missing, in a dead zone or within "
    "the bound on the noise. Largest eigenvalue and condition number of P are those at the end."
)
HEADER = ("rule", "factor", "RMSE", "left out", "max eig P", "cond P")


def compare(
    record: options.model.RecordFile,
    formula: options.model.Formula = None,
    output: options.model.Outputs = None,
    input: options.model.Inputs = None,
    arx: options.model.Orders = None,
    model: options.model.ModelText = None,
    offset: options.model.Offset = True,
    time: options.reading.Time = None,
    gap: options.reading.Gap = None,
    missing: options.reading.Missing = None,
    part: options.reading.Part = None,
    encoding: options.reading.Encoding = None,
    every: options.reading.Every = None,
    hold: options.reading.Hold = None,
    mean: options.reading.Mean = None,
    nearest: options.reading.Nearest = None,
    age: options.reading.Age = None,
    show: options.reading.Show = False,
    rules: Annotated[
        str, typer.Option("--rules", help="all, or registry names with commas.")
    ] = "all",
    forgetting_factor: options.rule.ForgettingFactor = None,
    share: options.rule.Share = 2 / 3,
    initial_covariance: options.rule.InitialCovariance = "auto",
    report: options.writing.Report = None,
    plot: options.writing.Plot = None,
    as_json: options.writing.Json = False,
) -> None:
    """Run forgetting rules side by side on a record, ranked by their one-step error.

    Every rule has its default parameters and its own best forgetting factor (a random walk its
    best process noise), chosen on the first part of the record; ranked by the rest. With
    --forgetting-factor all have that one, and all samples count, as they do in a short record.
    """
    source, said = told(**locals())
    from forgetting.record.compare import compare as compare_rules

    check_targets(record, report, None, plot)
    if plot is not None and forgetting_factor is not None:
        raise RecordError("--plot draws the error over the factor, which --forgetting-factor fixes")
    if show:
        return show_record(source())
    with progress_bar(f"comparing on {record.name}") as progress:
        found = compare_rules(
            source,
            chosen(rules),
            **said,
            initial_covariance=parse_covariance(initial_covariance),
            forgetting_factor=forgetting_factor,
            share=share,
            progress=progress,
        )
    written = write(found, report, plot)
    if as_json:
        result = found.summary() | {"written": [str(path) for path in written]}
        return say(json.dumps(result, indent=2, ensure_ascii=False))
    print_ranking(found)
    print_written(written)


def chosen(rules: str) -> list[str]:
    """The rules asked for; all of those that need no function of the user's."""
    if rules == "all":
        every = fg.rules()
        return [r["name"] for r in every if not any(p["required"] for p in r["parameters"])]
    names = [name.strip() for name in rules.split(",") if name.strip()]
    if not names:
        raise RecordError("--rules names no rule; say all, or registry names with commas")
    return [str(about(name)["name"]) for name in names]


def row(each: Compared) -> tuple[str, ...]:
    """One line of the table."""
    largest, ratio = f"{each.eigenvalues[-1]:.3g}", f"{each.covariance_ratio:.3g}"
    error = brief(each.error)
    return (each.name, shown(each.setting), error, str(each.left_out), largest, ratio)


def shown(setting: tuple[str, Any] | None) -> str:
    """The value of a setting; a dash for a rule that has none."""
    return "-" if setting is None else f"{setting[1]:g}" if isinstance(setting[1], float) else "…"


def print_ranking(found: Comparison) -> None:
    """Print the ranking, and which rules did not get through the record."""
    out = console()
    title = f"Rules by one-step error of {found.scored_in_words()}"
    out.print(table(title, HEADER, [row(each) for each in found.ranked]))
    for sentence in found.refused:
        out.print(f"refused: {sentence}", markup=False)
    if found.reservation is not None:
        out.print(found.reservation)


def write(found: Comparison, report: Path | None, plot: Path | None) -> list[Path]:
    """Write what was asked for; pages and pictures are loaded only then."""
    if plot is not None and found.unchosen is not None:
        raise RecordError(f"--plot: there is no choice to draw ({found.unchosen})")
    if report is not None:
        save(found, report)
    if plot is not None:
        from forgetting.plot.tuning import save_factors

        save_factors(found.trials, None, "Chosen on the first part of the record", plot)
    return [path for path in (report, plot) if path is not None]


def save(found: Comparison, path: Path) -> None:
    """Write the ranking as one page."""
    from forgetting.report.page import Block, Figure, Page, Table, write

    samples = found.samples
    errors = f"Errors of {found.scored_in_words()}."
    write(
        Page(
            title="Forgetting rules side by side",
            subtitle=f"{samples.source} · {samples.model}",
            facts=samples.facts(),
            verdicts=[f"Refused: {sentence}" for sentence in found.refused],
            figures=[
                Figure(f"{place}. {each.name}", brief(each.error), repr(each.rule))
                for place, each in enumerate(found.ranked[:3], start=1)
            ],
            blocks=[
                Block(
                    title="Ranked by one-step error",
                    text=" ".join(filter(None, [errors, MEANING, found.reservation])),
                    table=Table(HEADER, [row(each) for each in found.ranked]),
                )
            ],
        ),
        path,
    )
