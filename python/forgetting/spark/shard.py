"""Some of the streams: their states as bytes, and rows that wait until no earlier one can come."""

from __future__ import annotations

from typing import Any

import pyarrow as pa
import pyarrow.compute as pc

from forgetting._core import InvalidInput
from forgetting.spark.design import Design
from forgetting.spark.packing import read, written
from forgetting.tables import TableFleet

SHARDS = b"forgetting.spark.shards"
"""Where the bytes keep how many shards there are, among the metadata of their schema."""


class Layout:
    """How rows are shared out, and what is made of them: the same for all shards of a query.

    Parameters
    ----------
    design : Design
    shards : int
        How many there are.
    waits : bool
        Whether rows wait for a watermark.
    """

    def __init__(self, design: Design, shards: int, waits: bool) -> None:
        self.design, self.shards, self.waits = design, shards, waits

    def fleet(self, kept: bytes | None) -> TableFleet:
        """The streams of a shard; none yet where nothing is kept.

        Raises
        ------
        forgetting.InvalidInput
            When they were kept by a query of another model, other keys or other shards.
        """
        fleet = self.design.fleet()
        if kept is None:
            return fleet
        saved = read(kept)
        before = int((saved.schema.metadata or {}).get(SHARDS, b"0"))
        if before != self.shards:
            raise InvalidInput(f"the checkpoint has {before} shards, but shards = {self.shards}")
        kinds = saved.schema.field("key").type, self.design.rows.field(fleet.model.key).type
        if kinds[0] != kinds[1]:
            raise InvalidInput(f"the keys of the checkpoint are {kinds[0]}, but now {kinds[1]}")
        fleet.put(saved)
        return fleet

    def kept(self, fleet: TableFleet) -> bytes:
        """The streams as bytes."""
        saved = fleet.to_arrow()
        metadata = saved.schema.metadata | {SHARDS: str(self.shards).encode()}
        return written(saved.replace_schema_metadata(metadata))

    def in_order(self, rows: Any) -> Any:
        """Rows by time; those of one time in an order that is always the same."""
        model = self.design.model
        columns = [str(model.time), model.y, *model.phi]
        return rows.sort_by([(name, "ascending") for name in columns])

    def released(self, rows: Any, watermark: int | None) -> tuple[Any, Any]:
        """The rows whose turn it is, and those that wait.

        Parameters
        ----------
        rows : pyarrow.Table
        watermark : int or None
            Milliseconds; a row after it waits. Without a watermark none does.
        """
        if watermark is None:
            return rows, rows.slice(0, 0)
        at = pc.greater(self.ticks(rows), pa.scalar(1000 * watermark))
        waits = pc.fill_null(at, False)
        return rows.filter(pc.invert(waits)), rows.filter(waits)

    def earliest(self, rows: Any) -> int:
        """Milliseconds by which a watermark lets the first of some rows go."""
        return -(-int(pc.min(self.ticks(rows)).as_py()) // 1000)

    def ticks(self, rows: Any) -> Any:
        """Times in microseconds."""
        return rows.column(str(self.design.settings["time"])).cast(pa.int64())
