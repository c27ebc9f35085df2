"""Partitions of the rows of a fleet, and what the command is to make of them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pyarrow as pa
from pyarrow import feather, parquet

from forgetting.tables import TableFleet

MODEL = ("--by", "device", "--time", "t", "--output", "y", "--input", "u")
DEVICES, ROWS, FILES = 30, 600, 4


def part(k: int, rows: int = ROWS) -> pa.Table:
    """Rows of partition k: y = 2 u + 1, one device with a slope of its own."""
    random = np.random.default_rng(k)
    device, u = random.integers(0, DEVICES, rows), random.normal(size=rows)
    y = np.where(device == 17, 9.0, 2.0 + 0.01 * device) * u + 1.0 + 0.1 * random.normal(size=rows)
    y[random.uniform(size=rows) < 0.02] = np.nan
    names = np.array([f"dev {d:02d}" for d in device])
    return pa.table({"device": names, "t": k * rows + random.permutation(rows), "u": u, "y": y})


def write(folder: Path) -> None:
    """Write the partitions to a folder."""
    for k in range(FILES):
        parquet.write_table(part(k), folder / f"part{k}.parquet", row_group_size=100)


def whole_fleet() -> TableFleet:
    """What the command is to come to."""
    fleet = TableFleet("device", "y", "u", time="t", offset=True)
    for k in range(FILES):
        fleet.update(part(k))
    return fleet


def whole_fleet_told() -> list[pa.Table]:
    """What is told of each partition."""
    fleet = TableFleet("device", "y", "u", time="t", offset=True)
    return [fleet.update(part(k)) for k in range(FILES)]


def streams_of(path: Path) -> list[dict[str, object]]:
    return feather.read_table(path).to_pylist()
