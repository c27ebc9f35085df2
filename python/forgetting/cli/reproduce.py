"""`forgetting reproduce`."""

from __future__ import annotations

import time
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from forgetting.cli.claims import print_claims
from forgetting.cli.progress import progress_bar
from forgetting.cli.tables import console, print_written

if TYPE_CHECKING:
    from forgetting.papers import Check, Claim


def reproduce(
    paper: Annotated[
        str | None, typer.Argument(help="vdf, gf, opd, or all three if absent.")
    ] = None,
    example: Annotated[
        int | None, typer.Option("--example", help="Only this example of the tutorial (vdf).")
    ] = None,
    seeds: Annotated[
        int | None,
        typer.Option(
            "--seeds", min=2, help="Noise realisations of the opd experiment; 200 if absent."
        ),
    ] = None,
    output: Annotated[
        Path, typer.Option("--output", "-o", help="Folder for what is written; made when absent.")
    ] = Path("forgetting-papers"),
) -> int:
    """Regenerate the examples, figures and tables of the three papers, and check every claim.

    Writes the figures (PNG and SVG), claims.csv and report.html. The exit code is 0 only if every
    claim in the table holds.
    """
    from forgetting.papers.catalogue import all_checks, all_pictures
    from forgetting.papers.claim import SEEDS
    from forgetting.papers.page import write_page
    from forgetting.papers.picture import save
    from forgetting.papers.table import summary, write_csv

    seeds = SEEDS if seeds is None else seeds
    checks, pictures = all_checks(paper, example), all_pictures(paper, example)
    output.mkdir(parents=True, exist_ok=True)
    begin, claims = time.perf_counter(), []
    with progress_bar("papers") as report:
        total = len(checks) + len(pictures)
        for done, check in enumerate(checks, start=1):
            claims.append(measured(check, seeds))
            if report:
                report(done, total)
        files = []
        for done, each in enumerate(pictures, start=len(checks) + 1):
            files += save(each, output, seeds)
            if report:
                report(done, total)
    table, page = output / "claims.csv", output / "report.html"
    write_csv(claims, table)
    write_page(claims, checks, pictures, output, page)
    print_claims(claims, f"{summary(claims)}, in {time.perf_counter() - begin:.0f} s")
    print_written([page, table, *files[:1]])
    if len(files) > 1:
        console().print(f"and {len(files) - 1} more figure files beside it")
    return 0 if all(claim.holds for claim in claims) else 1


def measured(check: Check, seeds: int) -> Claim:
    """Measure a claim; one that cannot be measured does not hold, and the others go on."""
    from forgetting.papers import Claim

    try:
        return check(seeds)
    except Exception as error:
        words = f"could not be measured: {type(error).__name__}: {error}"
        return Claim(check.source, check.printed, words, check.verdict, check.reason, False)
