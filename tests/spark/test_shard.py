"""What one worker does with a shard, called as Spark calls it."""

from __future__ import annotations

import pickle
from typing import Any

import numpy as np
import pandas as pd
import pyarrow as pa
import pytest
from plain import Table
from rows import SETTINGS, START, assert_equal_rows, assert_equal_states, table, told_alone

import forgetting as fg
from forgetting.spark.design import design_of
from forgetting.spark.packing import PART, Packing, Unpacking, packs, read, unpacked, written
from forgetting.spark.processor import STREAMS, Processor
from forgetting.spark.shard import Layout
from forgetting.spark.standing import standing
from forgetting.spark.start import Start
from forgetting.tables import TableFleet

OUTPUTS = ("prediction", "error", "skipped")
MODELS: dict[str, dict[str, Any]] = {
    "static": SETTINGS,
    "lags": {"arx": (1, 2, 0), "offset": True, "gap": "2h"},
    "clock": {"half_life": "10min", "rule": "exponential"},
}


class Value:
    """A value of the state store."""

    def __init__(self) -> None:
        self.kept: Any = None

    def get(self) -> Any:
        return self.kept

    def update(self, new: tuple[Any]) -> None:
        assert isinstance(new[0], bytes)
        self.kept = new

    def clear(self) -> None:
        self.kept = None


class Store:
    """The state store, and the timers, of one shard."""

    def __init__(self) -> None:
        self.values: dict[str, Value] = {}
        self.timers: list[int] = []

    def getValueState(self, name: str, schema: str) -> Value:
        return self.values.setdefault(name, Value())

    def registerTimer(self, milliseconds: int) -> None:
        self.timers.append(milliseconds)


class Timers:
    def __init__(self, watermark: int) -> None:
        self._watermark = watermark

    def getCurrentWatermarkInMs(self) -> int:
        return self._watermark


def layout(given: pa.Table, shards: int = 1, waits: bool = False, **settings: Any) -> Layout:
    columns = {"key": "meter", "y": "y", "phi": ["u"], "time": "t"}
    design = design_of(Table(given), OUTPUTS, ["row"], columns | settings)
    return pickle.loads(pickle.dumps(Layout(design, shards, waits)))


def started(of: Layout, store: Store) -> Processor:
    """A processor as a worker has it in a new micro-batch."""
    made = Processor(of)
    made.init(store)
    return made


def take(of: Layout, store: Store, rows: pa.Table, watermark: int = -1) -> pa.Table:
    """Take rows that come in several values."""
    rows = rows.select(of.design.rows.names).cast(of.design.rows)
    frames = [
        pd.DataFrame({"shard": 0, "rows": list(packs(rows.slice(k, 300)))})
        for k in range(0, len(rows), 300)
    ]
    return told(of, started(of, store).handleInputRows((0,), iter(frames), Timers(watermark)))


def told(of: Layout, frames: Any) -> pa.Table:
    return unpacked([each for frame in frames for each in frame["told"]], of.design.told)


@pytest.mark.parametrize("settings", MODELS.values(), ids=list(MODELS))
def test_one_micro_batch_after_the_other(settings):
    fleet, store = TableFleet("meter", "y", ["u"], time="t", **settings), Store()
    for number in range(3):
        given = table(seed=number, first=1500 * number, rows=2000)
        of = layout(given, **settings)
        assert_equal_rows(take(of, store, given), told_alone(fleet, given, OUTPUTS))
    kept = TableFleet.from_arrow(read(store.values[STREAMS].get()[0]))
    assert_equal_states(standing(kept), fleet)


def test_rows_wait_for_the_watermark_to_the_microsecond():
    seconds = [5, 1, 9, 3]
    given = table(rows=4, keys=1).set_column(
        1, "t", pa.array([START + 10**6 * s for s in seconds], pa.timestamp("us", "UTC"))
    )
    of, store = layout(given, waits=True, **SETTINGS), Store()
    assert not len(take(of, store, given, watermark=0))
    first = -(-(START + 10**6) // 1000)
    assert store.timers == [first]
    for watermark, rows in ((first - 1, []), (first, [1]), (START // 1000 + 8000, [3, 0])):
        frames = started(of, store).handleExpiredTimer((0,), Timers(watermark), None)
        assert told(of, frames).column("row").to_pylist() == rows
    assert store.timers[-1] == -(-(START + 9 * 10**6) // 1000)
    late = take(of, store, given.slice(1, 1), watermark=START // 1000 + 20_000)
    assert late.column("skipped").to_pylist() == ["late", None]  # by time; the last had waited
    assert store.values["waiting"].get() is None


def test_rows_without_a_time_wait_for_nothing():
    given = table(rows=3, keys=1).set_column(1, "t", pa.nulls(3, pa.timestamp("us", "UTC")))
    of, store = layout(given, waits=True, **SETTINGS), Store()
    assert take(of, store, given, 0).column("skipped").to_pylist() == ["missing"] * 3


def test_another_layout_is_refused_and_changes_nothing():
    given, store = table(rows=300, keys=3), Store()
    take(layout(given, **SETTINGS), store, given)
    before = store.values[STREAMS].get()
    with pytest.raises(fg.InvalidInput, match="has 1 shards, but shards = 2"):
        take(layout(given, shards=2, **SETTINGS), store, given)
    with pytest.raises(fg.InvalidInput, match="other columns or another rule"):
        take(layout(given, **SETTINGS | {"offset": False}), store, given)
    numbers = given.set_column(0, "meter", pa.array(range(300)))
    with pytest.raises(fg.InvalidInput, match="keys of the checkpoint are string, but now int64"):
        take(layout(numbers, **SETTINGS), store, numbers)
    assert store.values[STREAMS].get() == before


def test_streams_of_another_query_are_the_start():
    given, later, store = table(seed=0), table(seed=1, first=9000), Store()
    of = layout(given, **SETTINGS)
    fleet = TableFleet("meter", "y", ["u"], time="t", **SETTINGS)
    told_alone(fleet, given, OUTPUTS)
    states = standing(fleet).append_column("shard", pa.array([0] * len(fleet), pa.int32()))
    begun = Start(of)(states).to_pandas()
    started(of, store).handleInitialState((0,), begun, Timers(-1))
    assert_equal_rows(take(of, store, later), told_alone(fleet, later, OUTPUTS))


def test_rows_are_packed_by_shard_and_come_out_again():
    given = table(rows=3000).select(["meter", "t", "row"])  # no NaN, which equals nothing
    shard = np.random.default_rng(0).integers(0, 5, len(given))
    rows = given.append_column("shard", pa.array(shard, pa.int32()))
    found = pa.Table.from_batches(Packing(given.schema)(rows.to_batches(700)))
    assert found.column("shard").to_pylist() == sorted(set(shard.tolist()))
    for number, packed in zip(*found.to_pydict().values(), strict=True):
        own = given.filter(pa.array(shard == number))
        assert unpacked([packed], given.schema).combine_chunks().equals(own.combine_chunks())
    out = list(Unpacking(given.schema)(found.select(["rows"]).to_batches()))
    assert sum(map(len, out)) == len(given)


def test_many_rows_become_several_values():
    given = pa.table({"x": np.arange(PART + 1)})
    packed = list(packs(given))
    assert len(packed) == 2 and unpacked(packed, given.schema).equals(given)
    assert read(written(given)).equals(given) and not list(packs(given.slice(0, 0)))
    with pytest.raises(fg.InvalidInput, match="is no Arrow table"):
        read(b"half")
