"""Small records of the kinds that people have, each with its right value.

The files lie beside the repository (or in FORGETTING_SHARED); without them these tests are skipped,
and `test_text.py` and `test_clock_kinds.py` hold others of the same kinds. Right values come from
the construction of the files, exact fractions or least squares.
"""

from __future__ import annotations

import json
import os
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from forgetting.cli import main
from forgetting.record import RecordError, identify, read

BESIDE = Path(__file__).parents[3] / "shared"
FOLDER = Path(os.environ.get("FORGETTING_SHARED", BESIDE)) / "cases"
WEAK = 1e10
"""An initial covariance that leaves a prior of 1e-10: the values below are right to 1e-6."""

RIGHT = [
    ("dummies.csv", "y ~ t + d1 + d2", {"t": 1.5}, 10),
    ("rank1.csv", "y ~ 0 + a + b + c", {"a": 1, "b": -1, "c": 2}, 4),
    ("dayfirst_clock_lost.csv", "y ~ 0 + lag(u)", {"lag(u)": 2}, 5),
    ("dayfirst_clock_swapped.csv", "y ~ 0 + lag(u)", {"lag(u)": 2}, 5),
    ("clock_name_not_known.csv", "y ~ 0 + lag(u)", {"lag(u)": 2}, 4),
    ("yyyymmdd.csv", "r ~ 0 + lag(mkt)", {"lag(mkt)": 2}, 5),
    ("step_boundary_same_second.csv", "V ~ I", {"Intercept": 1, "I": 2}, 4),
    ("two_experiments.csv", "y ~ u", {"Intercept": 1, "u": 2}, 6),
    ("time_of_day.csv", "y ~ u", {"Intercept": 1, "u": 2}, 4),
    ("elapsed_hms.csv", "y ~ u", {"Intercept": 1, "u": 2}, 20),
    ("date_and_time_columns.csv", "P ~ 0 + V:I", {"V:I": 0.001}, 10),
    ("question_mark.txt", "P ~ 0 + V:I", {"V:I": 0.001}, 4),
    ("decimal_comma.csv", "P ~ 0 + U:I", {"U:I": 1}, 4),
    ("trailing_separator.csv", "C ~ A + B", {"Intercept": 3, "A": 2, "B": 1}, 4),
    ("preamble.csv", "V ~ I", {"Intercept": 2, "I": 3}, 30),
    ("comment_lines.csv", "V ~ I", {"Intercept": 2, "I": 3}, 30),
    ("units_row.csv", "V ~ I", {"Intercept": 2, "I": 3}, 30),
    ("unused_name_twice.csv", "V ~ I", {"Intercept": 2, "I": 3}, 30),
    ("spaces.txt", "V ~ I", {"Intercept": 2, "I": 3}, 30),
    ("toa5.csv", "Uy ~ Ux", {"Intercept": 1, "Ux": 2}, 40),
    ("utf16.csv", "`Leistung [W]` ~ `Temp [°C]`", {"Intercept": 5, "Temp [°C]": 3}, 40),
    ("comma_in_names.csv", "`Spannung, V` ~ `Strom, A`", {"Intercept": 1, "Strom, A": 2}, 20),
    ("space_after_names.csv", "y ~ u", {"Intercept": 1, "u": 2}, 20),
]
LOOSE = {"question_mark.txt": 0.03, "toa5.csv": 0.01}
"""Where the data themselves are rounded."""


def needs(name: str) -> Path:
    path = FOLDER / name
    if not path.exists():
        pytest.skip("the cases are not beside the repository")
    return path


def options(name: str) -> dict[str, str]:
    return {"time": "elapsed time"} if name == "elapsed_hms.csv" else {}


