"""An array that new streams are added to at little cost."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import DTypeLike, NDArray


class Growing:
    """Something of each stream, side by side.

    Parameters
    ----------
    fill : float or int
        What a new stream has.
    dtype : NumPy type
    shape : tuple of int
        Of what one stream has.

    Examples
    --------
    >>> counts = Growing(0, np.int64)
    >>> counts.grow(3)
    >>> counts.values[1] += 5
    >>> counts.grow(4)
    >>> counts.values.tolist()
    [0, 5, 0, 0]
    """

    def __init__(self, fill: Any, dtype: DTypeLike, shape: tuple[int, ...] = ()) -> None:
        self._fill, self._count = fill, 0
        self._held: NDArray[Any] = np.full((0, *shape), fill, dtype=dtype)

    @property
    def values(self) -> NDArray[Any]:
        """(streams, *shape), to be read and written."""
        return self._held[: self._count]

    def grow(self, count: int) -> None:
        """Have room for `count` streams; the room doubles, so that each stream moves seldom."""
        if count > len(self._held):
            room = max(count, 2 * len(self._held))
            new = (room - self._count, *self._held.shape[1:])
            more = np.full(new, self._fill, dtype=self._held.dtype)
            self._held = np.concatenate([self.values, more])
        self._count = count

    def of(self, streams: NDArray[np.int64]) -> NDArray[Any]:
        """A copy of what these streams have, also of streams that are not there yet."""
        found = np.full((len(streams), *self._held.shape[1:]), self._fill, self._held.dtype)
        known = streams < self._count
        found[known] = self.values[streams[known]]
        return found
