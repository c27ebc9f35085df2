"""Late, repeated, malformed and missing lines: counted, told, and never fatal."""

from __future__ import annotations

import numpy as np
import pytest

import forgetting as fg
from forgetting.stream import Settings, Stream
from forgetting.stream.tally import QUIET, Tally, Teller

from .conftest import arx, as_csv, command, fed, plant, rows

FIELDS = "row,time,error,theta,skipped"


def lines(samples: int = 200) -> list[bytes]:
    return as_csv(plant(samples)).splitlines(keepends=True)


BROKEN = [
    b"5.0,1.0\n",
    b"5.0,1.0,2.0,3.0\n",
    b"5.0,abc,2.0\n",
    b"5.0,inf,2.0\n",
    b"5.0,1_000,2.0\n",
    b"five,1.0,2.0\n",
    b"\x00\xff\xfe,1,2\n",
    b'5.0,"1.0,2.0\n',
    b"5.0,1e999,2.0\n",
]


@pytest.mark.parametrize("broken", BROKEN)
def test_a_malformed_line_is_a_row_of_missing_values(broken):
    """Lags do not see it, and everything after is as if its values had been missing."""
    given = lines()
    missing = fed(b"".join([*given[:51], b",,\n", *given[52:]]), arx(), FIELDS)
    stream = fed(b"".join([*given[:51], broken, *given[52:]]), arx(), FIELDS)
    told, expected = rows(stream.lines), rows(missing.lines)
    assert told[50]["skipped"] == "malformed" and expected[50]["skipped"] == "missing"
    assert told[50]["theta"] == told[49]["theta"]
    assert told[51:] == expected[51:]
    assert (stream.tally.rows, stream.tally.malformed) == (200, 1)
    assert stream.tally.used == missing.tally.used


def test_only_lines_at_fault_are_malformed():
    """However many there are among how many others."""
    given = lines(5000)
    places = np.random.default_rng(1).choice(np.arange(1, 5001), size=300, replace=False)
    for place in places:
        given[place] = b"garbage\n"
    stream = fed(b"".join(given), arx(time="none"), "row,skipped")
    found = [each["row"] for each in rows(stream.lines) if each["skipped"] == "malformed"]
    assert found == sorted(places.tolist())


def test_a_repeated_line_is_passed_over():
    """It is told, the estimate stays, and lags do not see it."""
    given = lines()
    plain = rows(fed(b"".join(given), arx(), FIELDS).lines)
    stream = fed(b"".join([*given[:81], given[80], *given[81:]]), arx(), FIELDS)
    told = rows(stream.lines)
    assert told[80] == plain[79] | {"row": 81, "error": None, "skipped": "repeated"}
    assert [each | {"row": 0} for each in told[81:]] == [each | {"row": 0} for each in plain[80:]]
    assert (stream.tally.repeated, stream.tally.gaps) == (1, 0)


def test_a_stamp_again_with_other_values_is_a_gap():
    given = lines()
    given[81] = given[80].rsplit(b",", 1)[0] + b",7.5\n"
    stream = fed(b"".join(given), arx(), FIELDS)
    assert (stream.tally.repeated, stream.tally.gaps, stream.tally.late) == (0, 2, 0)


def test_stamps_of_whole_seconds_in_a_fast_log_are_no_gaps():
    table = plant(300)
    table[:, 0] = np.floor(table[:, 0])
    table[100:120, 1:] = 1.0  # a standstill: equal lines that are no repetition
    stream = fed(as_csv(table), arx(), "skipped")
    found = [each["skipped"] for each in rows(stream.lines)]
    # Before the first stamp was repeated nothing tells that the clock is coarse.
    assert found[12:] == ["used"] * 288


def test_a_late_line_is_a_gap_and_counted():
    given = lines()
    given[80], given[81] = given[81], given[80]
    stream = fed(b"".join(given), arx(), FIELDS)
    assert stream.tally.late == 1
    told = rows(stream.lines)
    # 79 | 81 | 80 | 82: a step of two, one back, one of two; lags reach across none of them.
    assert [told[k]["skipped"] for k in (78, 79, 80, 81, 82)] == [
        "used", "missing", "missing", "missing", "used",
    ]  # fmt: skip


@pytest.mark.parametrize(("gap", "gaps"), [(None, 1), (0.05, 199), (60.0, 0), (np.inf, 0)])
def test_gaps_reset_lags(gap, gaps):
    table = plant(200)
    table[100:, 0] += 30
    stream = fed(as_csv(table), arx(gap=gap), FIELDS)
    assert stream.tally.gaps == gaps
    assert stream.tally.missing == 1 + gaps


def test_the_usual_step_follows_a_sensor_that_slows_down():
    """At first its steps are gaps; once they are the usual ones, they are none."""
    table = plant(600)
    table[200:, 0] = table[199, 0] + np.arange(1, 401) * 5.0
    stream = fed(as_csv(table), arx(), "skipped")
    found = [each["skipped"] for each in rows(stream.lines)]
    assert found[200:240] == ["missing"] * 40
    assert found[260:] == ["used"] * 340


