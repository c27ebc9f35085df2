"""`forgetting stream`."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from forgetting.cli import options
from forgetting.cli.parse import parse_covariance, parse_known, parse_orders
from forgetting.cli.rulebook import check_half_life, make_gate, rule_or_auto
from forgetting.files import check_outputs
from forgetting.words.errors import RecordError

if TYPE_CHECKING:
    from forgetting.stream import Stream
    from forgetting.stream.inputs import Input
    from forgetting.stream.output import Output
    from forgetting.stream.settings import Settings

OUT, STATE = "What is written", "Going on after a stop"


def stream(
    source: Annotated[
        Path, typer.Argument(help="CSV with a line of names, or JSON lines; - is standard input.")
    ] = Path("-"),
    follow: Annotated[
        bool,
        options.option(
            options.READING, "Wait for more at the end of the file, as tail -F does.", "--follow"
        ),
    ] = False,
    formula: options.model.Formula = None,
    output: options.model.Outputs = None,
    input: options.model.Inputs = None,
    arx: options.model.Orders = None,
    model: options.model.ModelText = None,
    offset: options.model.Offset = True,
    time: options.reading.Time = None,
    gap: Annotated[
        str | None,
        options.option(
            options.READING,
            "Longest step in time across which lags reach, such as 5min, or none for any; "
            "1.5 medians of the last steps when absent.",
            "--gap",
            metavar="DURATION",
        ),
    ] = None,
    missing: options.reading.Missing = None,
    separator: Annotated[
        str | None,
        options.option(
            options.READING, "Between cells, when the first lines do not tell.", "--separator"
        ),
    ] = None,
    names: Annotated[
        str | None,
        options.option(
            options.READING, "Names of the columns, with commas, when no line has them.", "--names"
        ),
    ] = None,
    rule: options.rule.RuleName = None,
    forgetting_factor: options.rule.ForgettingFactor = None,
    half_life: options.rule.HalfLife = None,
    rate: options.rule.RateText = None,
    threshold: options.rule.Threshold = None,
    settings: options.rule.Settings = None,
    gate: options.rule.GateText = None,
    initial_covariance: options.rule.InitialCovariance = "auto",
    dtype: options.rule.Dtype = "float64",
    bounds: options.known.Bounds = None,
    fixed: options.known.Fixed = None,
    prior: options.known.Prior = None,
    noise: options.known.Noise = None,
    feed_back: options.known.FeedBack = False,
    to: Annotated[str, options.option(OUT, "json (an object a line) or csv.", "--to")] = "json",
    fields: Annotated[
        str | None,
        options.option(
            OUT,
            "What is written of every row, with commas: row, time, measured, prediction, error, "
            "theta, standard_errors, noise_variance, leverage, forgetting_factor, memory, weight, "
            "weights, skipped, gate.",
            "--fields",
            metavar="NAMES",
        ),
    ] = None,
    state: Annotated[
        Path | None,
        options.option(
            STATE, "Save all that the next line needs, and go on from there.", "--state"
        ),
    ] = None,
    save_every: Annotated[
        int,
        options.option(STATE, "Rows after which to save, and every two seconds.", "--save-every"),
    ] = 1000,
    live: Annotated[
        bool,
        options.option(OUT, "Show the stream on a page of this machine as it goes.", "--live"),
    ] = False,
    port: Annotated[
        int | None,
        options.option(OUT, "Port of that page, 8470 when absent; 0 for any.", "--port"),
    ] = None,
) -> None:
    """Follow a sensor: one line of estimates for every line that comes.

    Say the model by --formula, or by --output with --input, and --arx or --model for its
    dynamics. Alarms
    (windup, a parameter that nothing excites, a change) are lines of their own.
    """
    from forgetting.stream.pump import Pump
    from forgetting.stream.stream import Stream

    check_options(to, dtype, save_every, source, follow, state)
    check_half_life(half_life, forgetting_factor, rate)
    told = made_settings(
        formula=formula,
        output=tuple(output or ()),
        input=tuple(input or ()),
        arx=None if arx is None else parse_orders(arx),
        model=model,
        offset=offset,
        rule=rule_or_auto(rule, forgetting_factor, threshold, settings or [], rate),
        half_life=half_life,
        gate=make_gate(gate),
        initial_covariance=parse_covariance(initial_covariance),
        dtype=dtype,
        bounds=parse_known("bounds", bounds),
        fixed=parse_known("fixed", fixed),
        prior=parse_known("prior", prior),
        noise=noise,
        feed_back=feed_back,
        time=time,
        gap=gap,
        missing=tuple(missing or ()),
        separator=separator,
        names=names,
    )
    lines = opened(source, follow)
    made = Stream(told, to, fields, standard_errors=live)
    try:
        with page(made, live, port) as watchers:
            pump = Pump(made, lines, sys.stdout.fileno(), tell, state, save_every, watchers)
            pump.resume()
            pump.run()
    finally:
        lines.close()


@contextmanager
def page(stream: Stream, live: bool, port: int | None) -> Iterator[list[Callable[[Output], None]]]:
    """Serve the page while the block runs; yield what must be told of every block of lines."""
    if not live:
        if port is not None:
            raise RecordError("--port is that of the page of --live, which is not asked for")
        yield []
        return
    from forgetting.stream.live import Events, Server

    if port is not None and not 0 <= port <= 65535:
        raise RecordError(f"--port is {port}; it must be from 0 to 65535")
    server = Server(Events(stream)) if port is None else Server(Events(stream), port)
    server.start()
    tell(f"live at {server.address}")
    try:
        yield [server.events.take]
    finally:
        server.stop()


def made_settings(
    gap: str | None, separator: str | None, names: str | None, **more: Any
) -> Settings:
    """Settings of what the options say."""
    from forgetting.record.clock import gap_of
    from forgetting.stream.form import separator_of
    from forgetting.stream.settings import Settings

    given = None if names is None else [name.strip() for name in names.split(",")]
    return Settings(gap=gap_of(gap), separator=separator_of(separator), names=given, **more)


def check_options(
    to: str, dtype: str, save_every: int, source: Path, follow: bool, state: Path | None
) -> None:
    """Refuse what can be seen to be wrong before a line is read."""
    if to not in ("json", "csv"):
        raise RecordError(f"--to is {to!r}; it must be json or csv")
    if dtype not in ("float64", "float32"):
        raise RecordError(f"--dtype is {dtype!r}; it must be float64 or float32")
    if save_every < 1:
        raise RecordError(f"--save-every is {save_every}; it must be at least 1")
    is_pipe = str(source) == "-"
    if follow and is_pipe:
        raise RecordError("--follow needs a file; standard input is followed to its end anyway")
    if not is_pipe and source.is_dir():
        raise RecordError(f"{source} is a folder; a stream is a file or standard input")
    if not is_pipe and not follow and source.exists() and not source.is_file():
        raise RecordError(f"{source} is no file on a disk; read it as standard input: - < {source}")
    if not is_pipe and not follow and not source.is_file():
        raise RecordError(f"there is no file {source}")
    check_outputs({"--state": state}, None if is_pipe else source)


def opened(source: Path, follow: bool) -> Input:
    """What lines are read from."""
    from forgetting.stream.inputs import File, Pipe

    return Pipe(sys.stdin.fileno()) if str(source) == "-" else File(source, follow)


def tell(sentence: str) -> None:
    """Say something beside the lines."""
    print(f"forgetting: {sentence}.", file=sys.stderr, flush=True)
