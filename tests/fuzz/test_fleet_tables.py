"""Arrow tables that no fleet saved are refused with one line, or are a fleet that goes on."""

from __future__ import annotations

from typing import Any

import numpy as np
import pyarrow as pa
from hypothesis import strategies as st

import forgetting as fg
from forgetting.fleet import FRESH

from .saved import changed
from .target import fuzz

TYPES = (pa.int64(), pa.int32(), pa.string(), pa.binary(), pa.float64(), pa.bool_(), pa.date32())
STREAMS = (0, 1, 2, 3, -1, 2**62, None)


def fleets() -> list[pa.Table]:
    """Saved fleets: streams in lanes, estimators, and such as have a factor of their own."""
    made = [
        fg.Fleet(4, 2, rule="subspace", initial_covariance=10.0),
        fg.Fleet(3, 2, rule="random_walk"),
        fg.Fleet(2, 2, rule="exponential", forgetting_factor=[0.9, 0.99], dtype="float32"),
    ]
    for fleet in made:
        for k in range(20):
            fleet.update(np.full((len(fleet), 2), 1.0 + k % 3), np.ones(len(fleet)))
    return [fleet.to_arrow() for fleet in made]


def states(table: pa.Table) -> list[bytes]:
    """The states in a table."""
    return list(table.column("state").to_pylist())


@st.composite
def tables(draw: st.DrawFn, saved: list[pa.Table]) -> Any:
    """A saved fleet with changed states, numbers, types, names or metadata."""
    table = draw(st.sampled_from(saved))
    rows = states(table) + draw(st.lists(st.sampled_from(states(saved[0])), max_size=1))
    other = st.one_of(changed(dict(enumerate(rows))), st.binary(max_size=60), st.none())
    rows = [draw(other) if not draw(st.integers(0, 5)) else row for row in rows]
    numbers = draw(
        st.one_of(
            st.permutations(range(len(rows))),
            st.lists(st.sampled_from(STREAMS), min_size=len(rows), max_size=len(rows)),
        )
    )
    columns = {
        "stream": pa.array(numbers, pa.int64()),
        "state": pa.array(rows, draw(st.sampled_from((pa.large_binary(), pa.binary())))),
        "other": pa.array(draw(st.lists(st.floats(), min_size=len(rows), max_size=len(rows)))),
    }
    names = draw(st.lists(st.sampled_from(sorted(columns)), max_size=4))
    names = draw(st.sampled_from((["stream", "state"], ["state"], names)))
    fresh = draw(st.sampled_from((*table.schema.metadata.values(), b"", rows[0], b"x" * 99)))
    made = pa.Table.from_arrays([columns[name] for name in names], names)
    if fresh is not None and draw(st.booleans()):
        made = made.replace_schema_metadata({FRESH: fresh})
    if names and draw(st.integers(0, 4)) == 0:
        made = cast(made, draw(st.sampled_from(range(len(names)))), draw(st.sampled_from(TYPES)))
    made = made.slice(draw(st.integers(0, 1)), draw(st.sampled_from((None, None, 0, 1))))
    return draw(st.sampled_from((made, made, made, pa.concat_tables([made, made]), names)))


def cast(table: pa.Table, place: int, to: pa.DataType) -> pa.Table:
    """The table with a column of another type, where that is possible."""
    try:
        return table.set_column(place, table.column_names[place], table.column(place).cast(to))
    except pa.ArrowException:
        return table


def goes_on(table: Any) -> None:
    """What was read takes more samples and is the fleet that it says it is."""
    fleet = fg.Fleet.from_arrow(table)
    assert len(fleet) == table.num_rows
    for _ in range(3):
        fleet.update(np.ones((len(fleet), fleet.parameters)), np.ones(len(fleet)))
    assert not np.isnan(fleet.theta).any() and len(fleet.health().status) == len(fleet)
    fleet.append(2)
    assert fleet.to_arrow().num_rows == table.num_rows + 2


def test_fleet() -> None:
    fuzz("Fleet.from_arrow", 300, tables(fleets()), goes_on)
