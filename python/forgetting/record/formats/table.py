"""A table as a library read it, and what was noticed on the way."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import pandas as pd

from forgetting.words.errors import RecordError
from forgetting.words.suggestion import suggestion


@dataclass(frozen=True)
class Table:
    """Columns of a file.

    Attributes
    ----------
    frame : pandas.DataFrame
        The columns; their names may still occur twice.
    format : str
        Such as "delimited text" or "Parquet".
    details : mapping of str to str
        What was recognised: "separator", "encoding", "decimal", ...
    units : mapping of int to str
        Unit of a column, by its position, where the file has one.
    skipped : sequence of str
        What of the file is not in the table, in words.
    """

    frame: pd.DataFrame
    format: str
    details: Mapping[str, str] = field(default_factory=dict)
    units: Mapping[int, str] = field(default_factory=dict)
    skipped: Sequence[str] = ()


def choose(parts: Sequence[str], part: str | None, source: str, kind: str) -> str:
    """The part of a file that was asked for, or its only one.

    Parameters
    ----------
    parts : sequence of str
        Names of the tables in the file.
    part : str or None
        The name asked for.
    source, kind : str
        The file and what its parts are called ("sheet"), for the message.

    Raises
    ------
    RecordError
        When there is no such part, or several and none was asked for.
    """
    if part is not None:
        if part in parts:
            return part
        near = suggestion(list(parts), part, f"its {kind}s are")
        raise RecordError(f"{source} has no {kind} {part!r}{near}")
    if not parts:
        raise RecordError(f"{source} has no {kind} with a table in it")
    if len(parts) > 1:
        shown = ", ".join(map(repr, parts[:12])) + (" and more" if len(parts) > 12 else "")
        raise RecordError(f"{source} has {len(parts)} {kind}s; name one by --part: {shown}")
    return parts[0]
