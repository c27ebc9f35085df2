"""The options that say what is written."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from forgetting.cli.options.group import FILES, option

Level = Annotated[
    float | None,
    option(
        FILES,
        "Share that intervals about one-step predictions are to hold, such as 0.95; their ends are "
        "columns of the estimates, and what they held is told.",
        "--level",
    ),
]
Ahead = Annotated[
    str | None,
    option(
        FILES,
        "With --level: how many samples ahead to forecast all along the record, such as 1,24; what "
        "the intervals about forecasts held is told. Of --arx and --model, with one output.",
        "--ahead",
        metavar="STEPS",
    ),
]
Report = Annotated[
    Path | None,
    option(
        FILES,
        "One self-contained page with tables and pictures.",
        "--report",
        metavar="FILE.html",
    ),
]
Estimates = Annotated[
    Path | None,
    option(FILES, "Every sample's estimate, .parquet or .csv.", "--estimates", metavar="FILE"),
]
Plot = Annotated[
    Path | None,
    option(FILES, "One picture, .png, .svg or .pdf.", "--plot", metavar="FILE.png"),
]
Json = Annotated[bool, option(FILES, "Print the result as JSON.", "--json")]
