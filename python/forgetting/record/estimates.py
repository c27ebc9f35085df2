"""The estimates of every sample as a table, and as a file."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

import forgetting as fg
from forgetting.files import whole
from forgetting.record.samples import Samples
from forgetting.record.trace import Trace
from forgetting.words.errors import RecordError

Array = NDArray[np.float64]

SUFFIXES = (".parquet", ".csv")


def table(samples: Samples, trace: Trace, prediction: Array, standard_error: Array) -> pd.DataFrame:
    """One row per sample; a column's name has the quantity and its owner: ``estimate:poa``.

    ``row`` counts from 1 below the header. With several outputs the estimate columns name both,
    ``estimate:V:I(k)``.

    Parameters
    ----------
    samples, trace
        The problem and its run.
    prediction : ndarray, shape (T, m)
    standard_error : ndarray, shape (T, n, m)
    """
    columns: dict[str, Any] = {"row": range(1, len(samples.y) + 1)}
    if samples.clock is not None:
        columns["time"] = samples.clock.values.to_numpy()
    for j, output in enumerate(samples.outputs):
        columns[f"measured:{output}"] = samples.y[:, j]
        columns[f"predicted:{output}"] = prediction[:, j]
        columns[f"error:{output}"] = trace.error[:, j]
    columns["forgetting_factor"] = trace.forgetting_factor
    columns["leverage"] = trace.leverage
    columns["skipped"] = [fg.SKIPPED[code] or "used" for code in trace.skipped.tolist()]
    for j, output in enumerate(samples.outputs):
        prefix = f"{output}:" if len(samples.outputs) > 1 else ""
        for i, name in enumerate(samples.regressors):
            columns[f"estimate:{prefix}{name}"] = trace.theta[:, i, j]
            columns[f"standard_error:{prefix}{name}"] = standard_error[:, i, j]
    return pd.DataFrame(columns)


def save(frame: pd.DataFrame, path: Path) -> None:
    """Write the table by suffix."""
    if path.suffix.lower() not in SUFFIXES:
        raise RecordError(f"estimates go to .parquet or .csv, but the file is {path.name!r}")
    try:
        with whole(path) as made:
            if path.suffix.lower() == ".csv":
                frame.to_csv(made, index=False)
            else:
                frame.to_parquet(made, index=False)
    except ImportError:
        raise RecordError(
            "writing Parquet needs pyarrow; install it with pip install 'forgetting[cli]'"
        ) from None
