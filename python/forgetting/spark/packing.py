"""Rows as bytes: Spark hands a stateful operator one row at a time, so one row brings many."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
import pyarrow as pa

from forgetting._core import InvalidInput
from forgetting.spark.partition import ROWS, pieces
from forgetting.words.errors import first_line

PART = 1 << 16
"""Rows in one value of bytes."""


@dataclass(frozen=True)
class Packing:
    """Joins the rows of each shard in a partition to bytes.

    Batches in have the columns `shard`, and those of the schema; batches out `shard` and `rows`.
    """

    schema: Any

    def __call__(self, batches: Iterable[Any]) -> Iterator[Any]:
        """One row or more for each shard that the partition has rows of."""
        for piece in pieces(batches, ROWS):
            shards = piece.column("shard").to_numpy()
            order = np.argsort(shards, kind="stable")
            rows = piece.select(self.schema.names).cast(self.schema).take(pa.array(order))
            found, starts = np.unique(shards[order], return_index=True)
            for shard, start, end in zip(found, starts, [*starts[1:], len(rows)], strict=True):
                packed = [[int(shard), each] for each in packs(rows.slice(start, end - start))]
                yield pa.RecordBatch.from_arrays(
                    [
                        pa.array([shard for shard, _ in packed], pa.int32()),
                        pa.array([each for _, each in packed], pa.binary()),
                    ],
                    ["shard", "rows"],
                )


@dataclass(frozen=True)
class Unpacking:
    """Makes rows of the bytes in the one column of its batches."""

    schema: Any

    def __call__(self, batches: Iterable[Any]) -> Iterator[Any]:
        """The rows."""
        for batch in batches:
            for each in batch.column(0).to_pylist():
                yield from unpacked([each], self.schema).to_batches()


def packs(table: Any) -> Iterator[bytes]:
    """A table as a few values of bytes."""
    for start in range(0, len(table), PART):
        for batch in table.slice(start, PART).combine_chunks().to_batches():
            yield batch.serialize().to_pybytes()


def unpacked(packed: Iterable[bytes], schema: Any) -> Any:
    """The table of what `packs` has made."""
    return pa.Table.from_batches(
        [pa.ipc.read_record_batch(each, schema) for each in packed], schema
    )


def written(table: Any) -> bytes:
    """A table as bytes with its schema."""
    sink = pa.BufferOutputStream()
    with pa.ipc.new_stream(sink, table.schema) as stream:
        stream.write_table(table.combine_chunks())
    return bytes(sink.getvalue())


def read(kept: bytes) -> Any:
    """The table of what `written` has made."""
    try:
        return pa.ipc.open_stream(kept).read_all()
    except pa.ArrowException as error:
        raise InvalidInput(f"the kept state is no Arrow table: {first_line(error)}") from None
