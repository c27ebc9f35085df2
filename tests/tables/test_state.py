"""Streams out and in: bit for bit, all or some, and an altered one stops no other."""

from __future__ import annotations

from typing import Any

import pyarrow as pa
import pytest
from pyarrow import feather
from streams import shuffled, table

import forgetting as fg
from forgetting.tables import TableFleet

FLEETS: dict[str, dict[str, Any]] = {
    "static": {"phi": ["x", "z"], "time": "t", "offset": True},
    "lags": {"phi": ["z"], "time": "t", "arx": (2, 2, 1), "rule": "subspace"},
    "clock": {"phi": ["x"], "time": "t", "half_life": "1h", "rule": "exponential"},
    "no time": {"phi": ["x", "z"]},
}


def halves(**settings: Any) -> tuple[TableFleet, pa.Table, pa.Table]:
    """A fleet after the first half of a table, and both halves."""
    given = table(rows=500, keys=6)
    first, second = shuffled(given.slice(0, 250)), shuffled(given.slice(250))
    fleet = TableFleet("key", "y", **settings)
    fleet.update(first)
    return fleet, first, second


def altered(saved: pa.Table, row: int) -> pa.Table:
    """The table with one bit of one state changed."""
    states = saved.column("state").to_pylist()
    states[row] = states[row][:99] + bytes([states[row][99] ^ 4]) + states[row][100:]
    position = saved.column_names.index("state")
    return saved.set_column(position, "state", pa.array(states, type=pa.large_binary()))


@pytest.mark.parametrize("settings", FLEETS.values(), ids=list(FLEETS))
@pytest.mark.parametrize("file", [False, True])
def test_a_saved_fleet_goes_on_bit_for_bit(settings, file, tmp_path):
    fleet, _, second = halves(**settings)
    saved = fleet.to_arrow()
    if file:
        fleet.save(tmp_path / "f.arrow")
        assert feather.read_table(tmp_path / "f.arrow").equals(saved)
    again = TableFleet.load(tmp_path / "f.arrow") if file else TableFleet.from_arrow(saved)
    assert again.keys() == fleet.keys() and again.model == fleet.model
    assert fleet.update(second).equals(again.update(second))
    assert fleet.to_arrow().equals(again.to_arrow())


@pytest.mark.parametrize("name", ["static", "clock"])
@pytest.mark.parametrize("kind", [pa.timestamp("us", "UTC"), pa.timestamp("s"), pa.duration("ms")])
def test_times_that_are_no_numbers_come_back(name, kind):
    given = table(rows=200, keys=3)
    position = given.column_names.index("t")
    given = given.set_column(position, "t", given.column("t").cast(pa.int64()).cast(kind))
    fleet = TableFleet("key", "y", **FLEETS[name])
    fleet.update(given.slice(0, 100))
    again = TableFleet.from_arrow(fleet.to_arrow())
    assert fleet.update(given.slice(100)).equals(again.update(given.slice(100)))
    assert fleet.to_arrow().equals(again.to_arrow())


@pytest.mark.parametrize("settings", FLEETS.values(), ids=list(FLEETS))
def test_some_streams_move_to_another_fleet(settings):
    fleet, _, second = halves(**settings)
    some, rest = fleet.keys()[1:3], fleet.keys()[:1] + fleet.keys()[3:]
    two = [TableFleet.from_arrow(fleet.to_arrow(keys)) for keys in (some, rest)]
    two[0].put(two[1].to_arrow())
    fleet.update(second)
    two[0].update(second)
    assert set(two[0]) == set(fleet)
    for key in fleet:
        assert two[0][key].to_bytes() == fleet[key].to_bytes()
        assert two[0].to_arrow([key]).equals(fleet.to_arrow([key]))


