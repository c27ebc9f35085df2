"""The options that say how the record is read."""

from __future__ import annotations

from typing import Annotated

from forgetting.cli.options.group import READING, option

Time = Annotated[
    str | None,
    option(
        READING,
        "Time column, when it is not found by itself; DATE,TIME for two; none for no clock.",
        "--time",
        metavar="COLUMN",
    ),
]
Gap = Annotated[
    str | None,
    option(
        READING,
        "Longest step in time across which lags reach, such as 5min, or none for any; "
        "1.5 median steps when absent.",
        "--gap",
        metavar="DURATION",
    ),
]
Missing = Annotated[
    list[str] | None,
    option(
        READING,
        "A word or number that stands for a missing value, such as -200; repeat for several.",
        "--missing",
        metavar="WORD",
    ),
]
Part = Annotated[
    str | None,
    option(
        READING,
        "Sheet, group, topic, structure, or file of an archive.",
        "--part",
        metavar="NAME",
    ),
]
Encoding = Annotated[
    str | None,
    option(READING, "Encoding of text, such as cp1250 or shift_jis.", "--encoding"),
]
Every = Annotated[
    str | None,
    option(
        READING,
        "Join columns of several rates to one clock with this step, such as 1s.",
        "--every",
        metavar="DURATION",
    ),
]
Hold = Annotated[
    list[str] | None,
    option(
        READING,
        "With --every: columns of which the last value is taken, as of all that are not named.",
        "--hold",
        metavar="COLUMNS",
    ),
]
Mean = Annotated[
    list[str] | None,
    option(
        READING,
        "With --every: columns of which the mean over each step is taken.",
        "--mean",
        metavar="COLUMNS",
    ),
]
Nearest = Annotated[
    list[str] | None,
    option(
        READING,
        "With --every: columns of which the nearest value is taken.",
        "--nearest",
        metavar="COLUMNS",
    ),
]
Age = Annotated[
    str | None,
    option(
        READING,
        "With --every: how old a held value, or how far a nearest one, may be.",
        "--age",
        metavar="DURATION",
    ),
]
Show = Annotated[bool, option(READING, "Only say how the record is read.", "--show")]
