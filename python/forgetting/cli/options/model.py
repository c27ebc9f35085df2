"""The options that say what the record is and which model it is of."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from forgetting.cli.options.group import MODEL, option

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
