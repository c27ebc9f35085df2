"""Where the streams of a query stand, read from its checkpoint."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any

from forgetting._core import InvalidInput
from forgetting.spark.columns import types
from forgetting.spark.packing import read
from forgetting.spark.processor import STREAMS
from forgetting.spark.standing import standing
from forgetting.tables import TableFleet


@dataclass(frozen=True)
class Standing:
    """Makes rows of the bytes of shards."""

    schema: Any

    def __call__(self, batches: Iterable[Any]) -> Iterator[Any]:
        """A row for each stream."""
        for batch in batches:
            for kept in batch.column(0).to_pylist():
                fleet = TableFleet.from_arrow(read(kept), threads=1)
                yield from standing(fleet).cast(self.schema).combine_chunks().to_batches()


def states(spark: Any, checkpoint: str) -> Any:
    """The states of all streams after the last micro-batch that was finished.

    Rows that still wait for a watermark are not among them.

    Parameters
    ----------
    spark : pyspark.sql.SparkSession
    checkpoint : str
        The ``checkpointLocation`` of a query that `stateful` has made; it may be running.

    Returns
    -------
    pyspark.sql.DataFrame
        As `Identified.state`: it begins another query (`start` of `stateful`), such as one with
        more shards, or goes on with a table (`state` of `identify`).

    Raises
    ------
    InvalidInput
        When no stream is kept there.
    """
    _ = spark.streams  # starts what workers ask for the places of state stores
    stored = spark.read.format("statestore").option("stateVarName", STREAMS).load(checkpoint)
    kept = stored.select("value.kept")
    first = kept.first()
    if first is None:
        raise InvalidInput(f"checkpoint = {checkpoint!r} keeps no stream yet")
    schema = standing(TableFleet.from_arrow(read(bytes(first[0])))).schema
    return kept.mapInArrow(Standing(schema), types(schema))
