"""Tables of many streams, and the estimators that each stream would have alone."""

from __future__ import annotations

from typing import Any

import numpy as np
import pyarrow as pa

import forgetting as fg
from forgetting.tables import TableFleet

ROWS = {"key": ["a", "b", "a"], "t": [1, 1, 2], "x": [1.0, 2.0, 2.0], "y": [3.0, 8.0, 6.0]}


def new(**more: Any) -> TableFleet:
    """A fleet for `ROWS`."""
    return TableFleet("key", "y", "x", **{"time": "t", **more})


def table(rows: int = 600, keys: int = 7, seed: int = 0, skewed: bool = False) -> pa.Table:
    """Rows of a few streams in any order, with nulls, NaN and infinite values here and there."""
    random = np.random.default_rng(seed)
    share = random.dirichlet(np.full(keys, 0.3 if skewed else 50.0))
    key = random.choice(keys, size=rows, p=share)
    x, z = random.normal(size=(2, rows))
    x[(key % 3 == 0) & (random.uniform(size=rows) < 0.5)] = 0.0
    y = (key + 1.0) * x - 0.5 * z + 0.1 * random.normal(size=rows)
    y[random.uniform(size=rows) < 0.03] = np.nan
    x[random.uniform(size=rows) < 0.02] = np.inf
    hole = random.uniform(size=rows) < 0.02
    return pa.table(
        {
            "key": [f"stream {k}" for k in key.tolist()],
            "t": np.cumsum(random.integers(1, 900, size=rows)),
            "x": pa.array(x),
            "z": pa.array(z, mask=hole),
            "y": y,
        }
    )


def shuffled(given: pa.Table, seed: int = 1) -> pa.Table:
    """The same rows in another order."""
    return given.take(pa.array(np.random.default_rng(seed).permutation(len(given))))


def of_key(given: pa.Table, key: Any) -> pa.Table:
    """The rows of one key, by time."""
    rows = np.array(given.column("key").to_pylist(), dtype=object) == key
    return given.filter(pa.array(rows)).sort_by("t")


def numbers(given: pa.Table, *names: str) -> np.ndarray:
    """Columns side by side, a null as NaN."""
    return np.column_stack([given.column(n).to_numpy(zero_copy_only=False) for n in names])


def alone(
    est: fg.RLS, phi: np.ndarray, y: np.ndarray, time: np.ndarray | None = None
) -> dict[str, np.ndarray]:
    """What one estimator tells of its samples, one by one; what it refuses, it leaves out."""
    told: dict[str, list[Any]] = {name: [] for name in ("error", "skipped", "theta", "variance")}
    last = None
    for k in range(len(y)):
        word, error = "refused", np.nan
        elapsed = 1.0 if time is None or last is None else float(time[k] - last)
        try:
            update = est.update(phi[k], y[k], missing="skip", elapsed=elapsed)
            word, error = update.skipped, update.error
        except (fg.InvalidInput, fg.NumericalRange):
            pass
        if time is not None and word not in ("missing", "refused"):
            last = time[k]
        for name, value in (("error", error), ("skipped", word), ("theta", est.theta)):
            told[name].append(value)
        told["variance"].append(np.diag(est.covariance))
    return {name: np.array(values) for name, values in told.items()}


def assert_told(told: pa.Table, key: Any, expected: dict[str, np.ndarray]) -> None:
    """That a fleet told of this key's rows, by time, what the estimator alone did."""
    rows = of_key(told, key)
    assert rows.column("skipped").to_pylist() == expected["skipped"].tolist()
    np.testing.assert_array_equal(numbers(rows, "error")[:, 0], expected["error"])
    for name in ("theta", "variance"):
        columns = [each for each in rows.column_names if each.startswith(f"{name}:")]
        if columns:
            np.testing.assert_array_equal(numbers(rows, *columns), expected[name])
