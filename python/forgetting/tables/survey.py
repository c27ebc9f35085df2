"""What is worth a look among many streams: windup, outliers, late and missing rows."""

from __future__ import annotations

from dataclasses import dataclass
from statistics import NormalDist
from typing import Any

import numpy as np
from numpy.typing import NDArray

from forgetting.tables.fleet import TableFleet

SAMPLES_A_PARAMETER = 5
"""Samples that a stream has of each parameter before its estimate is compared with others'."""
LEAST_Z = 3.5
"""The limit of Iglewicz and Hoaglin (1993), How to Detect and Handle Outliers, section 3.3."""


@dataclass(frozen=True)
class Outlier:
    """A stream that has a parameter far from those of the others.

    Attributes
    ----------
    key : object
    regressor : str
        Of the parameter.
    value, median : float
        The stream's estimate, and that of half of the streams.
    z : float
        Their difference over the spread of the streams.
    """

    key: Any
    regressor: str
    value: float
    median: float
    z: float


@dataclass(frozen=True)
class Survey:
    """A fleet at a glance. Lists have the most striking first.

    Attributes
    ----------
    totals : dict
        Streams; rows, samples, missing and late of all of them; streams by status.
    windup : list of (key, status)
        Streams of which the covariance grows without information, or is at its limit.
    limit : float
        From which absolute z on an estimate is an outlier: one that chance would bring about
        once in a fleet as large.
    outliers : list of Outlier
        The parameter of each such stream that is farthest off.
    late, missing : list of (key, rows, of)
        Streams with such rows, and how many rows they had.
    refused : dict
        Keys of which the saved state was refused, and why.
    """

    totals: dict[str, Any]
    windup: list[tuple[Any, str]]
    limit: float
    outliers: list[Outlier]
    late: list[tuple[Any, int, int]]
    missing: list[tuple[Any, int, int]]
    refused: dict[Any, str]


def survey(fleet: TableFleet) -> Survey:
    """Look over a fleet.

    Examples
    --------
    >>> import numpy as np
    >>> k = np.arange(2000)
    >>> slope = np.where(k % 20 == 7, 9.0, 2.0 + 0.01 * (k % 20))
    >>> x = np.sin(k)
    >>> fleet = TableFleet("meter", "y", "x")
    >>> told = fleet.update({"meter": k % 20, "x": x, "y": slope * x})
    >>> [(each.key, round(each.value, 2)) for each in survey(fleet).outliers]
    [(7, 9.0)]
    """
    table = fleet.estimates()
    column = {
        name: table.column(name).to_numpy() for name in ("rows", "samples", "missing", "late")
    }
    status = np.array(table.column("status").to_pylist(), dtype=object)
    keys = table.column(fleet.model.key)
    totals: dict[str, Any] = {"streams": len(table)}
    totals |= {name: int(values.sum()) for name, values in column.items()}
    totals["status"] = {word: int((status == word).sum()) for word in ("ok", "windup", "saturated")}
    names = [f"theta:{name}" for name in fleet.model.regressors]
    theta = np.column_stack([table.column(name).to_numpy() for name in names])
    told = column["samples"] >= SAMPLES_A_PARAMETER * theta.shape[1]
    limit, outliers = _outliers(theta, told)
    return Survey(
        totals,
        [(keys[i].as_py(), status[i]) for i in np.flatnonzero(status != "ok").tolist()],
        limit,
        [
            Outlier(keys[i].as_py(), fleet.model.regressors[j], float(theta[i, j]), median, z)
            for i, j, median, z in outliers
        ],
        _most(keys, column["late"], column["rows"]),
        _most(keys, column["missing"], column["rows"]),
        fleet.refused,
    )


def _most(
    keys: Any, counts: NDArray[np.int64], of: NDArray[np.int64]
) -> list[tuple[Any, int, int]]:
    """The streams that have any, those with most first."""
    some = np.flatnonzero(counts)
    ordered = some[np.argsort(-counts[some], kind="stable")]
    return [(keys[i].as_py(), int(counts[i]), int(of[i])) for i in ordered.tolist()]


def _outliers(
    theta: NDArray[Any], told: NDArray[np.bool_]
) -> tuple[float, list[tuple[int, int, float, float]]]:
    """The limit, and stream, parameter, median and z of each outlier, the farthest first."""
    count = max(1, int(told.sum()) * theta.shape[1])
    limit = max(LEAST_Z, -NormalDist().inv_cdf(min(0.5, 0.5 / count)))
    z = np.zeros(theta.shape)
    middle = np.zeros(theta.shape[1])
    if told.any():
        middle = np.median(theta[told], axis=0)
        z[told] = (theta[told] - middle) / spread(theta[told] - middle)
    farthest = np.abs(z).argmax(axis=1)
    size = np.abs(z).max(axis=1)
    some = np.flatnonzero(size > limit)
    ordered = some[np.argsort(-size[some], kind="stable")].tolist()
    found = [(i, int(farthest[i])) for i in ordered]
    return limit, [(i, j, float(middle[j]), float(z[i, j])) for i, j in found]


def spread(differences: NDArray[Any]) -> NDArray[np.float64]:
    """The standard deviation of normal numbers with these differences from the median, (n,).

    From the median of their sizes, which half of the streams may spoil; from the mean where that
    is 0 because more than half are alike; infinite where all are.
    """
    sizes = np.abs(differences).astype(np.float64)
    median, mean = np.median(sizes, axis=0), sizes.mean(axis=0)
    found = np.where(median > 0, median / NormalDist().inv_cdf(0.75), mean * np.sqrt(np.pi / 2))
    return np.where(found > 0, found, np.inf)
