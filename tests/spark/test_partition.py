"""What one worker does with a partition, called as Spark calls it."""

from __future__ import annotations

import pickle
from typing import Any

import pyarrow as pa
import pyarrow.compute as pc
import pytest
from plain import Table
from rows import SETTINGS, assert_equal_rows, assert_equal_states, table, told_alone

import forgetting as fg
from forgetting.spark import partition
from forgetting.spark.design import Design, design_of
from forgetting.spark.partition import Partition
from forgetting.tables import TableFleet

OUTPUTS = ("prediction", "error", "leverage", "theta", "variance", "skipped")
MODELS: dict[str, dict[str, Any]] = {
    "static": SETTINGS,
    "default": {},
    "lags": {"arx": (1, 2, 0), "offset": True, "gap": "2h"},
    "clock": {"half_life": "10min", "rule": "exponential"},
    "float32": {"dtype": "float32", "rule": fg.Exponential(0.95)},
}


def design_for(given: pa.Table, **settings: Any) -> Design:
    """A design that has gone to a worker and hands on the number of the row."""
    columns = {"key": "meter", "y": "y", "phi": ["u"], "time": "t"}
    made = design_of(Table(given), OUTPUTS, ["row"], columns | settings)
    return pickle.loads(pickle.dumps(made))


def run(design: Design, rows: pa.Table, states: pa.Table | None = None, size: int = 500) -> Any:
    """What is told of rows in any order, and the states after them."""
    key, kinds = "meter", design.standing
    states = kinds.empty_table() if states is None else states
    names = [name for name in design.rows.names if name != key]
    parts = []
    for name, each, columns in (("row", rows, names), ("state", states, kinds.names)):
        nested = each.select(columns).combine_chunks().to_struct_array()
        part = pa.table({"key": each.column(key), name: nested})
        parts.append(part.append_column("order", each.column("t")) if name == "row" else part)
    together = pa.concat_tables(parts, promote_options="default")
    first = pc.cast(pc.is_null(together.column("state")), pa.int8())
    together = together.append_column("first", first).append_column("y", y_of(together))
    together = together.sort_by([(n, "ascending") for n in ("key", "first", "order", "y")])
    found = list(Partition(design)(together.select(["key", "row", "state"]).to_batches(size)))
    both = pa.Table.from_batches(found)
    return [flat(both, "told", design.told), flat(both, "state", kinds)]


def y_of(together: pa.Table) -> Any:
    return pc.struct_field(together.column("row"), "y")


def flat(both: pa.Table, name: str, schema: pa.Schema) -> pa.Table:
    there = both.filter(pc.is_valid(both.column(name)))
    return pa.Table.from_struct_array(there.column(name)).cast(schema)


@pytest.mark.parametrize("settings", MODELS.values(), ids=list(MODELS))
@pytest.mark.parametrize("rows_at_a_time", [100, partition.ROWS])
def test_tables_one_after_the_other(settings, rows_at_a_time, monkeypatch):
    monkeypatch.setattr(partition, "ROWS", rows_at_a_time)
    fleet, states = TableFleet("meter", "y", ["u"], time="t", **settings), None
    for day in range(3):
        given = table(seed=day, first=1500 * day, rows=2000)
        told, states = run(design_for(given, **settings), given, states)
        assert_equal_rows(told, told_alone(fleet, given, OUTPUTS))
        assert_equal_states(states, fleet)


def test_streams_without_rows_go_through_untouched():
    given, later = table(), table(keys=3, seed=1, first=9000)
    design = design_for(given, **SETTINGS)
    before = run(design, given)[1]
    after = run(design, later, before)[1]
    untouched = pc.invert(pc.is_in(before.column("meter"), later.column("meter").unique()))
    assert len(after) == len(before) == 40
    kept = before.filter(untouched)
    assert kept.equals(after.filter(pc.is_in(after.column("meter"), kept.column("meter"))))


