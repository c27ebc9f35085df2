"""What an estimator is given, when it is a data frame: numbers, names and index."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from forgetting._core import InvalidInput
from forgetting.extras import extra

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Table:
    """The numbers of a data frame, series or labelled array, and the names of its rows and columns.

    Attributes
    ----------
    values : ndarray, shape (T, columns), or (T,) of a series
        Missing values are NaN.
    names : tuple of str
        The columns; of a series its name, "" where it has none.
    native : object
        What it was read from.
    index : pandas.Index or None
        What the rows are called, of pandas and xarray.
    dimensions : tuple of str
        Of xarray: what rows and columns are; else empty.
    """

    values: Array
    names: tuple[str, ...]
    native: Any
    index: Any = None
    dimensions: tuple[str, ...] = ()


def read(name: str, given: Any) -> Table | None:
    """Read an argument called `name`; None where it is no table of a known library.

    Raises
    ------
    InvalidInput
        For a column that does not hold numbers, or data of xarray that are no table.
    """
    if given is None or isinstance(given, np.ndarray | list | tuple | float | int):
        return None
    if type(given).__module__.startswith("xarray."):
        return _of_xarray(name, given)
    if not _may_be_a_frame(given):
        return None
    narwhals = extra("narwhals", "a data frame", "frames")
    try:
        frame = narwhals.from_native(given, eager_only=True, allow_series=True, pass_through=True)
    except ValueError:
        raise InvalidInput(f"{name} has two columns of the same name; each needs its own") from None
    if isinstance(frame, narwhals.Series):
        column = frame.name
        values = _numbers(name, frame)
        names: tuple[str, ...] = ("" if column is None else str(column),)
    elif isinstance(frame, narwhals.DataFrame):
        columns = [_numbers(name, column) for column in frame.iter_columns()]
        values, names = np.column_stack(columns), tuple(map(str, frame.columns))
    else:
        return None
    return Table(values, names, given, narwhals.maybe_get_index(frame))


def _may_be_a_frame(given: Any) -> bool:
    """Whether it is worth loading the library that knows."""
    return any(
        hasattr(type(given), name)
        for name in ("__arrow_c_stream__", "__dataframe__", "to_frame", "columns")
    )


def _numbers(name: str, column: Any) -> Array:
    """A column of narwhals as float64; missing values are NaN."""
    nw = extra("narwhals", "a data frame", "frames")
    dtype = column.dtype
    if not (dtype.is_numeric() or dtype == nw.Boolean):
        raise InvalidInput(f"{name}: column {column.name!r} holds {dtype}, allowed: numbers")
    return np.asarray(column.cast(nw.Float64).to_numpy(), dtype=np.float64)


def _of_xarray(name: str, data: Any) -> Table:
    """A labelled array of one or two dimensions, or a data set of one; rows are the first."""
    if hasattr(data, "data_vars"):
        if len(data.dims) != 1:
            raise InvalidInput(
                f"{name} has the dimensions {tuple(data.dims)}, expected one, the rows"
            )
        (rows,) = data.dims
        data = data.to_array("parameter").transpose(rows, "parameter")
    if data.ndim not in (1, 2) or data.dtype.kind not in "fiub":
        what = f"{data.ndim} dimensions of {data.dtype}"
        raise InvalidInput(f"{name} has {what}, expected one or two of numbers")
    dimensions = tuple(map(str, data.dims))
    names: tuple[str, ...] = ("" if data.name is None else str(data.name),)
    if data.ndim == 2:
        names = tuple(map(str, data[data.dims[1]].values))
    index = data.indexes.get(data.dims[0])
    return Table(data.values.astype(np.float64), names, data, index, dimensions)


def aligned(**tables: Table | None) -> None:
    """Refuse tables of which the rows are called differently.

    Tables without an index, and None, agree with any.

    Raises
    ------
    InvalidInput
        Names both and the first row that differs.

    Examples
    --------
    >>> import pandas as pd
    >>> phi, y = (read("", pd.Series([1.0, 2.0], index=index)) for index in ([0, 1], [0, 2]))
    >>> aligned(phi=phi, y=y)
    Traceback (most recent call last):
    ...
    forgetting.InvalidInput: phi and y have different indexes, in row 1 first: 1 and 2; ...
    """
    named = {name: table for name, table in tables.items() if table and table.index is not None}
    if not named:
        return
    (first, one), *others = named.items()
    for name, other in others:
        if not one.index.equals(other.index):
            where = _difference(one.index, other.index)
            raise InvalidInput(
                f"{first} and {name} have different indexes, {where}; both must have the same"
            )


def _difference(one: Any, other: Any) -> str:
    """Where two indexes differ first."""
    shared = min(len(one), len(other))
    different = np.flatnonzero(np.asarray(one[:shared] != other[:shared]))
    if len(different):
        row = int(different[0])
        return f"in row {row} first: {one[row]} and {other[row]}"
    return f"of {len(one)} and {len(other)} rows"


def shaped_like(table: Table | None, values: Array) -> Any:
    """Values of the shape of a table as what it was read from, with its names and index.

    Where there is no table, or no index to keep, the array itself.
    """
    if table is None or table.index is None:
        return values
    if table.dimensions:
        return table.native.copy(data=values)
    made: ArrayLike = values
    labels = {"name": table.native.name} if values.ndim == 1 else {"columns": table.native.columns}
    return type(table.native)(made, index=table.index, **labels)
