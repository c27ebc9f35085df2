"""The time column: found, parsed, checked, and its gaps."""

from __future__ import annotations

import pandas as pd
import pytest

from forgetting.record import RecordError, identify, read


@pytest.mark.parametrize("name", ["time", "Time", "timestamp", "Date", "time_s", "time (s)"])
def test_time_is_found_by_name(csv, name):
    record = read(csv(f"x,{name}\n5,0\n6,0.5\n7,1\n"))
    assert record.clock is not None and record.clock.name == name
    assert record.clock.seconds().tolist() == [0.0, 0.5, 1.0]


def test_a_first_column_of_dates_is_time(csv):
    record = read(csv(",x\n2022-01-02 00:01:00,1\n2022-01-02 00:16:00,2\n"))
    assert record.clock is not None and record.clock.is_datetime
    assert record.clock.seconds().tolist() == [0.0, 900.0]


def test_mixed_time_zones_are_one_time(csv):
    record = read(csv("time,x\n2022-03-27T01:30:00+01:00,1\n2022-03-27T03:00:00+02:00,2\n"))
    assert record.clock is not None
    assert record.clock.seconds().tolist() == [0.0, 1800.0]


def test_without_time(csv):
    assert read(csv("timer,x\n3,1\n2,2\n")).clock is None


def test_named_time_that_is_none(csv):
    with pytest.raises(RecordError, match=r"'x' of record\.csv holds no times: row 2 is 'late'"):
        read(csv("x,y\n2022-01-01,1\nlate,2\n"), time="x")


def test_time_column_that_does_not_exist(csv):
    with pytest.raises(RecordError, match="no column 'clock'"):
        read(csv("x,y\n1,1\n"), time="clock")


@pytest.mark.parametrize(
    ("third", "words"), [("1", "1 repeated stamp"), ("0.5", "1 step back"), ("", "at a missing")]
)
def test_time_that_does_not_go_on_is_a_gap(csv, third, words):
    clock = read(csv(f"time,x\n0,1\n1,2\n{third},3\n2,4\n3,5\n")).clock
    assert clock is not None and words in clock.gaps()
    assert clock.segments()[1] < clock.segments()[2] and not clock.runs_forward


def test_gaps():
    frame = pd.DataFrame({"time": [0.0, 1.0, 2.0, 3.0, 4.6, 5.6, 7.1], "x": range(7)})
    clock = read(frame).clock
    assert clock is not None
    # 1.6 is more than 1.5 median steps; 1.5 itself is not.
    assert clock.segments().tolist() == [0, 0, 0, 0, 1, 1, 1]


def test_times_are_not_regressors(csv):
    path = csv("time,y\n2022-01-01,1\n2022-01-02,2\n2022-01-03,3\n")
    with pytest.raises(RecordError, match=r"column 'time' of record\.csv must hold numbers"):
        identify(path, formula="y ~ time")
