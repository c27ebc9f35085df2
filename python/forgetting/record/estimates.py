"""An identification as tables: the estimates of every sample, and a summary."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pandas as pd

import forgetting as fg
from forgetting.record.errors import RecordError

if TYPE_CHECKING:
    from forgetting.record.identification import Identification

SUFFIXES = (".parquet", ".csv")


def table(found: Identification) -> pd.DataFrame:
    """One row per sample; columns say what they hold and of what: ``estimate:poa``.

    ``row`` counts from 1 below the header. With several outputs the estimate columns name both,
    ``estimate:V:I(k)``.
    """
    samples, trace = found.samples, found.trace
    columns: dict[str, Any] = {"row": range(1, len(samples.y) + 1)}
    if samples.clock is not None:
        columns["time"] = samples.clock.values.to_numpy()
    for j, output in enumerate(samples.outputs):
        columns[f"measured:{output}"] = samples.y[:, j]
        columns[f"predicted:{output}"] = found.prediction[:, j]
        columns[f"error:{output}"] = trace.error[:, j]
    columns["forgetting_factor"] = trace.forgetting_factor
    columns["leverage"] = trace.leverage
    columns["skipped"] = [fg.SKIPPED[code] or "used" for code in trace.skipped.tolist()]
    for j, output in enumerate(samples.outputs):
        prefix = f"{output}:" if len(samples.outputs) > 1 else ""
        for i, name in enumerate(samples.regressors):
            columns[f"estimate:{prefix}{name}"] = trace.theta[:, i, j]
            columns[f"standard_error:{prefix}{name}"] = found.standard_error[:, i, j]
    return pd.DataFrame(columns)


def save(found: Identification, path: Path) -> None:
    """Write the table by suffix."""
    if path.suffix.lower() not in SUFFIXES:
        raise RecordError(f"estimates go to .parquet or .csv, but the file is {path.name!r}")
    frame = table(found)
    if path.suffix.lower() == ".csv":
        frame.to_csv(path, index=False)
        return
    try:
        frame.to_parquet(path, index=False)
    except ImportError:
        raise RecordError(
            "writing Parquet needs pyarrow; install it with pip install 'forgetting[cli]'"
        ) from None


def summary(found: Identification) -> dict[str, Any]:
    """Plain numbers and text; a number that is not finite becomes None, as JSON has no NaN."""
    samples, scores = found.samples, found.scores
    rows = found.parameters.to_dict("records")
    return {
        "record": samples.source,
        "model": samples.model,
        "rule": repr(found.rule),
        "parameters": [{key: finite(value) for key, value in row.items()} for row in rows],
        "rmse": {
            output: {
                "model": finite(scores.model[j]),
                "last_value": finite(scores.last_value[j]),
                "no_forgetting": finite(scores.no_forgetting[j]),
            }
            for j, output in enumerate(samples.outputs)
        },
        "samples": {
            "rows": len(samples.y),
            "used": found.used,
            "missing": found.missing,
            "dead_zone": found.dead_zone,
            "within_bound": found.within_bound,
            "held": found.held,
            "frozen": found.frozen,
            "scored": scores.samples,
        },
        "covariance": {
            "smallest_eigenvalue": finite(float(found.trace.eigenvalues[-1][0])),
            "largest_eigenvalue": finite(float(found.trace.eigenvalues[-1][-1])),
            "ratio": finite(found.covariance_ratio),
        },
        "windup_samples": int(found.trace.windup.sum()),
        "verdicts": found.verdicts,
    }


def finite(value: Any) -> Any:
    """None in place of NaN and infinity."""
    return None if isinstance(value, float) and not math.isfinite(value) else value