def test_a_value_beyond_the_range_of_numbers_is_left_out():
    given = lines()
    given[50] = b"4.9,1e200,10.0\n"
    stream = fed(b"".join(given), arx(), FIELDS)
    told = rows(stream.lines)
    # u(k-1) is 1e200 one row later.
    assert [each["row"] for each in told if each["skipped"] == "out_of_range"] == [51]
    assert "exceeds the numerical range" in stream.example
    assert told[-1]["theta"]["u(k-1)"] == pytest.approx(0.5, abs=0.05)


@pytest.mark.parametrize("dtype", ["float64", "float32"])
def test_many_values_beyond_the_range(dtype):
    given = lines(3000)
    for k in range(1000, 2000, 2):
        given[k] = given[k].rsplit(b",", 1)[0] + b",-1e160\n"
    settings = Settings(output=("y",), input=("u",), dtype=dtype)
    stream = fed(b"".join(given), settings, "theta,skipped")
    assert stream.tally.out_of_range == 500
    assert stream.tally.used == 2500


def test_a_rule_that_winds_up_does_not_end_the_stream():
    table = np.column_stack([np.zeros(60_000), np.ones(60_000)])
    settings = Settings(
        output=("y",), input=("u",), offset=False, initial_covariance=1.0,
        rule=fg.Exponential(0.5),
    )  # fmt: skip
    stream = fed(as_csv(table, "u,y"), settings, "skipped")
    assert len(rows(stream.lines)) == 60_000


def test_nothing_but_rubbish_after_the_names():
    stream = fed(b"u,y\n1,2\n" + b"?!\n" * 100, Settings(output=("y",), input=("u",)))
    assert (stream.tally.rows, stream.tally.malformed, stream.tally.used) == (101, 100, 1)


def test_faults_are_told_at_the_end_and_the_first_at_once():
    given = lines(50)
    given[20], given[30] = b"garbage\n", b"1,2\n"
    done = command("-y", "y", "-u", "u", data=b"".join(given))
    first, last = done.stderr.decode().splitlines()
    assert done.returncode == 0
    assert first == ("forgetting: up to row 50: 2 malformed; 1 cells under 3 names: 'garbage'.")
    assert last == (
        "forgetting: 50 rows: 48 used, 2 malformed, 0 late, 0 repeated, 0 out of range, "
        "0 missing; 4 gaps."
    )


def test_telling_is_rare(monkeypatch):
    now = [1000.0]
    monkeypatch.setattr("forgetting.stream.tally.time.monotonic", lambda: now[0])
    said: list[str] = []
    teller = Teller(said.append)
    for k in range(1, 2001):
        now[0] += 0.01
        teller.look(Tally(rows=k, malformed=k), "example")
    # Two thousand faults in twenty seconds: the first, and what had come after QUIET of them.
    assert said[0] == "up to row 1: 1 malformed; example"
    assert len(said) == 1 + int(19.99 / QUIET)
    assert said[1].split(";")[0] in (
        f"up to row {k}: {k - 1} malformed"
        for k in (1001, 1002)  # rounding of the clock
    )


def test_nothing_waits_while_the_input_is_silent(started):
    """A line is answered before the next one comes."""
    process = started("-y", "y", "-u", "u", "--fields", "row")
    assert process.stdin and process.stdout
    process.stdin.write(b"u,y\n1,2\n")
    process.stdin.flush()
    assert process.stdout.readline() == b'{"row":1}\n'
    process.stdin.write(b"2,3\n4,")
    process.stdin.flush()
    assert process.stdout.readline() == b'{"row":2}\n'
    process.stdin.write(b"5\n")
    process.stdin.flush()
    assert process.stdout.readline() == b'{"row":3}\n'


def test_blocks_of_any_kind_end_in_lines():
    """A stream takes what is offered; a block without an end of line is a line."""
    stream = Stream(Settings(output=("y",), input=("u",)), fields="row")
    assert stream.feed(b"u,y").lines == []
    assert stream.feed(b"1,2").lines == [b'{"row":1}\n']


def test_differences_that_overflow_are_left_out():
    """Measured from the first sample, the second is beyond all numbers."""
    data = b"u,y\n1e308,1\n-1e308,2\n1e308,3\n"
    stream = fed(data, Settings(output=("y",), input=("u",)), "skipped")
    assert [each["skipped"] for each in rows(stream.lines)] == ["used", "out_of_range", "used"]


def test_an_input_without_lines_takes_no_memory_for_ever(monkeypatch):
    """Bytes that never end a line are a malformed line after a while."""
    monkeypatch.setattr("forgetting.stream.pump.LONGEST", 1000)
    monkeypatch.setattr("forgetting.stream.inputs.MOST", 4096)
    data = b"u,y\n1,2\n" + b"x" * 20_000 + b"\n3,4\n"
    done = command("-y", "y", "-u", "u", "--fields", "skipped", data=data)
    found = [each["skipped"] for each in rows(done.stdout.splitlines())]
    assert found[0] == found[-1] == "used"
    assert set(found[1:-1]) == {"malformed"} and len(found) < 8
