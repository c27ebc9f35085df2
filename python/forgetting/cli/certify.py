"""`forgetting certify`."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import numpy as np

from forgetting.cli import options
from forgetting.cli.identify import check_targets
from forgetting.cli.parse import parse_covariance
from forgetting.cli.progress import progress_bar
from forgetting.cli.rulebook import check_half_life, make_gate, make_rule
from forgetting.cli.source import show_record, told
from forgetting.cli.tables import print_judgement, print_written, say

if TYPE_CHECKING:
    from forgetting.analysis import Certificate
    from forgetting.record import Identification


def certify(
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
    rule: options.rule.RuleName = "subspace",
    forgetting_factor: options.rule.ForgettingFactor = None,
    half_life: options.rule.HalfLife = None,
    by_clock: options.rule.ByClock = False,
    rate: options.rule.RateText = None,
    threshold: options.rule.Threshold = None,
    settings: options.rule.Settings = None,
    gate: options.rule.GateText = None,
    initial_covariance: options.rule.InitialCovariance = "auto",
    report: options.writing.Report = None,
    as_json: options.writing.Json = False,
) -> int:
    """Say when to trust the estimates: the judgement of `identify`, and what theory guarantees.

    Exit code 0, or 1 when the covariance wound up. Samples with a missing value are skipped.
    """
    source, said = told(**locals())
    from forgetting.record.identify import identify
    from forgetting.record.theory import theory

    check_targets(record, report, None, None)
    if show:
        show_record(source())
        return 0
    check_half_life(half_life, forgetting_factor, rate)
    made = make_rule(rule or "subspace", forgetting_factor, threshold, settings or [], rate)
    before, start = make_gate(gate), parse_covariance(initial_covariance)
    timing: dict[str, Any] = {"half_life": half_life, "by_clock": by_clock}
    with progress_bar(f"certifying {record.name}") as progress:
        found = identify(
            source,
            **said,
            rule=made,
            **timing,
            gate=before,
            initial_covariance=start,
            progress=progress,
        )
    certificate, first = theory(found, made, before, start, **timing)
    if report is not None:
        from forgetting.report import save_certificate

        save_certificate(found, certificate, first, report)
    if as_json:
        say(in_json(found, certificate, first))
    else:
        print_certificate(found, certificate, first)
        print_written([] if report is None else [report])
    return 0 if found.judgement["windup"].severity == "good" else 1


def print_certificate(found: Identification, certificate: Certificate, first: int) -> None:
    """Print the judgement and what theory says."""
    from forgetting.record.theory import reservation

    say(f"{found.samples.clock_in_words()}\nrule {found.rule_in_words}")
    print_judgement(found.judgement)
    say(f"\n{certificate.theory(first)}")
    limits = reservation(found.samples)
    if limits is not None:
        say(f"Reservation\n  {limits}")


def in_json(found: Identification, certificate: Certificate, first: int) -> str:
    """The judgement, the certificate and the clock as JSON."""
    from forgetting.record.theory import reservation

    theory = certificate.to_dict()
    written = found.judgement.to_dict()
    return json.dumps(
        {
            "verdict": written["verdict"],
            "judgement": written,
            "windup_occurred": bool(found.trace.windup.any()),
            "windup": windup(found),
            "first_row_examined": first + 1,
            **{name: theory[name] for name in ("excitation", "conditions", "stability")},
            "confidence": theory["confidence"],
            "reservation": reservation(found.samples),
            "clock": found.samples.clock_as_data(),
        },
        indent=2,
    )


def windup(found: Identification) -> dict[str, Any]:
    """Where the monitor saw windup."""
    rows = np.flatnonzero(found.trace.windup)
    return {
        "occurred": bool(len(rows)),
        "sample": int(rows[0]) if len(rows) else None,
        "samples": len(rows),
        "persists": bool(found.trace.windup[-1]),
    }
