"""What an estimator found, as a data frame of the library that the record came in."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from importlib import import_module
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from forgetting._core import GATE, RLS, SKIPPED, Bank, InvalidInput, Run
from forgetting.extras import extra
from forgetting.frames.table import Table, aligned, read

WORDS: dict[str, Mapping[int, str | None]] = {"skipped": SKIPPED, "gate": GATE}
"""Outputs that are codes, and what they mean."""

ERRORS = ("error", "whitened_innovation")
"""Outputs with one entry a target."""

SQUARE = ("covariance", "prior_covariance")
"""Outputs that are a matrix a sample, for which a table has no place."""

OUTPUTS = sorted(Run._outputs, key=lambda name: name in SQUARE)
"""Attributes of a run that are one entry a sample, in the order of the columns."""


def run(
    estimator: RLS | Bank,
    phi: Any,
    y: Any,
    gamma: Any = None,
    outputs: Sequence[str] | None = None,
    missing: Literal["error", "skip"] = "error",
    *,
    time: Any = None,
) -> Any:
    """Take a whole record from data frames, and return one.

    Parameters
    ----------
    estimator : RLS or Bank
        It learns, as with its own `run`.
    phi : data frame, (T, n); or labelled array of xarray with two dimensions
        Regressors; the names of its columns are those of the parameters.
    y : series (T,) or data frame (T, targets); or labelled array; or array
        Measurements, in the same order. A missing value is NaN.
    gamma : series (T,), array or float, optional
        Noise covariances.
    outputs, missing :
        As those of `RLS.run`.
    time : array of times, or "index"
        As that of `RLS.run`; "index" for the index of `phi`.

    Returns
    -------
    data frame
        Of the library of `phi`, with its index; see `to_frame`.

    Raises
    ------
    InvalidInput
        When indexes differ, a column does not hold numbers, or as `RLS.run`; the estimator is then
        as it was.
    """
    tables = {"phi": read("phi", phi), "y": read("y", y), "gamma": read("gamma", gamma)}
    if tables["phi"] is None:
        raise InvalidInput(f"phi is of type {type(phi).__name__}, expected a data frame")
    aligned(**tables)
    _check_names(tables["phi"].names)
    phi, y, gamma = (
        given if table is None else table.values
        for table, given in zip(tables.values(), (phi, y, gamma), strict=True)
    )
    if isinstance(time, str) and time == "index":
        time = _times(tables["phi"])
    found = estimator.run(phi, y, gamma, outputs, missing, time=time)
    return to_frame(found, tables["phi"], tables["y"])


def _times(phi: Table) -> NDArray[Any]:
    """The index as times."""
    if phi.index is None:
        raise InvalidInput('time = "index", but phi has none')
    return np.asarray(phi.index)


def to_frame(found: Run, phi: Table, y: Table | None = None) -> Any:
    """The outputs of a run as a data frame of the library of `phi`.

    Parameters
    ----------
    found : Run
        Of a record of one row a sample.
    phi : Table
        Where parameters have their names and samples their index from.
    y : Table, optional
        Where targets have their names from; numbers if not given.

    Returns
    -------
    data frame
        Of pandas, Polars or PyArrow: the estimates under the names of the parameters, then the
        other outputs under their names; of the covariances nothing, as they are no columns. Where
        there are several columns of a kind they are called ``sun[power]``, ``error[power]``,
        ``variance[sun]`` and ``weights[0]``. What is a code in the run is a word here,
        "" for a sample that was not skipped.
        Of xarray: a data set with the dimensions of `phi`, covariances included.

    Raises
    ------
    InvalidInput
        When two columns would have one name.
    """
    kept = _kept(found, len(phi.names))
    targets = y.names if y is not None and y.values.ndim == 2 else ()
    if phi.dimensions:
        return _data_set(kept, phi, targets)
    columns = [
        labelled
        for name, values in kept.items()
        for labelled in _columns(name, values, phi.names, targets)
    ]
    nw = extra("narwhals", "a data frame", "frames")
    backend = nw.get_native_namespace(nw.from_native(phi.native, allow_series=True))
    made = nw.from_dict(_distinct(columns), backend=backend).to_native()
    if phi.index is not None:
        made.index = phi.index
    return made


def _check_names(names: Sequence[str]) -> None:
    """Refuse names of parameters that would be those of other columns of the results."""
    for name in names:
        output = name.partition("[")[0]
        if output in OUTPUTS:
            raise InvalidInput(f"phi: column {name!r} would be one with the output {output!r}")


def _kept(found: Run, parameters: int) -> dict[str, NDArray[Any]]:
    """What the run kept: theta (T, n, targets), errors (T, targets), codes as words."""
    kept = {}
    for name in OUTPUTS:
        values = getattr(found, name)
        if values is None:
            continue
        if name == "theta":
            values = values.reshape(len(values), parameters, -1)
        elif name in ERRORS:
            values = values.reshape(len(values), -1)
        elif name in WORDS:
            words = [WORDS[name].get(code) or "" for code in range(256)]
            values = np.array(words)[values]
        kept[name] = values
    return kept


def _columns(
    output: str, values: NDArray[Any], names: Sequence[str], targets: Sequence[str]
) -> list[tuple[str, NDArray[Any]]]:
    """The columns of one output, each with its label."""
    if output in SQUARE:
        return []
    if output == "theta":
        of = _of_targets(targets, values.shape[2])
        return [
            (f"{name}{target}", values[:, i, k])
            for i, name in enumerate(names)
            for k, target in enumerate(of)
        ]
    if output in ERRORS:
        of = _of_targets(targets, values.shape[1])
        return [(f"{output}{target}", values[:, k]) for k, target in enumerate(of)]
    if values.ndim == 1:
        return [(output, values)]
    labels = names if output == "variance" else range(values.shape[1])
    return [(f"{output}[{label}]", values[:, k]) for k, label in enumerate(labels)]


def _of_targets(names: Sequence[str], count: int) -> list[str]:
    """What each target adds to a label: nothing where there is one."""
    return [""] if count == 1 else [f"[{name}]" for name in names or range(count)]


def _distinct(columns: Sequence[tuple[str, NDArray[Any]]]) -> dict[str, NDArray[Any]]:
    """The columns by their labels, if no two have the same."""
    labels = [label for label, _ in columns]
    for label in labels:
        if labels.count(label) > 1:
            raise InvalidInput(f"two columns would be called {label!r}; rename that of phi")
    return dict(columns)


def _data_set(kept: dict[str, NDArray[Any]], phi: Table, targets: Sequence[str]) -> Any:
    """The outputs as a data set of xarray."""
    xarray = import_module("xarray")
    rows, parameter = (*phi.dimensions, "parameter")[:2]
    dimensions = {
        "theta": (parameter, "target"),
        **dict.fromkeys(ERRORS, ("target",)),
        "variance": (parameter,),
        "weights": ("member",),
        **dict.fromkeys(SQUARE, (parameter, f"{parameter}_")),
    }
    variables = {}
    for name, values in kept.items():
        of = (rows, *dimensions.get(name, ()))
        if of[-1] == "target" and values.shape[-1] == 1:
            of, values = of[:-1], values[..., 0]
        variables[name] = (of, values)
    coordinates: dict[str, Any] = {parameter: list(phi.names)}
    if phi.index is not None:
        coordinates[rows] = phi.native.coords[rows]
    if targets:
        coordinates["target"] = list(targets)
    return xarray.Dataset(variables, coords=coordinates)
