"""A whole table at once: `identify`, and what it keeps for the next one."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

from pyspark.sql import functions as F
from pyspark.sql.types import StructType

from forgetting._core import InvalidInput
from forgetting.spark.columns import named, types
from forgetting.spark.design import Design, design_of, states_of
from forgetting.spark.partition import Partition
from forgetting.tables.fleet import OUTPUTS

FINISHED = "_SUCCESS"
"""What Spark adds to a folder when all of its files are there."""


@dataclass(frozen=True)
class Identified:
    """What was found of a table; nothing is computed before it is asked for.

    Attributes
    ----------
    both : pyspark.sql.DataFrame
        Two columns of structures, `told` and `state`; one of them is null in each row.
    """

    both: Any

    @property
    def told(self) -> Any:
        """A row for each of the table, in no order: key, time, columns kept, outputs."""
        return self.both.where("told is not null").select("told.*")

    @property
    def state(self) -> Any:
        """A row for each stream: where it stands, as `TableFleet.estimates` says it, and its state.

        Give it to the next `identify`. A stream whose state was altered has the status "refused".
        """
        return self.both.where("state is not null").select("state.*")

    def save(self, folder: str) -> None:
        """Write both as Parquet, in one job: whole, or unfinished and refused by `load`.

        What an earlier try left unfinished is replaced.

        Parameters
        ----------
        folder : str
            A path, or an address such as those of ``df.write.parquet``.

        Raises
        ------
        InvalidInput
            When the folder is there and finished.
        """
        if _is_finished(self.both.sparkSession, folder):
            raise InvalidInput(f"folder = {folder!r} is there already, allowed: another one")
        self.both.write.mode("overwrite").parquet(folder)


def load(spark: Any, folder: str) -> Identified:
    """What `Identified.save` has written.

    Parameters
    ----------
    spark : pyspark.sql.SparkSession
    folder : str

    Raises
    ------
    InvalidInput
        When the folder is not there, or the job that wrote it did not come to its end.
    """
    if not _is_finished(spark, folder):
        raise InvalidInput(f"folder = {folder!r} is not there or unfinished: save it again")
    found = spark.read.parquet(folder)
    if found.columns != ["told", "state"]:
        raise InvalidInput(f"folder = {folder!r} holds another table, allowed: what save wrote")
    return Identified(found)


def _is_finished(spark: Any, folder: str) -> bool:
    """Whether a job wrote this folder to its end."""
    path = spark._jvm.org.apache.hadoop.fs.Path(folder, FINISHED)
    return bool(path.getFileSystem(spark._jsc.hadoopConfiguration()).exists(path))


def identify(
    df: Any,
    by: str,
    y: str,
    phi: str | Sequence[str] = (),
    *,
    time: str | None = None,
    state: Any = None,
    outputs: str | Iterable[str] = OUTPUTS,
    keep: str | Iterable[str] = (),
    partitions: int | None = None,
    **settings: Any,
) -> Identified:
    """Estimate the parameters of every stream in a table of Spark.

    The rows of a stream come together on one worker, in the order of time; rows of one time in
    that of y and the columns of `phi`, so that whatever Spark computes twice is the same. A
    worker holds the streams of some 100,000 rows at a time, however many there are.

    Parameters
    ----------
    df : pyspark.sql.DataFrame
    by : str
        Column that says whose row it is; never null.
    y : str
        Column of the measurements.
    phi : str or sequence of str
        Columns of the regressors; with `arx` or `model` the inputs.
    time : str
        Column of times: numbers, dates or timestamps.
    state : pyspark.sql.DataFrame, optional
        `Identified.state` of the tables before. Rows older than the last one of their stream
        there are late: counted and left out.
    outputs : str or sequence of str
        What to tell of each row, see `TableFleet.update`.
    keep : str or sequence of str
        Columns to hand on beside it.
    partitions : int, optional
        As of ``df.repartition``.
    **settings
        The others of `TableFleet`: offset, arx, model (such as ``"arx:na=2,nb=2,nk=1"``), gap,
        half_life, rule, forgetting_factor, ...

    Returns
    -------
    Identified

    Raises
    ------
    InvalidInput
        Names what is not allowed. A missing key and a state of another model are found by the
        workers, and end the job with the same sentence.

    Examples
    --------
    >>> import math
    >>> from pyspark.sql import SparkSession
    >>> from forgetting.spark import identify
    >>> spark = SparkSession.builder.getOrCreate()
    >>> rows = [("ab"[k % 2], k, math.cos(k), (2 + k % 2) * math.cos(k)) for k in range(200)]
    >>> df = spark.createDataFrame(rows, ["meter", "t", "u", "y"])
    >>> done = identify(df, by="meter", time="t", y="y", phi="u", rule="subspace")
    >>> done.told.columns
    ['meter', 't', 'prediction', 'error', 'skipped']
    >>> [(row["meter"], row["samples"], round(row["theta:u"], 3))
    ...  for row in done.state.orderBy("meter").collect()]
    [('a', 100, 2.0), ('b', 100, 3.0)]
    """
    settings = {"key": by, "y": y, "phi": phi, "time": time, **settings}
    design = design_of(df, outputs, keep, settings)
    given = _rows(df, design)
    if state is not None:
        given = given.unionByName(_states(state, design))
    count = () if partitions is None else (partitions,)
    together = given.repartition(*count, "key").sortWithinPartitions(*_order(design))
    kinds = StructType().add("told", types(design.told))
    kinds = kinds.add("state", types(design.standing))
    return Identified(together.mapInArrow(Partition(design), kinds))


def _rows(df: Any, design: Design) -> Any:
    """The rows as structures beside their key."""
    key = design.settings["key"]
    row = F.struct(*[named(name) for name in design.rows.names if name != key])
    nothing = F.lit(None).cast(types(design.standing))
    return df.select(named(key).alias("key"), row.alias("row"), nothing.alias("state"))


def _states(state: Any, design: Design) -> Any:
    """The states as structures beside their key."""
    key = design.settings["key"]
    kinds = StructType([field for field in types(design.rows) if field.name != key])
    columns = F.struct(*[named(name) for name in design.standing.names])
    return states_of(state, design).select(
        named(key).alias("key"), F.lit(None).cast(kinds).alias("row"), columns.alias("state")
    )


def _order(design: Design) -> list[Any]:
    """Streams, states before rows, times, and what makes the order one of its kind."""
    model = design.model
    columns = [str(model.time), model.y, *model.phi]
    return [F.col("key"), F.col("state").isNull(), *[F.col("row")[name] for name in columns]]
