"""A table of any library as columns of Arrow, and columns of numbers as NumPy arrays."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from forgetting._core import InvalidInput
from forgetting.extras import extra
from forgetting.words.errors import first_line
from forgetting.words.suggestion import suggestion

PURPOSE = "a fleet fed by tables"


def arrow() -> Any:
    """The library of Arrow."""
    return extra("pyarrow", PURPOSE)


def table_of(batch: Any) -> Any:
    """The batch as an Arrow table, without a copy where the library's memory is Arrow's.

    Parameters
    ----------
    batch : object
        A table or record batch of pyarrow, or anything that exports Arrow by the PyCapsule
        protocol: a frame of Polars or pandas, a relation of DuckDB; or a dict of columns.

    Raises
    ------
    forgetting.InvalidInput
        When it is none of these, or the columns of a frame do not fit Arrow (mixed types).
    """
    pa = arrow()
    if isinstance(batch, pa.Table):
        return batch
    try:
        if isinstance(batch, pa.RecordBatchReader):
            return batch.read_all()
        return pa.table(batch)
    except (pa.ArrowException, TypeError, ValueError) as error:
        kind = type(batch).__name__
        raise InvalidInput(f"batch, a {kind}, is no Arrow table: {first_line(error)}") from None


def column(table: Any, name: str) -> Any:
    """One column of the table, in one piece."""
    pa, there = arrow(), table.column_names
    if there.count(name) != 1:
        if there.count(name) > 1:
            raise InvalidInput(f"the batch has {there.count(name)} columns named {name!r}")
        raise InvalidInput(f"the batch has no column {name!r}{suggestion(there, name, 'it has')}")
    found = table.column(name)
    chunks = [plain(chunk) for chunk in found.chunks] or [plain(pa.nulls(0, found.type))]
    return chunks[0] if len(chunks) == 1 else pa.concat_arrays(chunks)


def plain(array: Any) -> Any:
    """The values themselves, where the array has them in a dictionary or as views of texts."""
    pa = arrow()
    if pa.types.is_dictionary(array.type):
        return plain(array.dictionary).take(array.indices)
    is_view = getattr(pa.types, "is_string_view", lambda kind: False)
    return array.cast(pa.large_string()) if is_view(array.type) else array


def numbers(table: Any, name: str) -> NDArray[np.float64]:
    """A column as float64, (rows,); a missing value is NaN. No copy where it is that already."""
    pa, found = arrow(), column(table, name)
    kind, types = found.type, arrow().types
    allowed = (types.is_integer, types.is_floating, types.is_boolean, types.is_decimal)
    if not any(each(kind) for each in (*allowed, types.is_null)):
        raise InvalidInput(f"column {name!r} must hold numbers, but it holds {kind}")
    try:
        found = found.cast(pa.uint8()) if types.is_boolean(kind) else found
        found = found.cast(pa.float64(), safe=False)
    except pa.ArrowException as error:
        raise InvalidInput(f"column {name!r}: {first_line(error)}") from None
    return np.asarray(found.to_numpy(zero_copy_only=False), dtype=np.float64)
