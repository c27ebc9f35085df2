"""A change is told as an event with its row and time, as a stream tells it."""

from __future__ import annotations

import json

import numpy as np
import pandas as pd
import pytest

from forgetting.record import identify
from forgetting.stream import Settings, Stream


def steps(jump: float) -> pd.DataFrame:
    """A gain of 2 that jumps at row 501, every tenth second."""
    rng = np.random.default_rng(6)
    u = rng.normal(size=1000)
    gain = np.where(np.arange(1000) < 500, 2.0, 2.0 + jump)
    y = 1.0 + gain * u + 0.1 * rng.normal(size=1000)
    return pd.DataFrame({"t_s": np.arange(1000) / 10, "u": u, "y": y})


@pytest.mark.parametrize("rule", ["auto", "none"])
def test_a_jump_is_one_change_with_its_time(rule):
    found = identify(steps(1.0), output="y", input="u", arx=(0, 1, 0), rule=rule)
    (change,) = found.changes
    assert 501 <= change.row <= 505
    assert float(change.time) == pytest.approx((change.row - 1) / 10)
    assert change.row + 99 < change.until < change.row + 250
    assert found.summary()["changes"] == [
        {"row": change.row, "time": change.time, "until": change.until}
    ]
    assert str(change.row) in str(change) and change.time in str(change)


def test_nothing_is_told_of_white_noise():
    assert identify(steps(0.0), output="y", input="u", arx=(0, 1, 0)).changes == []


def test_units_do_not_matter():
    table = steps(1.0)
    scaled = table.assign(u=table["u"] * 1e6, y=table["y"] * 1e-3)
    one, other = (identify(each, formula="y ~ u").changes for each in (table, scaled))
    assert one == other


def test_a_stream_tells_the_same_rows():
    table = steps(1.0)
    lines = Stream(Settings(output=["y"], input=["u"])).feed(table.to_csv(index=False).encode())
    told = [json.loads(line) for line in lines.lines if b'"change"' in line]
    (change,) = identify(table, output="y", input="u", arx=(0, 1, 0)).changes
    assert [(each["state"], each["row"]) for each in told] == [
        ("begins", change.row),
        ("ends", change.until),
    ]


def test_one_that_goes_on_has_no_end():
    found = identify(steps(1.0)[:560], output="y", input="u", arx=(0, 1, 0))
    assert [change.until for change in found.changes] == [None]
    assert "until the end of the record" in str(found.changes[0])
