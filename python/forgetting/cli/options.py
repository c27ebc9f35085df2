"""Options of `forgetting identify`, in the groups in which its help shows them."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

MODEL, READING, RULE = "Model", "Reading the record", "Forgetting"
KNOWN = "What is known of parameters, by their names"
FILES = "What to write"


def option(panel: str, text: str, *names: str, **more: Any) -> Any:
    """An option in a group of the help."""
    return typer.Option(*names, rich_help_panel=panel, help=text, **more)


RecordFile = Annotated[
    Path,
    typer.Argument(
        help="Measured record: text with any separator, Parquet (a folder, too), Arrow, Excel, "
        "MAT, JSON lines, TDMS, MDF, ULog; packed or not; - is standard input."
    ),
]
Formula = Annotated[
    str | None,
    option(
        MODEL,
        "Regression, as in 'power ~ 0 + sun + sun:warmth'; lag(x, 1) is x one row ago.",
        "--formula",
        "-f",
    ),
]
Outputs = Annotated[
    list[str] | None,
    option(MODEL, "Output column of an ARX model; repeat for several.", "--output", "-y"),
]
Inputs = Annotated[
    list[str] | None,
    option(MODEL, "Input column of an ARX model; repeat for several.", "--input", "-u"),
]
Orders = Annotated[
    str | None,
    option(
        MODEL,
        "Orders: past outputs, inputs, delay of the newest input; nb and nk as in 2/1 where two "
        "inputs have their own.",
        "--arx",
        metavar="NA,NB,NK",
    ),
]
ModelText = Annotated[
    str | None,
    option(
        MODEL,
        "Structure and orders in the place of --arx: fir, ar, arx, arma, armax, oe or bj, as in "
        "armax:na=2,nb=2,nc=1,nk=1; nb=2/1 for two inputs.",
        "--model",
        metavar="NAME:ORDERS",
    ),
]
Offset = Annotated[
    bool,
    option(
        MODEL,
        "Whether an ARX model has a constant, as data about an operating point need.",
        "--offset/--no-offset",
    ),
]
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
