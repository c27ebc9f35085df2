"""Rows as they come, by Structured Streaming: `stateful`."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import pyarrow as pa
from pyspark.sql import functions as F

from forgetting._core import InvalidInput
from forgetting.spark.columns import named, types
from forgetting.spark.design import Design, design_of, states_of
from forgetting.spark.packing import Packing, Unpacking
from forgetting.spark.processor import Processor
from forgetting.spark.shard import Layout
from forgetting.spark.start import Start
from forgetting.tables.fleet import OUTPUTS

PROVIDER = "spark.sql.streaming.stateStore.providerClass"
ROCKSDB = "org.apache.spark.sql.execution.streaming.state.RocksDBStateStoreProvider"


def stateful(
    df: Any,
    by: str,
    y: str,
    phi: str | Sequence[str] = (),
    *,
    time: str | None = None,
    shards: int,
    delay: str | None = None,
    start: Any = None,
    outputs: str | Iterable[str] = OUTPUTS,
    keep: str | Iterable[str] = (),
    **settings: Any,
) -> Any:
    """Follow every stream of a table of Spark to which rows are added.

    Streams are shared out over shards by a hash of their key; a shard reads and writes the states
    of all its streams, some 300 bytes each for two parameters, in every micro-batch that has rows
    of it. Spark's checkpoint keeps them, so that each row counts once whatever is killed.

    Parameters
    ----------
    df : pyspark.sql.DataFrame
        A streaming one, or any.
    by, y, phi, time, outputs, keep
        As of `identify`.
    shards : int
        How many there are, from now on: a checkpoint goes on with as many. Some 1000 to 3000
        streams a shard are a good choice, and at least as many shards as partitions.
    delay : str, optional
        How long rows wait for those before them, such as "10 seconds"; the time must be a
        timestamp. Each row is then told when no earlier one is waited for any longer: when the
        watermark, the last time of all rows less this delay, has passed it. Without a delay rows
        are taken as they come, sorted within their micro-batch. Rows older than what their
        stream has taken are late, counted and left out, in both.
    start : pyspark.sql.DataFrame, optional
        States to begin with where the checkpoint is new: those of `identify` or `states`.
    **settings
        The others of `TableFleet`.

    Returns
    -------
    pyspark.sql.DataFrame
        A row for each one taken: key, time, columns kept, outputs.

    Raises
    ------
    InvalidInput
        Names what is not allowed. What only workers can see (a missing key, a checkpoint of
        another model) ends the query with such a sentence.
    """
    settings = {"key": by, "y": y, "phi": phi, "time": time, **settings}
    design = design_of(df, outputs, keep, settings)
    _check(df.sparkSession, shards, delay, design)
    layout = Layout(design, shards, delay is not None)
    watched = df if delay is None else df.withWatermark(str(time), delay)
    columns = [named(name) for name in design.rows.names]
    rows = watched.select(shard_of(by, shards), *columns)
    packed = rows.mapInArrow(Packing(design.rows), "shard int, rows binary").groupBy("shard")
    told = packed.transformWithStateInPandas(
        Processor(layout),
        outputStructType="told binary",
        outputMode="append",
        timeMode="none" if delay is None else "eventTime",
        initialState=None if start is None else _begun(start, by, layout),
    )
    return told.mapInArrow(Unpacking(design.told), types(design.told))


def shard_of(by: str, shards: int) -> Any:
    """The column that says which shard a key belongs to."""
    return F.pmod(F.hash(named(by)), F.lit(shards)).alias("shard")


def _begun(start: Any, by: str, layout: Layout) -> Any:
    """States by shard."""
    states = states_of(start, layout.design)
    by_shard = states.select(shard_of(by, layout.shards), "*").groupBy("shard")
    begin = Start(layout)
    # a function: of an object, Spark would count `self` among the arguments
    begun = by_shard.applyInArrow(lambda rows: begin(rows), "shard int, streams binary")
    return begun.groupBy("shard")


def _check(spark: Any, shards: int, delay: str | None, design: Design) -> None:
    if not isinstance(shards, int) or shards < 1:
        raise InvalidInput(f"shards = {shards!r}, allowed: whole numbers from 1")
    if "shard" in design.rows.names:
        raise InvalidInput("a column is named 'shard', allowed: another name")
    time = design.rows.field(str(design.settings["time"]))
    if delay is not None and not pa.types.is_timestamp(time.type):
        raise InvalidInput(
            f"delay = {delay!r} with time column {time.name!r} of {time.type}, allowed: timestamps"
        )
    if "RocksDB" not in spark.conf.get(PROVIDER):
        raise InvalidInput(
            f"the state store must be RocksDB: spark.conf.set({PROVIDER!r}, {ROCKSDB!r})"
        )
