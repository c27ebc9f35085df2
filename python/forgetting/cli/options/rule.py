"""The options that say how the estimator forgets, starts and computes."""

from __future__ import annotations

from typing import Annotated

from forgetting.cli.options.group import RULE, option

RuleName = Annotated[
    str | None,
    option(
        RULE,
        "Forgetting rule; 'forgetting rules' lists them. Without one, rules of all speeds are "
        "mixed by how well they predict.",
        "--rule",
        "-r",
    ),
]
ForgettingFactor = Annotated[
    float | None,
    option(
        RULE,
        "In (0, 1]; 1 never forgets, 0.99 remembers about 100 samples.",
        "--forgetting-factor",
        "-l",
    ),
]
HalfLife = Annotated[
    str | None,
    option(
        RULE,
        "In place of the factor: the time after which half is forgotten, such as 10min "
        "by the clock, or 50 (samples).",
        "--half-life",
        metavar="DURATION",
    ),
]
ByClock = Annotated[
    bool,
    option(
        RULE,
        "Forget by time in place of samples, the bank too: after a step of three usual ones as "
        "after three.",
        "--by-clock",
    ),
]
RateText = Annotated[
    str | None,
    option(
        RULE,
        "A variable forgetting factor in place of a number, such as f_test or "
        "noise_power:ratio=2,smallest=0.8.",
        "--rate",
        metavar="NAME[:NAME=VALUE,...]",
    ),
]
Threshold = Annotated[
    float | None,
    option(RULE, "Smallest regressor that counts as information (rule subspace).", "--threshold"),
]
Settings = Annotated[
    list[str] | None,
    option(
        RULE,
        "Any other parameter of the rule; repeat for several.",
        "--set",
        metavar="NAME=VALUE",
    ),
]
GateText = Annotated[
    str | None,
    option(
        RULE,
        "Whether a sample is used: minimum_information, dead_zone; with parameters as in "
        "dead_zone:width=2,otherwise=freeze.",
        "--gate",
        metavar="NAME[:NAME=VALUE,...]",
    ),
]
InitialCovariance = Annotated[
    str,
    option(
        RULE,
        "P before the first sample: one number, or one per parameter, with commas; auto follows "
        "the data, and units do not matter.",
        "--initial-covariance",
        metavar="P0",
    ),
]
Share = Annotated[
    float,
    option(
        RULE,
        "Of the complete samples, those that choose; the rest is what is reported on.",
        "--share",
        metavar="SHARE",
        show_default="two thirds",
    ),
]
Dtype = Annotated[str, option(RULE, "float64 or float32.", "--dtype")]
