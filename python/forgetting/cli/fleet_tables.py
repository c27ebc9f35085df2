"""What `forgetting fleet` says of many streams: the most striking of each kind."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

from rich.markup import escape

from forgetting.cli.tables import console, table
from forgetting.words.rounding import brief

if TYPE_CHECKING:
    from forgetting.tables.resumable import Work
    from forgetting.tables.survey import Survey

SHOWN, LISTED = 10, 1000
"""Streams of a kind in the terminal and in JSON; the file of --streams has all."""


def print_survey(work: Work, found: Survey) -> None:
    """Print a fleet at a glance."""
    out, totals = console(), found.totals
    model = work.fleet.model
    out.print(f"[bold]{escape(model.y)}[/] by {escape(model.key)}: {totals['streams']} streams")
    out.print(f"regressors  {escape(', '.join(model.regressors))}")
    out.print(f"partitions  {len(work.done)} done, {len(work.left)} left")
    counts = ", ".join(f"{totals[name]} {name}" for name in ("missing", "late"))
    out.print(f"rows        {totals['rows']}: {totals['samples']} used, {counts}")
    if work.rows:
        rate = work.rows / work.seconds
        out.print(
            f"this run    {work.rows} rows in {brief(work.seconds, 3)} s, {rate:,.0f} a second"
        )
    if found.refused:
        title = f"Saved states refused: {len(found.refused)} streams"
        _print(title, (model.key, "why"), list(found.refused.items()))
    _print(f"Windup: {len(found.windup)} streams", (model.key, "status"), found.windup)
    _print(
        f"Outliers: {len(found.outliers)} streams with |z| > {found.limit:.1f}",
        (model.key, "parameter", "value", "median", "z"),
        [
            (o.key, o.regressor, brief(o.value), brief(o.median), brief(o.z, 3))
            for o in found.outliers
        ],
    )
    for name, listed in (("Late", found.late), ("Missing", found.missing)):
        _print(f"{name} rows: {len(listed)} streams", (model.key, name.lower(), "of rows"), listed)


def _print(title: str, header: Sequence[str], rows: Sequence[Sequence[Any]]) -> None:
    """A table of the first rows, if there are any."""
    if not rows:
        console().print(title.replace(": 0 streams", ": no streams"))
        return
    shown = [[str(cell) for cell in row] for row in rows[:SHOWN]]
    console().print(table(title, header, shown))
    if len(rows) > SHOWN:
        console().print(f"  and {len(rows) - SHOWN} more; --streams and --json list them")


def as_data(work: Work, found: Survey) -> dict[str, Any]:
    """The same in plain values, with more of each kind."""
    model = work.fleet.model
    named = (model.key, "rows", "of")
    return {
        "key": model.key,
        "output": model.y,
        "regressors": model.regressors,
        "partitions": {"done": list(work.done), "left": [each.name for each in work.left]},
        "this_run": {"rows": work.rows, "seconds": work.seconds},
        "totals": found.totals,
        "refused": [{"key": key, "why": why} for key, why in found.refused.items()][:LISTED],
        "windup": [{"key": key, "status": status} for key, status in found.windup[:LISTED]],
        "outlier_limit": found.limit,
        "outliers": {
            "streams": len(found.outliers),
            "first": [asdict(each) for each in found.outliers[:LISTED]],
        },
        "late": [dict(zip(("key", *named[1:]), row, strict=True)) for row in found.late[:LISTED]],
        "missing": [
            dict(zip(("key", *named[1:]), row, strict=True)) for row in found.missing[:LISTED]
        ],
    }
