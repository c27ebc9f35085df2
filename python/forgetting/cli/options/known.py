"""The options that say what is known of parameters."""

from __future__ import annotations

from typing import Annotated

from forgetting.cli.options.group import KNOWN, option

Bounds = Annotated[
    str | None,
    option(
        KNOWN,
        "Smallest and largest value, as in 'R0=0:,a=-1:1'; estimates outside are moved inside.",
        "--bounds",
        metavar="NAME=LOW:HIGH,...",
    ),
]
Fixed = Annotated[
    str | None,
    option(
        KNOWN,
        "Values that are known exactly, as in 'b=2.5'.",
        "--fixed",
        metavar="NAME=VALUE,...",
    ),
]
FeedBack = Annotated[
    bool,
    option(
        KNOWN,
        "Whether the estimator goes on from what --bounds moved; of a rule, not of the bank.",
        "--feed-back/--no-feed-back",
    ),
]
Prior = Annotated[
    str | None,
    option(
        KNOWN,
        "A value and its standard deviation, before the first sample, as in 'R0=0.05+-0.02'.",
        "--prior",
        metavar="NAME=VALUE+-SD,...",
    ),
]
Noise = Annotated[
    float | None,
    option(
        KNOWN,
        "Standard deviation of the noise, which priors are weighed against; a record tells it by "
        "itself, a stream does not.",
        "--noise",
    ),
]
