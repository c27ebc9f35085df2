"""The estimates of every sample as a table, and as a file."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

import forgetting as fg
from forgetting.extras import extra
from forgetting.files import whole
from forgetting.record.intervals import OneStep
from forgetting.record.samples import Samples
from forgetting.record.trace import Trace
from forgetting.words.errors import RecordError

Array = NDArray[np.float64]

SUFFIXES = (".parquet", ".csv")


def table(
    samples: Samples,
    trace: Trace,
    standard_error: Callable[[int, int, slice], Array],
    part: slice | None = None,
    intervals: OneStep | None = None,
) -> pd.DataFrame:
    """One row per sample; a column's name has the quantity and its owner: ``estimate:poa``.

    ``row`` counts from 1 below the header. With several outputs the estimate columns name both,
    ``estimate:V:I(k)``.

    Parameters
    ----------
    samples, trace
        The problem and its run.
    standard_error : callable
        ± of parameter i of output j after some rows.
    part : slice, optional
        These rows only.
    intervals : OneStep, optional
        About the predictions; ``lower:V`` and ``upper:V`` are the conformal ones.
    """
    rows = slice(0, len(samples.y)) if part is None else part
    columns: dict[str, Any] = {"row": range(rows.start + 1, rows.stop + 1)}
    if samples.clock is not None:
        columns["time"] = samples.clock.values.iloc[rows].to_numpy()
    for j, output in enumerate(samples.outputs):
        columns[f"measured:{output}"] = samples.as_measured[rows, j]
        columns[f"predicted:{output}"] = samples.as_measured[rows, j] - trace.error[rows, j]
        columns[f"error:{output}"] = trace.error[rows, j]
        if intervals is not None:
            ends = intervals.columns(columns[f"predicted:{output}"], j, rows)
            columns |= {f"{end}:{output}": values for end, values in ends.items()}
    columns["forgetting_factor"] = trace.forgetting_factor[rows]
    columns["leverage"] = trace.leverage[rows]
    columns["skipped"] = [fg.SKIPPED[code] or "used" for code in trace.skipped[rows].tolist()]
    for j, output in enumerate(samples.outputs):
        prefix = f"{output}:" if len(samples.outputs) > 1 else ""
        for i, name in enumerate(samples.regressors):
            columns[f"estimate:{prefix}{name}"] = trace.theta[rows, i, j]
            columns[f"standard_error:{prefix}{name}"] = standard_error(i, j, rows)
    return pd.DataFrame(columns)


def save(tables: Iterable[pd.DataFrame], path: Path) -> None:
    """Write the rows of tables with the same columns, by suffix: a long record is not there twice.

    Raises
    ------
    RecordError
        For another suffix, or without pyarrow.
    """
    if path.suffix.lower() not in SUFFIXES:
        raise RecordError(f"estimates go to .parquet or .csv, but the file is {path.name!r}")
    write = save_csv if path.suffix.lower() == ".csv" else save_parquet
    try:
        with whole(path) as made:
            write(tables, made)
    except ImportError as error:
        raise RecordError(str(error)) from None


def save_csv(tables: Iterable[pd.DataFrame], path: Path) -> None:
    """Write names once, and all rows."""
    for number, frame in enumerate(tables):
        frame.to_csv(path, index=False, header=not number, mode="a" if number else "w")


def save_parquet(tables: Iterable[pd.DataFrame], path: Path) -> None:
    """Write a group of rows a table."""
    arrow, parquet = (extra(module, "writing Parquet") for module in ("pyarrow", "pyarrow.parquet"))
    parts = iter(tables)
    first = arrow.Table.from_pandas(next(parts), preserve_index=False)
    with parquet.ParquetWriter(path, first.schema) as writer:
        writer.write_table(first)
        for frame in parts:
            writer.write_table(arrow.Table.from_pandas(frame, first.schema, preserve_index=False))
