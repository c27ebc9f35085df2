"""Alarms: each once when it begins and once when it ends, in any units, in JSON and beside CSV."""

from __future__ import annotations

import json

import numpy as np
import pytest

import forgetting as fg
from forgetting.stream import Settings

from .conftest import as_csv, command, fed, objects

REGRESSION = dict(output=("y",), input=("u", "v"))


def alarms(data: bytes, **settings) -> list[dict]:
    stream = fed(data, Settings(**(REGRESSION | settings)))
    return [each for each in objects(stream.lines) if "alarm" in each]


def table(samples: int = 3000, seed: int = 0) -> np.ndarray:
    rng = np.random.default_rng(seed)
    u, v, noise = rng.normal(size=(3, samples))
    return np.column_stack([u, v, 1.0 + 2.0 * u - 3.0 * v + 0.1 * noise])


def csv(rows: np.ndarray) -> bytes:
    return as_csv(rows, "u,v,y")


def test_no_alarm_where_nothing_happens():
    assert [alarms(csv(table(20_000, seed))) for seed in range(3)] == [[], [], []]


@pytest.mark.parametrize("level", [0.0, 0.7, 20.0])
def test_an_input_that_stands_still(level):
    """From row 1001 to 2000 v is constant: neither it nor the constant can be told."""
    rows = table()
    rows[1000:2000, 2] -= 3.0 * (level - rows[1000:2000, 1])
    rows[1000:2000, 1] = level
    found = [each for each in alarms(csv(rows)) if each["alarm"] == "unexcited"]
    for name in ("v(k)", "offset"):
        begin, end = (each for each in found if each["parameter"] == name)
        assert (begin["state"], end["state"]) == ("begins", "ends")
        assert 1000 < begin["row"] <= 1300 and 2000 < end["row"] <= 2050
    assert {each["parameter"] for each in found} == {"v(k)", "offset"}


def test_two_inputs_that_go_together():
    rows = table(4000)
    rows[1000:3000, 2] -= 3.0 * (2.0 * rows[1000:3000, 0] - rows[1000:3000, 1])
    rows[1000:3000, 1] = 2.0 * rows[1000:3000, 0]
    found = alarms(csv(rows))
    assert {each["parameter"] for each in found} == {"u(k)", "v(k)"}
    assert [each["state"] for each in found] == ["begins", "begins", "ends", "ends"]


def test_a_change():
    rows = table()
    rows[1500:, 2] += 5.0 * rows[1500:, 0]
    found = alarms(csv(rows))
    assert [(each["alarm"], each["state"]) for each in found] == [
        ("change", "begins"),
        ("change", "ends"),
    ]
    assert 1500 < found[0]["row"] < 1520 and found[1]["row"] > found[0]["row"] + 100


def test_windup_of_a_rule_without_bounds():
    rows = table(2000)
    rows[500:1500, :2] = 0.0
    rule = dict(rule=fg.Exponential(0.95), initial_covariance=100.0, offset=False)
    found = [each for each in alarms(csv(rows), **rule) if each["alarm"] == "windup"]
    assert [each["state"] for each in found] == ["begins", "ends"]
    assert 500 < found[0]["row"] < 700 and 1500 < found[1]["row"] < 1600
    assert [each for each in alarms(csv(rows)) if each["alarm"] == "windup"] == []


@pytest.mark.parametrize("factors", [(1e6, 1.0, 1.0), (1.0, 1e-9, 1e4), (1e-3, 1e3, 1e-6)])
def test_units_change_no_alarm(factors):
    rows = table()
    rows[1000:2000, 1] = 0.7
    rows[2500:, 2] += 5.0 * rows[2500:, 0]
    assert alarms(csv(rows * factors)) == alarms(csv(rows)) != []


def test_grouping_changes_no_alarm():
    rows = table()
    rows[1000:2000, 1] = 0.7
    data = csv(rows)
    from forgetting.stream import Stream

    stream = Stream(Settings(**REGRESSION))
    lines = [line for each in data.splitlines(keepends=True) for line in stream.feed(each).lines]
    assert lines == fed(data, Settings(**REGRESSION)).lines


def test_an_alarm_stands_behind_its_row():
    rows = table()
    rows[1500:, 2] += 5.0 * rows[1500:, 0]
    told = objects(fed(csv(rows), Settings(**REGRESSION)).lines)
    place = next(k for k, each in enumerate(told) if "alarm" in each)
    assert told[place - 1]["row"] == told[place]["row"]
    assert [each["row"] for each in told if "alarm" not in each] == list(range(1, 3001))


def test_alarms_of_csv_go_to_stderr():
    rows = table()
    rows[1500:, 2] += 5.0 * rows[1500:, 0]
    done = command("-y", "y", "-u", "u,v", "--to", "csv", data=csv(rows))
    assert done.stdout.count(b"\n") == 3001
    said = done.stderr.decode().splitlines()
    assert said[0].startswith("forgetting: alarm: change begins at row 15")
    assert said[1].startswith("forgetting: alarm: change ends at row 1")


def test_two_outputs_are_watched_together():
    rows = table()
    both = np.column_stack([rows, rows[:, 2] + 1.0 + 0.1 * np.cos(np.arange(3000))])
    both[1500:, 3] += 5.0 * both[1500:, 0]
    stream = fed(as_csv(both, "u,v,y,z"), Settings(output=("y", "z"), input=("u", "v")))
    kinds = [json.loads(line)["alarm"] for line in stream.lines if b'"alarm"' in line]
    assert kinds[:1] == ["change"]
