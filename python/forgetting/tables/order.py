"""The rows of a batch by stream and time."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Whole = NDArray[np.int64]


@dataclass(frozen=True)
class Groups:
    """Rows side by side that belong to one stream, in the order of time.

    Attributes
    ----------
    rows : (r,) ndarray of int64
        Rows of the batch, one stream after the other.
    streams : (g,) ndarray of int64
        The number of the stream of each group, increasing.
    starts, counts : (g,) ndarray of int64
        Where in `rows` a group begins, and how many rows it has.
    """

    rows: Whole
    streams: Whole
    starts: Whole
    counts: Whole

    def without(self, left_out: NDArray[np.bool_]) -> Groups:
        """The rows that are not left out, (r,); a group may become empty and is then gone."""
        if not left_out.any():
            return self
        streams = np.repeat(self.streams, self.counts)[~left_out]
        return _cut(self.rows[~left_out], streams)


def grouped(streams: Whole, rows: Whole, time: NDArray[Any] | None) -> Groups:
    """Bring rows into the order of stream, then time, then the order in which they are given.

    Parameters
    ----------
    streams : (r,) ndarray of int64
        The stream of each of the rows, from 0.
    rows : (r,) ndarray of int64
        Their numbers in the batch.
    time : (r,) ndarray, optional
        Their times; the given order if there are none.
    """
    if time is not None and len(time) and (time[1:] < time[:-1]).any():
        order = _argsort(time)
        order = order[_argsort(streams[order])]
    else:
        order = _argsort(streams)
    return _cut(rows[order], streams[order])


def _cut(rows: Whole, streams: Whole) -> Groups:
    """The groups of rows that stand side by side already."""
    first = np.ones(len(streams), dtype=bool)
    first[1:] = streams[1:] != streams[:-1]
    starts = np.flatnonzero(first)
    return Groups(rows, streams[starts], starts, np.diff(starts, append=len(rows)))


def _argsort(values: NDArray[Any]) -> Whole:
    """A stable order.

    A whole number and its row number side by side in 64 bits are sorted as numbers, which NumPy
    does with vectors: several times faster than a stable sort of either.
    """
    if values.dtype.kind == "f" or not len(values):
        return np.argsort(values, kind="stable").astype(np.int64, copy=False)
    bits = int(len(values) - 1).bit_length()
    least, largest = int(values.min()), int(values.max())
    if (largest - least).bit_length() + bits > 62:
        return np.argsort(values, kind="stable").astype(np.int64, copy=False)
    both = ((values - least) << bits) | np.arange(len(values))
    both.sort()
    both &= (1 << bits) - 1
    return both