@pytest.mark.parametrize(("name", "formula", "right", "used"), RIGHT, ids=[c[0] for c in RIGHT])
def test_the_right_value(name, formula, right, used, capsys):
    path = needs(name)
    weak = 1e6 if name in ("dummies.csv", "rank1.csv") else WEAK
    found = identify(path, formula=formula, rule="none", initial_covariance=weak, **options(name))
    table = found.parameters
    values = dict(zip(table["parameter"], table["value"], strict=True))
    for parameter, value in right.items():
        loose = LOOSE.get(name, 1e-5)
        assert values[parameter] == pytest.approx(value, rel=loose, abs=loose * 1e-3)
    assert found.used == used
    command = ["identify", str(path), "-f", formula, "-r", "none", "--json"]
    command += ["--initial-covariance", str(weak)]
    command += [word for key, given in options(name).items() for word in (f"--{key}", given)]
    assert main(command) == 0
    printed = json.loads(capsys.readouterr().out)
    assert {row["parameter"]: row["value"] for row in printed["parameters"]} == values
    assert printed["samples"]["used"] == used


@pytest.mark.parametrize(
    ("name", "clock", "cut"),
    [
        ("dayfirst_clock_lost.csv", "Date", 1),
        ("clock_name_not_known.csv", "Test Time / s", 1),
        ("yyyymmdd.csv", "date", 0),
    ],
)
def test_the_clock_is_told(name, clock, cut, capsys):
    path = needs(name)
    formula = "r ~ 0 + lag(mkt)" if name == "yyyymmdd.csv" else "y ~ 0 + lag(u)"
    found = identify(path, formula=formula)
    assert found.samples.clock is not None and found.samples.clock.name == clock
    assert found.samples.cut == cut
    assert main(["identify", str(path), "-f", formula]) == 0
    assert f"clock {clock!r}" in capsys.readouterr().out


def test_units_are_kept():
    units = read(needs("toa5.csv")).found.units
    assert units == {"Ux": "m/s", "Uy": "m/s", "Ts": "C", "press": "kPa"}
    assert read(needs("preamble.csv")).found.units == {"Time": "s", "I": "A", "V": "V"}


def test_durations_are_seconds():
    frame = pd.DataFrame({"elapsed": pd.to_timedelta([1, 2, 3, 4], "s"), "y": [3.0, 5, 7, 9]})
    found = identify(frame, formula="y ~ elapsed", rule="none", initial_covariance=1e8)
    assert found.parameters["value"].tolist() == pytest.approx([1, 2], rel=1e-6)
    assert found.samples.found.units == {"elapsed": "s"}


def test_an_index_of_durations_is_the_clock():
    index = pd.to_timedelta([0, 1, 2, 60, 61, 62], "s")
    frame = pd.DataFrame({"u": [1.0, 4, 2, 3, 5, 0], "y": [0.0, 2, 8, 99, 6, 10]}, index=index)
    found = identify(frame, formula="y ~ 0 + lag(u)", rule="none", initial_covariance=1e8)
    assert found.parameters["value"][0] == pytest.approx(2) and found.used == 4


def test_a_data_frame_with_a_name_twice():
    frame = pd.DataFrame(np.arange(12.0).reshape(4, 3), columns=["u", "y", "u"])
    with pytest.raises(RecordError, match="2 columns named 'u'"):
        identify(frame, formula="y ~ u")


def test_columns_named_by_numbers():
    rng = np.random.default_rng(0)
    u = rng.normal(size=50)
    frame = pd.DataFrame({0: u, 1: np.r_[0.0, 2 * u[:-1]]})
    found = identify(frame, output=1, input=0, arx=(0, 1, 1), rule="none", initial_covariance=1e9)
    values = dict(zip(found.parameters["parameter"], found.parameters["value"], strict=True))
    assert values["0(k-1)"] == pytest.approx(2)


def test_complex_numbers_are_refused():
    frame = pd.DataFrame({"u": [1 + 1j, 2, 3], "y": [1.0, 2, 3]})
    with pytest.raises(RecordError, match="column 'u' of record holds complex numbers"):
        identify(frame, formula="y ~ u")
