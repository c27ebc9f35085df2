"""The streams of a fleet in pages, so that the rows of a page are taken while it is in the cache.

A page is a `Fleet` of up to 4096 streams. The k-th rows of all its streams go in one
`Fleet.update`; what a few streams have more than the others goes as one record each, through
`RLS.run`. Up to ten parameters both give the same bits.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from forgetting._core import RLS, Bank, Fleet
from forgetting.tables.order import Groups
from forgetting.tables.single import take_record

Array = NDArray[Any]

PAGE = 4096
ROUNDS_AT_ONCE = 1 << 19
"""Numbers of phi that are laid out for a page at a time: 4 MB, which stay in the cache."""
ALONE = 20_000.0
"""What it costs to take a stream out of a page and to put it back, in nanoseconds."""

WIDTH_ONE = ("error", "leverage", "skipped")
"""What a sample has one of; theta and variance have one for each parameter."""


@dataclass(frozen=True)
class Samples:
    """Samples of some streams.

    Attributes
    ----------
    groups : Groups
        Whose they are.
    phi : (r, n) ndarray
    y : (r,) ndarray
    time : (r,) ndarray or None
        When they were taken, where forgetting goes by the clock.
    last : (g,) ndarray or None
        When the last sample before them was taken; NaN before the first.
    """

    groups: Groups
    phi: Array
    y: Array
    time: Array | None = None
    last: Array | None = None


class Pages:
    """The estimators of all streams.

    Parameters
    ----------
    new : Fleet
        A fleet of one stream that has seen nothing: what every new stream is a copy of.
    """

    def __init__(self, new: Fleet) -> None:
        self.new, self.fleets = new, list[Fleet]()

    def __len__(self) -> int:
        return sum(map(len, self.fleets))

    def grow(self, count: int) -> None:
        """Have `count` streams."""
        missing = count - len(self)
        while missing > 0:
            if not self.fleets or len(self.fleets[-1]) == PAGE:
                self.fleets.append(self.new.__copy__())
                missing -= 1
            more = min(missing, PAGE - len(self.fleets[-1]))
            if more:
                self.fleets[-1].append(more)
            missing -= more

    def __getitem__(self, stream: int) -> RLS | Bank:
        """A copy of the stream of this number."""
        return self.fleets[stream // PAGE][stream % PAGE]

    def replace(self, stream: int, fleets: list[Fleet]) -> None:
        """Have these pages from that of this stream, its first, on; all are full but the last."""
        self.fleets[stream // PAGE :] = fleets
        for fleet in fleets:
            fleet.threads = self.new.threads

    def put(self, streams: NDArray[np.int64], states: Sequence[bytes]) -> None:
        """Put saved states in the place of streams that are there."""
        kind = type(self.new[0])
        for stream, state in zip(streams.tolist(), states, strict=True):
            self.fleets[stream // PAGE][stream % PAGE] = kind.from_bytes(state)

    def gather(self, field: Callable[[Fleet], Array]) -> Array:
        """What a function says of each page, for all streams."""
        parts = [np.asarray(field(fleet)) for fleet in self.fleets]
        return np.concatenate(parts or [np.asarray(field(self.new))[:0]])

    def take(self, samples: Samples, outputs: tuple[str, ...]) -> dict[str, Array]:
        """Take the samples; each output has one row a sample, in their order."""
        told = self._empty(len(samples.y), outputs)
        groups = samples.groups
        edges = np.arange(0, len(self.fleets) + 1) * PAGE
        bounds = np.searchsorted(groups.streams, edges)
        for page in np.flatnonzero(np.diff(bounds)).tolist():
            part = _Part(self.fleets[page], page * PAGE, samples, bounds[page], bounds[page + 1])
            part.take({name: values[part.rows] for name, values in told.items()})
        return told

    def _empty(self, rows: int, outputs: tuple[str, ...]) -> dict[str, Array]:
        n, dtype = self.new.parameters, np.dtype(self.new.dtype)
        told: dict[str, Array] = {}
        for name in outputs:
            shape = (rows,) if name in WIDTH_ONE else (rows, n)
            told[name] = np.empty(shape, dtype=np.uint8 if name == "skipped" else dtype)
        return told


class _Part:
    """The samples of one page."""

    def __init__(self, fleet: Fleet, first: int, samples: Samples, begin: int, end: int) -> None:
        groups = samples.groups
        self.fleet = fleet
        self.streams = groups.streams[begin:end] - first
        self.counts = groups.counts[begin:end]
        start = int(groups.starts[begin])
        self.starts = groups.starts[begin:end] - start
        self.rows = slice(start, start + int(self.counts.sum()))
        self.phi, self.y = samples.phi[self.rows], samples.y[self.rows]
        self.time = None if samples.time is None else samples.time[self.rows]
        self.last = None if samples.last is None else samples.last[begin:end]

    def take(self, told: dict[str, Array]) -> None:
        """Take them, and write what they brought."""
        rounds = 0 if self.time is not None else self._rounds()
        if rounds:
            self._side_by_side(rounds, told)
        for group in np.flatnonzero(self.counts > rounds).tolist():
            self._alone(group, rounds, told)

    def _rounds(self) -> int:
        """How many rounds cost least: after them, each stream with rows left goes alone."""
        n, size = self.phi.shape[1], len(self.fleet)
        having = np.bincount(self.counts)[::-1].cumsum()[::-1]  # at least k rows
        left = np.append(having[1:], 0)  # more than k rows
        cost = np.arange(len(left)) * (size * n * (n + 3) / 2.0 + 10_000.0) + left * ALONE
        return int(cost.argmin())

    def _side_by_side(self, rounds: int, told: dict[str, Array]) -> None:
        """The first rows of all streams: the k-th of each in the k-th round."""
        size, n = len(self.fleet), self.phi.shape[1]
        nth = np.arange(len(self.y)) - np.repeat(self.starts, self.counts)
        place = nth * size + np.repeat(self.streams, self.counts)
        step = min(rounds, max(1, ROUNDS_AT_ONCE // (size * n)))
        for first in range(0, rounds, step):
            some = min(step, rounds - first)
            rows: Any = slice(None)  # all of them, most often
            if some < self.counts.max():
                rows = np.flatnonzero((nth >= first) & (nth < first + some))
            at = place[rows] - first * size
            phi = np.zeros((some * size, n), dtype=self.phi.dtype)
            y = np.full(some * size, np.nan, dtype=self.y.dtype)
            phi[at], y[at] = self.phi[rows], self.y[rows]
            for name, values in self._updates(phi, y, some, tuple(told)):
                told[name][rows] = values[at]

    def _updates(
        self, phi: Array, y: Array, rounds: int, outputs: tuple[str, ...]
    ) -> Iterator[tuple[str, Array]]:
        """One update a round; each output of all rounds, one below the other."""
        size = len(self.fleet)
        asked = [name for name in outputs if name in WIDTH_ONE]
        found: dict[str, list[Array]] = {name: [] for name in outputs}
        for k in range(rounds):
            these = slice(k * size, (k + 1) * size)
            update = self.fleet.update(phi[these], y[these], outputs=asked)
            for name in outputs:
                source = update if name in WIDTH_ONE else self.fleet
                found[name].append(getattr(source, name))
        for name, values in found.items():
            yield name, np.concatenate(values)

    def _alone(self, group: int, skip: int, told: dict[str, Array]) -> None:
        """The rows of one stream after the first `skip`, as a record."""
        begin = int(self.starts[group]) + skip
        rows = slice(begin, int(self.starts[group] + self.counts[group]))
        stream = int(self.streams[group])
        est = self.fleet[stream]
        time = None if self.time is None else self.time[rows]
        last = np.nan if self.last is None else float(self.last[group])
        take_record(
            est,
            (self.phi[rows], self.y[rows]),
            (time, last),
            {name: values[rows] for name, values in told.items()},
        )
        self.fleet[stream] = est
