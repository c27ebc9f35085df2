"""MAT files of MATLAB, versions 5 and 7.3, by pymatreader."""

from __future__ import annotations

from collections import Counter
from typing import Any, BinaryIO

import numpy as np
import pandas as pd

from forgetting.extras import extra
from forgetting.record.formats.source import on_disk
from forgetting.record.formats.table import Table
from forgetting.words.errors import RecordError, first_line


def load(stream: BinaryIO, source: str, part: str | None) -> Table:
    """Take the variables that are as long as one another as the columns.

    The length is the one that the most variables have. A matrix gives a column for each of its
    columns, a structure for each of its fields; `part` names the structure to take.
    """
    content = variables(stream, source)
    if part is not None:
        if not isinstance(content.get(part), dict):
            raise RecordError(f"{source} has no structure {part!r}; it has {', '.join(content)}")
        content = content[part]
    found = dict(signals(content))
    if not found:
        raise RecordError(f"{source} has no vector of numbers; it has {', '.join(content)}")
    lengths = Counter(len(values) for values in found.values())
    length = max(lengths, key=lambda each: (lengths[each], each))
    taken = {name: values for name, values in found.items() if len(values) == length}
    left = [name for name in found if name not in taken]
    skipped = [f"of another length than {length}: {', '.join(left)}"] if left else []
    frame = pd.concat([columns(name, values) for name, values in taken.items()], axis=1)
    return Table(frame, "MAT", {}, {}, skipped)


def variables(stream: BinaryIO, source: str) -> dict[str, Any]:
    """All variables of a file."""
    reader = extra("pymatreader", "reading MAT files")
    try:
        with on_disk(stream, ".mat") as path:
            content: dict[str, Any] = reader.read_mat(path)
    except Exception as error:
        # The readers beneath raise whatever a broken byte makes of itself.
        raise RecordError(f"{source} is not a MAT file: {first_line(error)}") from None
    return {name: value for name, value in content.items() if not name.startswith(("__", "#"))}


def signals(content: dict[str, Any], prefix: str = "") -> Any:
    """Vectors and tall matrices of numbers, those in structures by ``structure.field``."""
    for name, value in content.items():
        if isinstance(value, dict):
            yield from signals(value, f"{prefix}{name}.")
            continue
        array = np.asarray(value) if not isinstance(value, str) else np.empty(0)
        if array.ndim == 2 and 1 in array.shape:
            array = array.reshape(-1)
        if array.dtype.kind in "fiubc" and array.ndim in (1, 2) and len(array) > 1:
            yield f"{prefix}{name}", array


def columns(name: str, values: Any) -> pd.DataFrame:
    """One column of a vector; name1, name2, ... of a matrix."""
    if values.ndim == 1:
        return pd.DataFrame({name: values})
    return pd.DataFrame(values, columns=[f"{name}{i}" for i in range(1, values.shape[1] + 1)])
