"""Rows of many streams, and what one machine makes of them."""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
from pyarrow import parquet

from forgetting.tables import TableFleet

SETTINGS: dict[str, Any] = {"offset": True, "rule": "subspace", "initial_covariance": 100.0}
START = 1_700_000_000_000_000
"""Microseconds of the first row."""


def table(rows: int = 3000, keys: int = 40, seed: int = 0, first: int = 0) -> pa.Table:
    """Rows in any order; some have no number, and times come twice here and there."""
    random = np.random.default_rng(seed)
    key = random.integers(0, keys, rows)
    u = random.normal(size=rows)
    y = (1.0 + 0.1 * key) * u + 0.3 + 0.01 * random.normal(size=rows)
    y[random.uniform(size=rows) < 0.02] = np.nan
    seconds = first + random.integers(0, rows, rows)
    instants = START + 1_000_000 * seconds + 123
    return pa.table(
        {
            "meter": [f"m{k}" for k in key.tolist()],
            "t": pa.array(instants, pa.timestamp("us", "UTC")),
            "u": pa.array(u, mask=random.uniform(size=rows) < 0.02),
            "y": y,
            "row": np.arange(rows) + 1_000_000 * first,
        }
    )


def in_files(folder: Path, tables: Iterable[pa.Table]) -> str:
    """Files of a stream, a second apart: Spark takes files by the time of their last change."""
    folder.mkdir()
    for number, each in enumerate(tables):
        file = folder / f"{number:03}.parquet"
        parquet.write_table(each, file)
        os.utime(file, (START // 1_000_000 + number,) * 2)
    return str(folder)


def in_order(given: pa.Table) -> pa.Table:
    """The rows by time; those of one time in the order that Spark takes them in."""
    order = [(name, "ascending") for name in ("t", "y", "u")]
    return given.sort_by(order)


def told_alone(fleet: TableFleet, given: pa.Table, outputs: Any) -> pa.Table:
    """What a fleet on one machine tells of rows, by the number of the row."""
    ordered = in_order(given)
    told = fleet.update(ordered, outputs).append_column("row", ordered.column("row"))
    return told.sort_by("row")


def assert_equal_rows(found: pa.Table, expected: pa.Table) -> None:
    """That each row was told once, and as one machine tells it, bit for bit."""
    found = found.sort_by("row")
    assert found.column("row").to_pylist() == expected.column("row").to_pylist()
    for name in expected.column_names:
        assert found.column(name).to_pylist() == expected.column(name).to_pylist(), name


def assert_equal_states(found: pa.Table, fleet: TableFleet) -> None:
    """That streams have come to the same states as those of a fleet, bit for bit."""
    states = dict(
        zip(found.column("meter").to_pylist(), found.column("state").to_pylist(), strict=True)
    )
    assert len(states) == len(found)
    assert states == {key: fleet[key].to_bytes() for key in fleet}
    counted = fleet.estimates().sort_by("meter")
    for name in counted.column_names:
        assert found.sort_by("meter").column(name).to_pylist() == counted.column(name).to_pylist()
