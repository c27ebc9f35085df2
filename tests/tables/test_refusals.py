"""Tables and settings that a fleet refuses."""

from __future__ import annotations

import numpy as np
import pandas as pd
import pyarrow as pa
import pytest
from streams import ROWS, new

import forgetting as fg
from forgetting.tables import TableFleet

BAD = {
    "no such column": (
        {"Y": [1.0, 2.0, 3.0]},
        "y",
        "the batch has no column 'y'; it has 'key', 't', 'x', 'Y'",
    ),
    "null key": ({"key": ["a", None, "b"]}, None, "key column 'key' is missing in row 1"),
    "NaN key": ({"key": [1.0, 2.0, float("nan")]}, None, "key column 'key' is NaN in row 2"),
    "list as key": ({"key": [[1], [2], [1]]}, None, "key column 'key' holds list<"),
    "other type of key": ({"key": [1, 2, 3]}, None, "holds int64, but the keys so far are string"),
    "text for numbers": (
        {"x": ["1", "2", "x"]},
        None,
        "column 'x' must hold numbers, but it holds",
    ),
    "dates for numbers": (
        {"y": np.array(["2026-01-01"] * 3, dtype="M8[s]")},
        None,
        "column 'y' must hold numbers",
    ),
    "text for times": (
        {"t": ["1", "2", "3"]},
        None,
        "time column 't' holds string, allowed: numbers",
    ),
    "infinite time": ({"t": [1.0, np.inf, 2.0]}, None, "'t' "),
    "fractions after whole times": (
        {"t": [3.5, 4.5, 5.5]},
        None,
        "time column 't' holds double where",
    ),
    "dates after numbers": (
        {"t": np.array(["2026-01-01"] * 3, dtype="M8[s]")},
        None,
        "time column 't' holds timestamp",
    ),
}


@pytest.mark.parametrize("name", BAD)
def test_bad_tables_get_one_sentence_and_change_nothing(name):
    change, gone, words = BAD[name]
    columns = {n: v for n, v in (ROWS | change).items() if n != gone}
    fleet = new()
    if "other" in name or "after" in name or "such" in name:
        fleet.update(ROWS)
    before = fleet.to_arrow()
    with pytest.raises(fg.InvalidInput) as refused:
        fleet.update(pa.table(columns))
    assert words in str(refused.value) and "\n" not in str(refused.value)
    assert fleet.to_arrow().equals(before)
    fleet.update(ROWS)  # and it goes on


@pytest.mark.parametrize(
    "batch",
    [
        None,
        3,
        "rows.parquet",
        [1, 2],
        pd.DataFrame({"key": ["a", 1], "t": [1, 2], "x": [1.0, 2.0], "y": [1.0, 2.0]}),
        {"key": ["a"], "t": [1], "x": [1.0, 2.0], "y": [1.0]},
        pa.table([pa.array(["a"]), pa.array([1.0]), pa.array([1.0])], names=["key", "x", "x"]),
    ],
    ids=["nothing", "number", "name", "list", "mixed types", "ragged", "column twice"],
)
def test_what_is_no_table(batch):
    fleet = new(time=None)
    with pytest.raises(fg.InvalidInput) as refused:
        fleet.update(batch)
    assert "\n" not in str(refused.value) and len(fleet) == 0


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"phi": ()}, "phi is empty"),
        ({"phi": ["x", "x"]}, "each column once"),
        ({"phi": ["x", "y"]}, "and not y"),
        ({"phi": [3]}, "a column is 3"),
        ({"y": "key"}, "two roles"),
        ({"time": "key"}, "two roles"),
        ({"phi": ["x", "offset"], "offset": True}, "each name once"),
        ({"key": "status"}, "no name of an output"),
        ({"time": "error"}, "no name of an output"),
        ({"arx": (1, 2)}, "three whole numbers"),
        ({"arx": (1, 0, 0)}, "inputs go with nb"),
        ({"arx": (-1, 1, 0)}, "na is -1"),
        ({"model": "arx:na=1", "arx": (1, 1, 0)}, "allowed: one of them"),
        ({"model": "oe:nb=1,nf=1"}, "allowed: fir, ar and arx"),
        ({"model": "arx:na=x"}, "'na=x' is not an order"),
        ({"model": "arx:nb=1/2"}, "nb has 2 orders for 1 input"),
        ({"arx": (1, [1, 2], [0])}, "nk has 1 orders for 2 input"),
        ({"model": 3}, "model = 3, allowed"),
        ({"gap": "5min"}, "gap = 300"),
        ({"gap": "5min", "arx": (1, 1, 0)}, "with time and arx"),
        ({"gap": -1, "arx": (1, 1, 0), "time": "t"}, "gap = -1"),
        ({"gap": "far", "arx": (1, 1, 0), "time": "t"}, "no length of time"),
        ({"half_life": "1h"}, "half_life goes with time"),
        ({"half_life": "1h", "time": "t"}, "no rule"),
        ({"half_life": "1h", "time": "t", "rule": "none"}, "a rule with a forgetting factor"),
        ({"half_life": "soon", "time": "t", "rule": "exponential"}, "half_life"),
        ({"forgetting_factor": [0.9, 0.8]}, "one number for all streams"),
        ({"forgetting_factor": np.array([0.9])}, "one number for all streams"),
        ({"initial_covariance": -1.0}, "initial_covariance"),
        ({"initial_covariance": [[1.0, 2.0]], "phi": ["x", "z"]}, "initial_covariance"),
        ({"rule": "best"}, "rule = "),
    ],
)
def test_bad_fleets(arguments, words):
    with pytest.raises(fg.InvalidInput) as refused:
        TableFleet(**{"key": "key", "y": "y", "phi": "x", **arguments})
    assert words in str(refused.value)


def test_bad_outputs():
    fleet = new()
    with pytest.raises(fg.InvalidInput, match="outputs = 'gain', allowed: prediction"):
        fleet.update(ROWS, "gain")
    assert len(fleet) == 0
