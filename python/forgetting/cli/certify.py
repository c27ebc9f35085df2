"""`forgetting certify`."""

from __future__ import annotations

import json

import numpy as np

import forgetting as fg
from forgetting.cli import options
from forgetting.cli.identify import parse_covariance, parse_orders
from forgetting.cli.rulebook import make_rule

OUTPUTS = ["theta", "error", "leverage", "forgetting_factor", "skipped", "covariance"]


def certify(
    record: options.RecordFile,
    formula: options.Formula = None,
    output: options.Outputs = None,
    input: options.Inputs = None,
    arx: options.Orders = None,
    time: options.Time = None,
    rule: options.RuleName = "subspace",
    forgetting_factor: options.ForgettingFactor = None,
    threshold: options.Threshold = None,
    settings: options.Settings = None,
    initial_covariance: options.InitialCovariance = "100",
    as_json: options.Json = False,
) -> int:
    """Say when to trust the estimates: excitation, stability, bounds and windup.

    Exit code 0, or 1 when the covariance wound up. Samples with a missing value are left out.
    """
    from forgetting import analysis
    from forgetting.record.identify import build, listed
    from forgetting.record.read import read

    made = make_rule(rule, forgetting_factor, threshold, settings or [])
    orders = None if arx is None else parse_orders(arx)
    source = read(record, time)
    samples = build(source, formula, listed(output or ()), listed(input or ()), orders)
    complete = ~(np.isnan(samples.phi).any(axis=1) | np.isnan(samples.y).any(axis=1))
    phi, y = samples.phi[complete], samples.y[complete]
    covariance = parse_covariance(initial_covariance)
    est = fg.RLS(phi.shape[1], rule=made, targets=y.shape[1], initial_covariance=covariance)
    start = np.asarray(est.covariance)
    found = analysis.certify(
        est.run(phi, y, outputs=OUTPUTS),
        phi,
        initial_covariance=start,
        rule=made,
        names=list(samples.regressors),
    )
    print(json.dumps(found.to_dict(), indent=2) if as_json else str(found))
    return 1 if found.windup_occurred else 0
