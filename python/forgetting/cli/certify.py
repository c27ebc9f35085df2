"""`forgetting certify`."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

import forgetting as fg
from forgetting.cli import options
from forgetting.cli.identify import parse_covariance, parse_orders
from forgetting.cli.rulebook import make_gate, make_rule
from forgetting.cli.source import Rates, read_record, show_record
from forgetting.cli.tables import say

if TYPE_CHECKING:
    from forgetting.record.samples import Samples

DIFFUSE = 1e5
"""P before the first sample when none is given, as in `forgetting.RLS`."""
OUTPUTS = ["error", "forgetting_factor", "skipped", "covariance", "prior_covariance", "weight"]


def certify(
    record: options.RecordFile,
    formula: options.Formula = None,
    output: options.Outputs = None,
    input: options.Inputs = None,
    arx: options.Orders = None,
    time: options.Time = None,
    gap: options.Gap = None,
    missing: options.Missing = None,
    part: options.Part = None,
    encoding: options.Encoding = None,
    every: options.Every = None,
    hold: options.Hold = None,
    mean: options.Mean = None,
    nearest: options.Nearest = None,
    age: options.Age = None,
    show: options.Show = False,
    rule: options.RuleName = "subspace",
    forgetting_factor: options.ForgettingFactor = None,
    rate: options.RateText = None,
    threshold: options.Threshold = None,
    settings: options.Settings = None,
    gate: options.GateText = None,
    initial_covariance: options.InitialCovariance = "auto",
    as_json: options.Json = False,
) -> int:
    """Say when to trust the estimates: excitation, stability, bounds and windup.

    Exit code 0, or 1 when the covariance wound up. Samples with a missing value are skipped.
    Without an initial covariance regressors are measured in units of their root mean square.
    """
    from forgetting import analysis
    from forgetting.record.identify import build, listed

    source = read_record(
        record, time, gap, missing, part, encoding, Rates(every, hold, mean, nearest, age)
    )
    if show:
        show_record(source)
        return 0
    made = make_rule(rule or "subspace", forgetting_factor, threshold, settings or [], rate)
    orders = None if arx is None else parse_orders(arx)
    samples = build(source, formula, listed(output or ()), listed(input or ()), orders)
    start = parse_covariance(initial_covariance)
    units = np.ones(samples.phi.shape[1])
    if start is None:
        start, units = DIFFUSE, root_mean_squares(samples.phi)
    phi = samples.phi / units
    est = fg.RLS(
        phi.shape[1],
        rule=made,
        gate=make_gate(gate),
        targets=samples.y.shape[1],
        initial_covariance=start,
    )
    start = np.asarray(est.covariance)
    found = analysis.certify(
        est.run(phi, samples.y, outputs=OUTPUTS, missing="skip"),
        phi,
        initial_covariance=start,
        rule=made,
        names=list(samples.regressors),
    )
    say(in_json(found, samples) if as_json else f"{samples.clock_in_words()}\n{found}")
    return 1 if found.windup_occurred else 0


def root_mean_squares(phi: NDArray[np.float64]) -> NDArray[np.float64]:
    """The unit of each regressor: the root mean square of its values that are there and not 0."""
    squares = np.where(np.isnan(phi), 0.0, phi) ** 2
    counts = np.count_nonzero(squares, axis=0)
    return np.where(counts, np.sqrt(squares.sum(axis=0) / np.maximum(counts, 1)), 1.0)


def in_json(found: Any, samples: Samples) -> str:
    """The certificate and the clock as JSON."""
    return json.dumps(found.to_dict() | {"clock": samples.clock_as_data()}, indent=2)
