"""What Spark calls with the rows of a shard, in each micro-batch and when a watermark passes."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pandas as pd
import pyarrow as pa
from pyspark.sql.streaming import StatefulProcessor

from forgetting.spark.packing import packs, read, unpacked, written
from forgetting.spark.shard import Layout

STREAMS, WAITING = "streams", "waiting"
"""The values that are kept of a shard."""
BYTES = "kept binary"
"""Their type."""


class Processor(StatefulProcessor):
    """Keeps two values of a shard, its streams and its waiting rows.

    Spark saves both with the micro-batch or not at all.

    Parameters
    ----------
    layout : Layout
    """

    def __init__(self, layout: Layout) -> None:
        self._layout = layout

    def init(self, handle: Any) -> None:
        """Say what is kept."""
        self._handle = handle
        self._streams = handle.getValueState(STREAMS, BYTES)
        if self._layout.waits:
            self._waiting = handle.getValueState(WAITING, BYTES)

    def handleInputRows(self, key: Any, rows: Any, timerValues: Any) -> Iterator[Any]:
        """Take the rows that a micro-batch brings."""
        packed = [each for frame in rows for each in frame["rows"]]
        new = unpacked(packed, self._layout.design.rows)
        return self._take(pa.concat_tables([self._held(), new]), timerValues)

    def handleExpiredTimer(
        self, key: Any, timerValues: Any, expiredTimerInfo: Any
    ) -> Iterator[Any]:
        """Take the rows that the watermark has passed."""
        return self._take(self._held(), timerValues)

    def handleInitialState(self, key: Any, initialState: Any, timerValues: Any) -> None:
        """Start from the streams of another query."""
        self._streams.update((bytes(initialState["streams"].iloc[0]),))

    def _take(self, rows: Any, timers: Any) -> Iterator[Any]:
        """Take the rows whose turn it is; the others go on waiting."""
        waits = self._layout.waits
        watermark = timers.getCurrentWatermarkInMs() if waits else None
        due, waiting = self._layout.released(rows, watermark)
        if waits:
            self._wait(waiting)
        if len(due):
            kept = self._streams.get()
            fleet = self._layout.fleet(None if kept is None else bytes(kept[0]))
            told = self._layout.design.tell(fleet, self._layout.in_order(due))
            self._streams.update((self._layout.kept(fleet),))
            for each in packs(told):
                yield pd.DataFrame({"told": [each]})

    def _held(self) -> Any:
        """The rows that wait."""
        kept = self._waiting.get() if self._layout.waits else None
        if kept is None:
            return self._layout.design.rows.empty_table()
        return read(bytes(kept[0])).cast(self._layout.design.rows)

    def _wait(self, rows: Any) -> None:
        """Keep rows, and be called when the first of them is due."""
        if not len(rows):
            self._waiting.clear()
            return
        self._waiting.update((written(rows),))
        self._handle.registerTimer(self._layout.earliest(rows))
