"""One partition of a table: streams one after the other, the rows of each in the order of time."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any

import pyarrow as pa
import pyarrow.compute as pc

from forgetting.spark.design import Design
from forgetting.spark.standing import put, standing

ROWS = 1 << 17
"""Rows that are taken in one go."""


@dataclass(frozen=True)
class Partition:
    """Takes the batches of a partition; see `forgetting.spark.identify`.

    They have three columns: `key`, by which they are sorted; `row`, the other columns that are
    read; `state`, what is known of the stream. One of the last two is null, and the state of a
    stream comes before its rows. What it yields has two columns, `told` of a row and `state` of
    a stream, one of them null. It keeps no more than the streams of ROWS rows: a stream is done
    when the next key comes.
    """

    design: Design

    def __call__(self, batches: Iterable[Any]) -> Iterator[Any]:
        """What is told of all rows, and the states of all streams."""
        unfinished = self.design.standing.empty_table()
        for piece in pieces(batches, ROWS):
            found, streams = self._take(piece, unfinished)
            yield from self._batches("told", found)
            last = pc.equal(streams.column(self._key), piece.column("key")[-1])
            unfinished = streams.filter(last)
            yield from self._batches("state", streams.filter(pc.invert(last)))
        yield from self._batches("state", unfinished)

    @property
    def _key(self) -> str:
        return str(self.design.settings["key"])

    def _take(self, piece: Any, unfinished: Any) -> tuple[Any, Any]:
        """What is told of some rows, and the streams that they and states among them are of."""
        states = _given(piece, "state", self.design.standing)
        rows = _given(piece, "row", self.design.rows, key=self._key)
        states = pa.concat_tables([unfinished, states])
        concerned = pc.is_in(states.column(self._key), rows.column(self._key).unique())
        fleet = self.design.fleet()
        put(fleet, states.filter(concerned))
        told = self.design.tell(fleet, rows)
        streams = standing(fleet, self.design.rows).cast(self.design.standing)
        return told, pa.concat_tables([streams, states.filter(pc.invert(concerned))])

    def _batches(self, name: str, table: Any) -> Iterator[Any]:
        """A table as one column beside another of nulls."""
        kinds = {"told": self.design.told, "state": self.design.standing}
        for batch in table.combine_chunks().to_batches():
            columns = {each: pa.nulls(len(batch), pa.struct(kinds[each])) for each in kinds}
            yield pa.RecordBatch.from_pydict(columns | {name: batch.to_struct_array()})


def _given(piece: Any, name: str, schema: Any, key: str | None = None) -> Any:
    """The rows in which a column of structures is not null, as a table."""
    there = piece.filter(pc.is_valid(piece.column(name)))
    table = pa.Table.from_struct_array(there.column(name))
    if key is not None:
        table = table.append_column(key, there.column("key"))
    return table.select(schema.names).cast(schema)


def pieces(batches: Iterable[Any], rows: int) -> Iterator[Any]:
    """The batches joined to tables of so many rows or more; the last one may be shorter."""
    held: list[Any] = []
    for batch in batches:
        if batch.num_rows:
            held.append(batch)
        if sum(each.num_rows for each in held) >= rows:
            yield pa.Table.from_batches(held)
            held = []
    if held:
        yield pa.Table.from_batches(held)