def test_an_altered_state_stops_no_other():
    given, later = table(keys=4), table(keys=4, seed=1, first=9000)
    design = design_for(given, **SETTINGS)
    before = run(design, given)[1].sort_by("meter")
    bytes_ = before.column("state").to_pylist()
    bytes_[1] = bytes_[1][:99] + bytes([bytes_[1][99] ^ 4]) + bytes_[1][100:]
    at = before.column_names.index("state")
    broken = before.set_column(at, "state", pa.array(bytes_, pa.binary()))
    told, after = run(design, later, broken)
    words = told.filter(pc.equal(told.column("meter"), "m1")).column("skipped")
    assert set(words.to_pylist()) == {"refused"}
    after = after.sort_by("meter")
    assert after.column("status").to_pylist() == ["ok", "refused", "ok", "ok"]
    assert after.column("state")[1].as_py() == bytes_[1]
    assert (
        run(design, later, before)[1].sort_by("meter").column("state")[0]
        == after.column("state")[0]
    )


def test_a_state_of_another_model_is_refused():
    given = table()
    states = run(design_for(given, **SETTINGS), given)[1]
    with pytest.raises(fg.InvalidInput, match="other columns or another rule"):
        run(design_for(given, **SETTINGS | {"rule": "exponential"}), given, states)


@pytest.mark.parametrize("kind", ["int64", "double", "date32", "timestamp", "duration"])
@pytest.mark.parametrize("by_clock", [False, True])
def test_times_of_all_types_are_kept(kind, by_clock):
    kinds = {"timestamp": pa.timestamp("us"), "duration": pa.duration("us")}
    settings = {"half_life": 50.0, "rule": "exponential"} if by_clock else SETTINGS
    given = table(keys=5)
    days = pc.divide(pc.subtract(given.column("t").cast(pa.int64()), 1_699_000_000_000_000), 10**6)
    days = days.cast(pa.int32()) if kind == "date32" else days
    given = given.set_column(1, "t", days.cast(kinds.get(kind, kind)))
    fleet, states = TableFleet("meter", "y", ["u"], time="t", **settings), None
    for part in (given.slice(0, 1500), given.slice(1500)):
        told, states = run(design_for(given, **settings), part, states)
        assert_equal_rows(told, told_alone(fleet, part, OUTPUTS))
        assert states.column("state").to_pylist() == [
            fleet[key].to_bytes() for key in states.column("meter").to_pylist()
        ]
    assert states.sort_by("meter").column("late").to_pylist() == [
        row["late"] for row in fleet.estimates().sort_by("meter").to_pylist()
    ]


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"time": None}, "time is missing"),
        ({"time": "when"}, "no column|0 columns named 'when'"),
        ({"y": "Y"}, "0 columns named 'Y'"),
        ({"y": "meter", "key": "row"}, "must hold numbers"),
        ({"key": "u", "phi": ["row"]}, None),
        ({"rule": "nonsense"}, "nonsense"),
        ({"phi": []}, "phi is empty"),
    ],
)
def test_what_is_refused_before_any_worker_hears_of_it(change, words):
    given = table(rows=20)
    settings = {"key": "meter", "y": "y", "phi": ["u"], "time": "t"} | change
    if words is None:
        assert design_of(Table(given), OUTPUTS, [], settings)
        return
    with pytest.raises((fg.InvalidInput, ValueError), match=words):
        design_of(Table(given), OUTPUTS, [], settings)


@pytest.mark.parametrize(
    ("text", "orders"), [("arx:na=1,nb=2,nk=0", (1, 2, 0)), ("fir:nb=2,nk=1", (0, 2, 1))]
)
def test_a_model_as_a_text_is_the_one_of_its_orders(text, orders):
    given = table(rows=200)
    found = run(design_for(given, model=text, gap="2h"), given)
    assert found == run(design_for(given, arx=orders, gap="2h"), given)
    assert pc.count(found[0].column("prediction")).as_py() > 0


def test_a_kept_column_has_a_name_of_its_own():
    given = table(rows=20).rename_columns(["meter", "t", "u", "y", "error"])
    settings = {"key": "meter", "y": "y", "phi": ["u"], "time": "t"}
    with pytest.raises(fg.InvalidInput, match="keep = \\['error'\\]"):
        design_of(Table(given), OUTPUTS, ["error"], settings)
    assert design_of(Table(given), ["leverage"], "error", settings).told.names[2:] == [
        "error",
        "leverage",
    ]


def test_a_missing_key_ends_the_work_with_a_sentence():
    given = table(rows=50)
    keys = pa.array([None, *given.column("meter").to_pylist()[1:]], pa.string())
    with pytest.raises(fg.InvalidInput, match="key column 'meter' is missing in row"):
        run(design_for(given), given.set_column(0, "meter", keys))
