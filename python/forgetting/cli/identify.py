"""`forgetting identify`."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING

from forgetting.cli import options
from forgetting.cli.parse import parse_covariance, parse_known, parse_steps
from forgetting.cli.progress import progress_bar
from forgetting.cli.rulebook import check_half_life, make_gate, rule_or_auto
from forgetting.cli.source import show_record, told
from forgetting.cli.tables import print_identification, print_written, say
from forgetting.files import check_outputs
from forgetting.words.errors import RecordError

if TYPE_CHECKING:
    from forgetting.record import Identification


def identify(
    record: options.model.RecordFile,
    formula: options.model.Formula = None,
    output: options.model.Outputs = None,
    input: options.model.Inputs = None,
    arx: options.model.Orders = None,
    model: options.model.ModelText = None,
    offset: options.model.Offset = True,
    time: options.reading.Time = None,
    gap: options.reading.Gap = None,
    missing: options.reading.Missing = None,
    part: options.reading.Part = None,
    encoding: options.reading.Encoding = None,
    every: options.reading.Every = None,
    hold: options.reading.Hold = None,
    mean: options.reading.Mean = None,
    nearest: options.reading.Nearest = None,
    age: options.reading.Age = None,
    show: options.reading.Show = False,
    rule: options.rule.RuleName = None,
    forgetting_factor: options.rule.ForgettingFactor = None,
    half_life: options.rule.HalfLife = None,
    by_clock: options.rule.ByClock = False,
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
    level: options.writing.Level = None,
    ahead: options.writing.Ahead = None,
    report: options.writing.Report = None,
    estimates: options.writing.Estimates = None,
    plot: options.writing.Plot = None,
    as_json: options.writing.Json = False,
) -> None:
    """Identify a model from a measured record.

    Say the model by --formula, or by --output, --input and --arx or --model.

    Prints parameters with standard errors, and the one-step error beside two baselines.
    """
    source, said = told(**locals())
    from forgetting.record.identify import identify as identify_record

    check_targets(record, report, estimates, plot)
    if dtype not in ("float64", "float32"):
        raise RecordError(f"--dtype is {dtype!r}; it must be float64 or float32")
    if show:
        return show_record(source())
    check_half_life(half_life, forgetting_factor, rate)
    chosen = rule_or_auto(rule, forgetting_factor, threshold, settings or [], rate)
    before = make_gate(gate)
    with progress_bar(f"identifying {record.name}") as progress:
        found = identify_record(
            source,
            **said,
            rule=chosen,
            half_life=half_life,
            by_clock=by_clock,
            gate=before,
            initial_covariance=parse_covariance(initial_covariance),
            dtype=dtype,
            bounds=parse_known("bounds", bounds),
            fixed=parse_known("fixed", fixed),
            prior=parse_known("prior", prior),
            noise=noise,
            feed_back=feed_back,
            level=level,
            ahead=parse_steps(ahead),
            progress=progress,
        )
    print_result(found, write(found, report, estimates, plot), as_json)


def print_result(found: Identification, written: list[Path], as_json: bool) -> None:
    """Print the result for a person or for a program."""
    if as_json:
        result = found.summary() | {"written": [str(path) for path in written]}
        say(json.dumps(result, indent=2, ensure_ascii=False))
        return
    print_identification(found)
    print_written(written)


def write(
    found: Identification, report: Path | None, estimates: Path | None, plot: Path | None
) -> list[Path]:
    """Write what was asked for; pages and pictures are loaded only then."""
    if report is not None:
        from forgetting.report import save

        save(found, report)
    if estimates is not None:
        found.save_estimates(estimates)
    if plot is not None:
        from forgetting.plot import save_overview

        save_overview(found, plot)
    return [path for path in (report, estimates, plot) if path is not None]


def check_targets(
    record: Path, report: Path | None, estimates: Path | None, plot: Path | None
) -> None:
    """Refuse a file that cannot be written, or must not be, before the work and not after it."""
    for option, path, suffixes in (
        ("--report", report, (".html", ".htm")),
        ("--estimates", estimates, (".parquet", ".csv")),
        ("--plot", plot, (".png", ".svg", ".pdf")),
    ):
        if path is None:
            continue
        if path.suffix.lower() not in suffixes:
            raise RecordError(f"{option} writes {', '.join(suffixes)}, but got {path.name!r}")
    outputs = {"--report": report, "--estimates": estimates, "--plot": plot}
    check_outputs(outputs, None if str(record) == "-" else record)