@pytest.mark.parametrize("altered_row", [None, 1, 4, 12])
def test_a_file_of_many_pages(altered_row, tmp_path, monkeypatch):
    for module in ("pages", "state", "restore"):
        monkeypatch.setattr(f"forgetting.tables.{module}.PAGE", 4)
    given = table(rows=900, keys=14)
    fleet = TableFleet("key", "y", **FLEETS["lags"])
    fleet.update(given.slice(0, 500))
    fleet.save(tmp_path / "f.arrow")
    bad = None
    if altered_row is not None:
        saved = altered(feather.read_table(tmp_path / "f.arrow"), altered_row)
        bad = saved.column("key")[altered_row].as_py()
        batches = saved.to_batches(max_chunksize=4)
        with pa.ipc.new_file(str(tmp_path / "f.arrow"), saved.schema) as file:
            for batch in batches:
                file.write_batch(batch)
    again = TableFleet.load(tmp_path / "f.arrow")
    assert list(again.refused) == [bad] * (bad is not None)
    for each in (fleet, again):
        each.update(given.slice(500))
    for key in fleet:
        assert key == bad or again.to_arrow([key]).equals(fleet.to_arrow([key]))


def test_put_replaces_streams_that_are_there():
    fleet, _, second = halves(**FLEETS["lags"])
    saved, keys = fleet.to_arrow(), fleet.keys()
    fleet.update(second)
    fleet.put(saved)
    assert fleet.to_arrow().equals(saved) and fleet.keys() == keys


def test_an_altered_state_is_refused_and_named_and_the_others_go_on():
    fleet, _, second = halves(**FLEETS["static"])
    saved = altered(fleet.to_arrow(), 2)
    bad = saved.column("key")[2].as_py()
    again = TableFleet.from_arrow(saved)
    assert list(again.refused) == [bad] and "altered" in again.refused[bad]
    told, expected = again.update(second).to_pylist(), fleet.update(second).to_pylist()
    for one, other in zip(told, expected, strict=True):
        if one["key"] == bad:
            assert one["skipped"] == "refused" and one["error"] is None
        else:
            assert one == other
    assert bad not in again and bad not in again.estimates().column("key").to_pylist()


def test_a_refused_state_is_handed_on_until_a_good_one_comes():
    fleet, _, _ = halves(**FLEETS["static"])
    saved = fleet.to_arrow()
    bad = saved.column("key")[0].as_py()
    again = TableFleet.from_arrow(TableFleet.from_arrow(altered(saved, 0)).to_arrow())
    assert list(again.refused) == [bad]
    again.put(fleet.to_arrow([bad]))
    assert not again.refused and again[bad].to_bytes() == fleet[bad].to_bytes()
    assert len(again.to_arrow()) == len(saved)


def test_a_missing_state_is_refused_for_its_key():
    fleet, _, _ = halves(**FLEETS["no time"])
    saved = fleet.to_arrow()
    states = [None, *saved.column("state").to_pylist()[1:]]
    saved = saved.set_column(1, "state", pa.array(states, type=pa.large_binary()))
    assert TableFleet.from_arrow(saved).refused == {fleet.keys()[0]: "state: there is none"}


@pytest.mark.parametrize("change", ["rule", "columns", "metadata", "key twice", "no state", "lags"])
def test_tables_of_other_fleets_change_nothing(change):
    fleet, _, _ = halves(**FLEETS["lags"])
    before = fleet.to_arrow()
    other = before
    if change == "rule":
        other = halves(**FLEETS["lags"] | {"rule": "exponential"})[0].to_arrow()
    elif change == "columns":
        other = halves(**FLEETS["lags"] | {"arx": (1, 2, 1)})[0].to_arrow()
    elif change == "metadata":
        other = before.replace_schema_metadata(None)
    elif change == "key twice":
        other = pa.concat_tables([before, before.slice(0, 1)])
    elif change == "no state":
        other = before.drop_columns(["state"])
    else:
        short = pa.array([[1.0]] * len(before))
        other = before.set_column(before.column_names.index("lags"), "lags", short)
    with pytest.raises(fg.InvalidInput):
        fleet.put(other)
    assert fleet.to_arrow().equals(before)


def test_keys_without_a_stream_are_no_keys():
    fleet, _, _ = halves(**FLEETS["static"])
    with pytest.raises(KeyError):
        fleet.to_arrow(["nobody"])
    with pytest.raises(KeyError):
        fleet["nobody"]
    assert "nobody" not in fleet and fleet.keys()[0] in fleet
