"""Lines that have become numbers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import pyarrow as pa
from numpy.typing import NDArray

from forgetting.stream.stamps import Stamps

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]


@dataclass(frozen=True)
class Rows:
    """Values of T lines.

    Attributes
    ----------
    values : ndarray, shape (T, c)
        The columns that the model uses, NaN for what is missing.
    ticks : ndarray, shape (T,)
        Time stamps as numbers; see `Stamps.ticks`.
    timed : ndarray of bool, shape (T,)
        Where there is a time.
    malformed : ndarray of bool, shape (T,)
        Lines that could not be read; their values are missing.
    texts : sequence of str or None
        Stamps as they were written, where they are date-times; else None.
    """

    values: Array
    ticks: NDArray[Any]
    timed: Flags
    malformed: Flags
    texts: Sequence[str | None] | None = None

    def __len__(self) -> int:
        return len(self.values)


def of_table(table: pa.Table, columns: Sequence[str], stamps: Stamps | None) -> Rows:
    """Rows of a table of Arrow; one with an infinite value is malformed.

    Raises
    ------
    pyarrow.ArrowInvalid
        When a time is no time.
    """
    parts = [table.column(name).combine_chunks() for name in columns]
    lists = [part.fill_null(np.nan).to_numpy(zero_copy_only=False) for part in parts]
    values = np.column_stack(lists) if lists else np.empty((table.num_rows, 0))
    malformed = np.asarray(np.isinf(values).any(axis=1))
    values[malformed] = np.nan
    if stamps is None:
        return Rows(values, np.zeros(len(values)), np.zeros(len(values), dtype=bool), malformed)
    column = table.column(stamps.name).combine_chunks()
    texts = column.to_pylist() if stamps.is_text else None
    return Rows(values, *stamps.ticks(column), malformed, texts)


def joined(pieces: Sequence[Rows]) -> Rows:
    """Rows behind one another."""
    if len(pieces) == 1:
        return pieces[0]
    texts = None
    if pieces[0].texts is not None:
        texts = [text for piece in pieces for text in piece.texts or ()]
    return Rows(
        np.concatenate([piece.values for piece in pieces]),
        np.concatenate([piece.ticks for piece in pieces]),
        np.concatenate([piece.timed for piece in pieces]),
        np.concatenate([piece.malformed for piece in pieces]),
        texts,
    )
