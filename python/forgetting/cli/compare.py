"""`forgetting compare`."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
import typer

import forgetting as fg
from forgetting.cli import options
from forgetting.cli.identify import check_targets, parse_covariance, parse_orders
from forgetting.cli.progress import progress_bar
from forgetting.cli.rulebook import about, make_rule
from forgetting.cli.source import read_record, show_record
from forgetting.cli.tables import console, print_written, table
from forgetting.words.errors import RecordError
from forgetting.words.rounding import brief

if TYPE_CHECKING:
    from forgetting.record import Identification

MEANING = (
    "Each prediction is made before its sample is learned. Left out: samples that were missing, "
    "in a dead zone or within the bound on the noise. Largest eigenvalue and condition number of P "
    "are those at the end."
)
HEADER = ("rule", "one-step RMSE", "left out", "max eig P", "cond P")


def compare(
    record: options.RecordFile,
    formula: options.Formula = None,
    output: options.Outputs = None,
    input: options.Inputs = None,
    arx: options.Orders = None,
    time: options.Time = None,
    gap: options.Gap = None,
    missing: options.Missing = None,
    part: options.Part = None,
    encoding: options.Encoding = None,
    show: options.Show = False,
    rules: Annotated[
        str, typer.Option("--rules", help="all, or registry names with commas.")
    ] = "all",
    forgetting_factor: options.ForgettingFactor = None,
    initial_covariance: options.InitialCovariance = "auto",
    report: options.Report = None,
) -> None:
    """Run forgetting rules side by side on a record, ranked by their one-step error.

    Every rule has its default parameters and, if it uses one, the same forgetting factor.
    """
    from forgetting.record.identify import identify

    check_targets(record, report, None, None)
    source = read_record(record, time, gap, missing, part, encoding)
    if show:
        return show_record(source)
    model: dict[str, Any] = {
        "formula": formula,
        "output": output or (),
        "input": input or (),
        "arx": None if arx is None else parse_orders(arx),
        "initial_covariance": parse_covariance(initial_covariance),
    }
    found: list[tuple[str, Identification]] = []
    refused: list[str] = []
    for name in chosen(rules):
        try:
            rule = make_rule(name, factor_for(name, forgetting_factor), None, [])
            with progress_bar(f"{name} on {record.name}") as progress:
                found.append((name, identify(source, rule=rule, progress=progress, **model)))
        except fg.NumericalRange as error:
            refused.append(f"{name}: {error}")
    found.sort(key=lambda each: error_of(each[1]))
    print_ranking([row(name, each) for name, each in found], refused)
    if report is not None:
        save(found, refused, report)
        print_written([report])


def chosen(rules: str) -> list[str]:
    """The rules asked for; all of those that need no function of the user's."""
    if rules == "all":
        every = fg.rules()
        return [r["name"] for r in every if not any(p["required"] for p in r["parameters"])]
    names = [name.strip() for name in rules.split(",") if name.strip()]
    if not names:
        raise RecordError("--rules names no rule; say all, or registry names with commas")
    return [str(about(name)["name"]) for name in names]


def factor_for(name: str, forgetting_factor: float | None) -> float | None:
    """The factor asked for, if the rule uses one."""
    return forgetting_factor if about(name)["forgetting_factor"] else None


def error_of(found: Identification) -> float:
    """Root mean square one-step error over all outputs."""
    return float(np.sqrt(np.mean(np.square(np.atleast_1d(found.scores.model)))))


def row(name: str, found: Identification) -> tuple[str, ...]:
    """One line of the table."""
    largest = float(found.trace.eigenvalues[-1][-1])
    left_out = len(found.samples.y) - found.used
    ratio = f"{found.covariance_ratio:.3g}"
    return (name, brief(error_of(found)), str(left_out), f"{largest:.3g}", ratio)


def print_ranking(rows: list[tuple[str, ...]], refused: list[str]) -> None:
    """Print the ranking, and which rules did not get through the record."""
    out = console()
    out.print(table("Rules by one-step error", HEADER, rows))
    for sentence in refused:
        out.print(f"refused: {sentence}", markup=False)


def save(found: list[tuple[str, Identification]], refused: list[str], path: Path) -> None:
    """Write the ranking as one page."""
    from forgetting.report.page import Block, Figure, Page, Table, write

    best = found[0][1] if found else None
    write(
        Page(
            title="Forgetting rules side by side",
            subtitle="" if best is None else f"{best.samples.source} · {best.samples.model}",
            facts=() if best is None else best.samples.facts(),
            verdicts=[f"Refused: {sentence}" for sentence in refused],
            figures=[
                Figure(f"{place}. {name}", brief(error_of(each)), each.rule_in_words)
                for place, (name, each) in enumerate(found[:3], start=1)
            ],
            blocks=[
                Block(
                    title="Ranked by one-step error",
                    text=MEANING,
                    table=Table(HEADER, [row(name, each) for name, each in found]),
                )
            ],
        ),
        path,
    )
