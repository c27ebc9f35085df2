"""Everything that a fleet keeps of its streams, by the number of the stream."""

from __future__ import annotations

from typing import Any

import numpy as np

from forgetting._core import Fleet
from forgetting.tables.growing import Growing
from forgetting.tables.keys import Found, Keys
from forgetting.tables.lags import Lags
from forgetting.tables.model import Model
from forgetting.tables.pages import Pages

NEVER = {"i": np.iinfo(np.int64).min, "f": -np.inf}
"""The time of the last row of a stream that has none, by the kind of its number type."""


class Streams:
    """Keys, estimators, counts, times and lags.

    Parameters
    ----------
    model : Model
    by_clock : bool
        Whether forgetting goes by the times of samples.
    fresh : bytes
        The state of a stream that has seen nothing, as `RLS.to_bytes` says it.
    threads : int, optional
        Cores for one update; see `Fleet`.

    Attributes
    ----------
    keys : Keys
    pages : Pages
    rows, missing, late : Growing
        Rows that came; those without a sample; those left out because a later row came before.
    time_type : pyarrow.DataType or None
        Of the times so far.
    seen : Growing or None
        Ticks of the last row; None before the first times.
    taken : Growing or None
        Ticks of the last sample that was taken, where forgetting goes by the clock.
    lags : Lags or None
    refused : dict
        By key, why its saved state was refused.
    refused_rows : dict
        By key, the row of the saved table, to be handed on as it was.
    """

    def __init__(
        self, model: Model, by_clock: bool, fresh: bytes, threads: int | None = None
    ) -> None:
        self.model, self.by_clock, self.fresh = model, by_clock, fresh
        new = Fleet._of_states(fresh, [fresh])
        new.threads = threads
        self.keys, self.pages = Keys(), Pages(new)
        self.rows, self.missing, self.late = (Growing(0, np.int64) for _ in range(3))
        self.lags = None if model.arx is None else Lags(model.arx, len(model.phi))
        self.time_type: Any = None
        self.seen: Growing | None = None
        self.taken: Growing | None = None
        self.refused: dict[Any, str] = {}
        self.refused_rows: dict[Any, Any] = {}

    @property
    def counts(self) -> dict[str, Growing]:
        """What is counted, by name."""
        return {"rows": self.rows, "missing": self.missing, "late": self.late}

    def keep_times(self, kind: Any, dtype: Any) -> None:
        """Keep times from now on, of this type of Arrow and of NumPy."""
        if self.seen is None:
            never = NEVER[np.dtype(dtype).kind]
            self.time_type = kind
            self.seen = Growing(never, dtype)
            self.taken = Growing(never, dtype) if self.by_clock else None
            self._grow()

    def start(self, found: Found) -> None:
        """Start the streams of new keys."""
        self.keys.add(found.added, found.type)
        self._grow()

    def _grow(self) -> None:
        count = len(self.keys)
        self.pages.grow(count)
        kept = [*self.counts.values(), self.seen, self.taken]
        for each in (*kept, None if self.lags is None else self.lags.kept):
            if each is not None:
                each.grow(count)
