"""`forgetting fleet`."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from forgetting.cli import options
from forgetting.cli.fleet_tables import as_data, print_survey
from forgetting.cli.parse import parse_covariance, parse_orders
from forgetting.cli.progress import rate_bar
from forgetting.cli.rulebook import check_half_life, make_gate, make_rule, rule_or_auto
from forgetting.cli.tables import print_written, say
from forgetting.files import check_outputs, whole
from forgetting.words.errors import RecordError

if TYPE_CHECKING:
    from forgetting.tables import TableFleet
    from forgetting.tables.resumable import Work

REFUSED = 1
"""Exit code when the saved state of a stream was refused."""

Data = Annotated[
    list[str],
    typer.Argument(
        help="Parquet, Arrow or CSV files: names, patterns such as 'data/*.parquet', folders. "
        "They are taken in the order of their names."
    ),
]
By = Annotated[str, options.option(options.MODEL, "Column that says whose row it is.", "--by")]
Output = Annotated[
    str, options.option(options.MODEL, "Column of the measurements.", "--output", "-y")
]
Inputs = Annotated[
    list[str] | None,
    options.option(
        options.MODEL,
        "Regressor, or input of an ARX model; repeat for several.",
        "--input",
        "-u",
    ),
]
Offset = Annotated[
    bool, options.option(options.MODEL, "Whether the model has a constant.", "--offset/--no-offset")
]
RuleName = Annotated[
    str | None,
    options.option(
        options.RULE,
        "Forgetting rule; 'forgetting rules' lists them. Without one, a bounded random walk; "
        "'auto' mixes walks of eight speeds and takes 1.5 kB a stream of four parameters.",
        "--rule",
        "-r",
    ),
]
Time = Annotated[
    str | None,
    options.option(
        options.READING,
        "Time column: rows of a stream are taken in its order, and late ones are left out. "
        "Without it the given order counts.",
        "--time",
        metavar="COLUMN",
    ),
]
Gap = Annotated[
    str | None,
    options.option(
        options.READING,
        "Longest step in time across which lags reach, such as 5min; any when absent.",
        "--gap",
        metavar="DURATION",
    ),
]
BatchRows = Annotated[
    int, options.option(options.READING, "Rows in memory at a time.", "--batch-rows")
]
Out = Annotated[
    Path | None,
    options.option(options.FILES, "Folder for a Parquet file of rows told a partition.", "--out"),
]
Told = Annotated[
    str,
    options.option(
        options.FILES,
        "What is told of each row: some of prediction, error, leverage, theta, variance, skipped.",
        "--tell",
        metavar="NAME,...",
    ),
]
State = Annotated[
    Path | None,
    options.option(
        options.FILES,
        "State of all streams, an Arrow file written after each partition; if it is there, the "
        "work goes on from it.",
        "--state",
        metavar="FILE.arrow",
    ),
]
Streams = Annotated[
    Path | None,
    options.option(
        options.FILES, "Where every stream stands at the end.", "--streams", metavar="FILE.parquet"
    ),
]


def fleet(
    data: Data,
    by: By,
    output: Output,
    input: Inputs = None,
    arx: options.model.Orders = None,
    model: Annotated[
        str | None,
        options.option(
            options.MODEL,
            "Structure and orders in the place of --arx: fir, ar or arx, as in arx:na=1,nb=2,nk=0.",
            "--model",
            metavar="NAME:ORDERS",
        ),
    ] = None,
    offset: Offset = True,
    time: Time = None,
    gap: Gap = None,
    batch_rows: BatchRows = 1_000_000,
    rule: RuleName = None,
    forgetting_factor: options.rule.ForgettingFactor = None,
    half_life: options.rule.HalfLife = None,
    rate: options.rule.RateText = None,
    threshold: options.rule.Threshold = None,
    settings: options.rule.Settings = None,
    gate: options.rule.GateText = None,
    initial_covariance: options.rule.InitialCovariance = "auto",
    dtype: options.rule.Dtype = "float64",
    out: Out = None,
    tell: Told = "prediction,error,skipped",
    state: State = None,
    streams: Streams = None,
    as_json: options.writing.Json = False,
) -> int:
    """Follow many streams in tables larger than memory: an estimator for each key.

    Every row goes to the estimator of its key. At the end says which streams wind up, which have
    parameters unlike the others', and which rows were late or missing. Exit code 1 when the saved
    state of a stream was refused.
    """
    from forgetting.tables.partitions import find
    from forgetting.tables.resumable import Work

    check_half_life(half_life, forgetting_factor, rate)
    if streams is not None and streams.suffix.lower() != ".parquet":
        raise RecordError(f"--streams writes .parquet, but got {streams.name!r}")
    partitions = find(data)
    for read in (*map(Path, data), *(each.path for each in partitions)):
        check_outputs({"--state": state, "--streams": streams}, read)
    chosen = rule_of(rule, forgetting_factor, half_life, threshold, settings or [], rate)
    made = new_fleet(
        (by, output, input or (), time),
        arx=None if arx is None else parse_orders(arx),
        model=model,
        offset=offset,
        gap=gap,
        gate=make_gate(gate),
        initial_covariance=parse_covariance(initial_covariance),
        dtype=dtype,
        **chosen,
    )
    told = [name.strip() for name in tell.split(",")]
    work = Work(made, partitions, out, state, told, batch_rows)
    with rate_bar("partitions") as progress:
        work.run(progress)
    return finish(work, streams, as_json)


def new_fleet(columns: tuple[Any, ...], **settings: Any) -> TableFleet:
    """A fleet that has seen nothing."""
    from forgetting.tables import TableFleet

    by, output, inputs, time = columns
    return TableFleet(by, output, tuple(inputs), time=time, **settings)


def rule_of(
    name: str | None,
    forgetting_factor: float | None,
    half_life: str | None,
    threshold: float | None,
    settings: list[str],
    rate: str | None,
) -> dict[str, Any]:
    """The rule, and the half-life where that goes by the clock; a number of samples is a factor."""
    said = forgetting_factor is not None or threshold is not None or settings or rate is not None
    if name is None and not said and half_life is None:
        return {}
    if name == "auto":
        if half_life is not None:
            raise RecordError("--half-life needs a rule with a forgetting factor, not 'auto'")
        return {"rule": rule_or_auto(name, forgetting_factor, threshold, settings, rate)}
    made = make_rule(name or "subspace", forgetting_factor, threshold, settings, rate)
    if half_life is None:
        return {"rule": made}
    try:
        samples = float(half_life)
    except ValueError:
        return {"rule": made, "half_life": half_life}
    from forgetting.tables.half_life import with_half_life

    return {"rule": with_half_life(made, samples)}


def finish(work: Work, streams: Path | None, as_json: bool) -> int:
    """Write where streams stand, and say what is worth a look."""
    from forgetting.tables.survey import survey

    if streams is not None:
        from pyarrow import parquet

        with whole(streams) as made:
            parquet.write_table(work.fleet.estimates(), made)
    found = survey(work.fleet)
    written = [path for path in (work.out, work.state, streams) if path is not None]
    if as_json:
        data = as_data(work, found) | {"written": [str(path) for path in written]}
        say(json.dumps(data, indent=2, ensure_ascii=False, default=str))
    else:
        print_survey(work, found)
        print_written(written)
    return REFUSED if found.refused else 0
