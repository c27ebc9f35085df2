"""Tables of streams that are banks: what one `Bank` a key gives."""

from __future__ import annotations

from typing import Any

import numpy as np
import pyarrow as pa
import pytest
from streams import alone, numbers, of_key, shuffled, table

import forgetting as fg
from forgetting.tables import TableFleet

OUTPUTS = ("error", "theta", "variance", "skipped")


def fed(batches: int = 1, **more: Any) -> tuple[pa.Table, TableFleet, pa.Table]:
    """Rows in any order, the fleet that took them, and what it told."""
    given = table(skewed=True)
    fleet = TableFleet("key", "y", ["x", "z"], time="t", offset=True, rule="auto", **more)
    size = -(-len(given) // batches)
    parts = [shuffled(given.slice(k * size, size), k) for k in range(batches)]
    told = [fleet.update(part, OUTPUTS).unify_dictionaries() for part in parts]
    return given, fleet, pa.concat_tables(told)


def assert_banks(given: pa.Table, fleet: TableFleet, told: pa.Table, **more: Any) -> None:
    """That each stream did what a bank does alone."""
    for key in set(given.column("key").to_pylist()):
        rows, bank = of_key(given, key), fg.Bank(3, **more)
        phi = np.column_stack([numbers(rows, "x", "z"), np.ones(len(rows))]).astype(bank.dtype)
        expected = alone(bank, phi, numbers(rows, "y")[:, 0].astype(bank.dtype))
        own = of_key(told, key)
        assert own.column("skipped").to_pylist() == expected["skipped"].tolist()
        np.testing.assert_array_equal(numbers(own, "error")[:, 0], expected["error"])
        theta = numbers(own, "theta:x", "theta:z", "theta:offset")
        np.testing.assert_array_equal(theta, expected["theta"])
        variance = numbers(own, "variance:x", "variance:z", "variance:offset")
        rounding = 1e-5 if bank.dtype == "float32" else 1e-11  # the same sum in another order
        np.testing.assert_allclose(variance, expected["variance"], rtol=rounding)
        assert fleet[key].to_bytes() == bank.to_bytes()


@pytest.mark.parametrize("more", [{}, {"dtype": "float32"}, {"weighting": "huber"}], ids=str)
@pytest.mark.parametrize("batches", [1, 4])
def test_one_bank_a_key(more, batches):
    assert_banks(*fed(batches, **more), **more)


@pytest.mark.parametrize("alone_costs", [0.0, 1e12])
def test_rounds_and_records_are_the_same(monkeypatch, alone_costs):
    monkeypatch.setattr("forgetting.tables.pages.ALONE", alone_costs)
    assert_banks(*fed(2))


def test_what_is_told_does_not_depend_on_the_batches():
    def told(batches: int) -> pa.Table:
        return fed(batches)[2].sort_by([("key", "ascending"), ("t", "ascending")])

    once, often = told(1), told(7)
    assert once.column("skipped").to_pylist() == often.column("skipped").to_pylist()
    for name in set(once.column_names) - {"key", "t", "skipped"}:
        np.testing.assert_array_equal(numbers(once, name), numbers(often, name))


def test_states_go_on_where_they_were(tmp_path):
    given, fleet, _ = fed()
    fleet.save(tmp_path / "fleet.arrow")
    again = TableFleet.load(tmp_path / "fleet.arrow")
    first = given.column("key")[0].as_py()
    again.put(fleet.to_arrow([first]))
    rest = table(seed=1)
    late = rest.set_column(1, "t", pa.array(rest.column("t").to_numpy() + 10**7))
    for each in (fleet, again):
        each.update(late)
    assert again.keys() == fleet.keys() and not again.refused
    for key in fleet:
        assert isinstance(again[key], fg.Bank)
        assert again[key].to_bytes() == fleet[key].to_bytes()


def test_an_altered_state_is_refused_for_its_key_alone():
    _, fleet, _ = fed()
    saved = fleet.to_arrow()
    states = saved.column("state").to_pylist()
    states[2] = states[2][:200] + b"x" + states[2][201:]
    bad = saved.set_column(1, "state", pa.array(states, pa.large_binary()))
    again = TableFleet.from_arrow(bad.replace_schema_metadata(saved.schema.metadata))
    key = saved.column("key")[2].as_py()
    assert list(again.refused) == [key] and len(again) == len(fleet) - 1


def test_a_fleet_of_banks_and_one_of_estimators_do_not_mix():
    _, fleet, _ = fed()
    other = TableFleet("key", "y", ["x", "z"], time="t", offset=True)
    with pytest.raises(fg.InvalidInput, match="other columns or another rule"):
        other.put(fleet.to_arrow())


def test_a_half_life_needs_a_forgetting_factor():
    with pytest.raises(fg.InvalidInput, match="a rule with a forgetting factor"):
        TableFleet("key", "y", "x", time="t", half_life="1h", rule="auto")
    with pytest.raises(fg.InvalidInput, match="the rule auto uses none"):
        TableFleet("key", "y", "x", rule="auto", forgetting_factor=0.9)
