"""The regression problem a model makes of a record."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from forgetting.models.layout import Layout
from forgetting.models.signal_origin import SignalOrigin
from forgetting.record.clock import Clock
from forgetting.record.found import Found
from forgetting.words.errors import RecordError

Array = NDArray[np.float64]

PIECE = 65_536
"""Rows taken at a time where all of them at once would be a copy of a long record."""

SMALLEST, LARGEST = 1e-75, 1e75
"""Sizes of signals of which squares and products of squares are numbers still."""


@dataclass(frozen=True)
class Samples:
    """Regressors and outputs, row by row, with their names.

    Attributes
    ----------
    phi : ndarray, shape (T, n)
        Regressors, NaN where a value is missing or a lag crosses a gap.
    y : ndarray, shape (T, m)
        Outputs, NaN where missing. They share phi.
    regressors, outputs : tuple of str
        Column names; a parameter carries the name of its regressor.
    model : str
        The model as the user wrote it: formula, or orders and columns.
    clock : Clock or None
        Time of each row.
    source : str
        Name of the record.
    cut : int
        Rows in which a lag was there, but on the other side of a gap of the clock.
    found : Found
        How the record was read.
    measured : ndarray, shape (T, m), or None
        The outputs as they were measured, where y is what was made of them: less what is known, or
        linear in the parameters of a model with coloured noise.
    layout : Layout or None
        Where the parameters of such a model stand.
    origin : SignalOrigin or None
        What such a model with a constant measures its signals from.
    """

    phi: Array
    y: Array
    regressors: tuple[str, ...]
    outputs: tuple[str, ...]
    model: str
    clock: Clock | None
    source: str
    cut: int = 0
    found: Found = field(default_factory=Found)
    measured: Array | None = None
    layout: Layout | None = None
    origin: SignalOrigin | None = None

    @property
    def is_pseudolinear(self) -> bool:
        """Whether regressors follow from the estimates, as they do where noise is coloured."""
        return self.layout is not None

    @property
    def as_measured(self) -> Array:
        """The outputs as they were measured, (T, m)."""
        return self.y if self.measured is None else self.measured

    @cached_property
    def complete(self) -> NDArray[np.bool_]:
        """Rows without any missing value, (T,)."""
        missing = np.isnan(self.phi).any(axis=1) | np.isnan(self.y).any(axis=1)
        return np.asarray(~missing, dtype=np.bool_)

    def known_pieces(self) -> Iterator[tuple[Array, Array]]:
        """Regressors and outputs of the complete rows, a piece of the record after the other."""
        for part in pieces(len(self.y)):
            complete = self.complete[part]
            whole = slice(None) if complete.all() else complete
            yield self.phi[part][whole], self.y[part][whole]

    @property
    def usual_step(self) -> float | None:
        """Seconds from row to row, typically; None without a clock that goes on."""
        step = np.inf if self.clock is None else self.clock.usual_step
        return step if np.isfinite(step) else None

    def check(self) -> Samples:
        """Refuse infinite regressors, sizes that cannot be judged, and no sample at all."""
        infinite = np.argwhere(np.isinf(self.phi))
        if len(infinite):
            row, column = infinite[0]
            raise RecordError(
                f"regressor {self.regressors[column]!r} is infinite "
                f"in row {row + 1} of {self.source}"
            )
        for name, column in zip(self.regressors, self.phi.T, strict=True):
            check_size(f"regressor {name!r} of {self.source}", column, 1)
        for name, column in zip(self.outputs, self.y.T, strict=True):
            # a single wild value is left to the estimator, which names its row
            check_size(f"output {name!r} of {self.source}", column, len(column) // 2 + 1)
        if not self.complete.any():
            cut = f"; {self.clock_in_words()}; --time none ignores it" if self.cut else ""
            raise RecordError(
                f"{self.source} has no complete sample: in each of its {len(self.y)} rows "
                f"a value is missing or a lag reaches before the record or across a gap{cut}"
            )
        return self

    def clock_as_data(self) -> dict[str, Any] | None:
        """Which column is the clock, how it was read, its gaps, and the rows whose lags it cut."""
        if self.clock is None:
            return None
        return {
            "column": self.clock.name,
            "kind": self.clock.kind,
            "gaps": int(self.clock.is_gap.sum()),
            "lags_cut": self.cut,
        }

    def facts(self) -> list[tuple[str, str]]:
        """How the record was read, as pairs of a word and what it is."""
        pairs = [("rows", str(len(self.y))), ("read as", self.found.words())]
        pairs.append(("clock", self.clock_in_words()))
        if self.found.units:
            pairs.append(("units", self.found.names_with_units()))
        if self.found.skipped:
            pairs.append(("left out", "; ".join(self.found.skipped)))
        return pairs

    def clock_in_words(self) -> str:
        """Which column is the clock, and what it did to the lags."""
        if self.clock is None:
            return "no clock; lags count rows"
        rows = f"{self.cut} row{'s' * (self.cut != 1)}"
        return f"clock {self.clock}; it cut the lags of {rows}"


def check_size(what: str, values: Array, many: int) -> None:
    """Refuse values that are too small, or of which so many are too large, for products."""
    largest = max(np.fmax.reduce(values, initial=0.0), -np.fmin.reduce(values, initial=0.0))
    if 0.0 < largest < SMALLEST or (
        largest > LARGEST and np.count_nonzero(np.abs(values) > LARGEST) >= many
    ):
        raise RecordError(
            f"{what} reaches {largest:.3g} in size, allowed: 0, or {SMALLEST:g} to {LARGEST:g}; "
            f"state it in another unit"
        )


def pieces(total: int, length: int = PIECE) -> Iterator[slice]:
    """Cut `total` rows into slices of at most `length`.

    Examples
    --------
    >>> [(part.start, part.stop) for part in pieces(5, 2)]
    [(0, 2), (2, 4), (4, 5)]
    """
    for start in range(0, total, length):
        yield slice(start, min(start + length, total))
