"""`forgetting stream --model`: structures whose noise is coloured, line by line."""

from __future__ import annotations

import json

import numpy as np
import pytest

import forgetting as fg
from forgetting.stream import Settings, Stream
from forgetting.stream.state import check_settings
from forgetting.words.errors import RecordError

from .conftest import PLANT, as_csv, command, fed, plant, rows

SAID = ("--output", "y", "--input", "u")
ARMAX = Settings(output=("y",), input=("u",), model="armax:na=1,nb=1,nc=1,nk=1")


def test_a_linear_structure_is_arx_and_goes_on_from_its_state(tmp_path):
    given = as_csv(plant(120)).splitlines(keepends=True)
    by_model = (*SAID, "--model", "arx:na=1,nb=1,nk=1")
    whole = command(*PLANT, data=b"".join(given)).stdout
    assert command(*by_model, data=b"".join(given)).stdout == whole
    state = tmp_path / "state"
    first = command(*PLANT, "--state", state, data=b"".join(given[:60]))
    second = command(*by_model, "--state", state, data=b"".join(given))
    assert first.stdout + second.stdout == whole


def test_the_command_goes_on(tmp_path):
    given = as_csv(plant(200)).splitlines(keepends=True)
    said = (*SAID, "--model", ARMAX.model)
    first = command(*said, "--state", tmp_path / "s", data=b"".join(given[:90]))
    second = command(*said, "--state", tmp_path / "s", data=b"".join(given))
    assert first.stdout + second.stdout == command(*said, data=b"".join(given)).stdout
    other = command(*SAID, "--model", "oe:nb=1,nf=1,nk=1", "--state", tmp_path / "s")
    assert other.returncode == 2
    assert "made with model 'armax:na=1,nb=1,nc=1,nk=1', and now" in other.stderr.decode()
    assert command(*PLANT, "--state", tmp_path / "s").returncode == 2


def test_a_state_of_before_there_were_models_goes_on(tmp_path):
    now = Settings(output=("y",), input=("u",), arx=(1, 1, 1)).as_data()
    before = {name: text for name, text in now.items() if name != "model"}
    check_settings(tmp_path, before, now)
    with pytest.raises(RecordError, match="made with model None"):
        check_settings(tmp_path, before, ARMAX.as_data() | {"arx": now["arx"]})


@pytest.mark.parametrize("dtype", ["float64", "float32"])
def test_a_line_beyond_the_range_of_numbers_is_left_out(dtype):
    table = plant(300)
    given = as_csv(table).splitlines(keepends=True)
    settings = Settings(output=ARMAX.output, input=ARMAX.input, model=ARMAX.model, dtype=dtype)
    broken = [*given[:101], b"10.0,1.0,1e300\n", *given[102:]]
    stream = fed(b"".join(broken), settings, "row,skipped,error,theta")
    told = rows(stream.lines)
    assert told[100]["skipped"] == "out_of_range"
    assert stream.tally.out_of_range == 1
    missing = [*given[:101], b"10.0,,\n", *given[102:]]
    plain = rows(fed(b"".join(missing), settings, "row,skipped,error,theta").lines)
    assert told[101:] == plain[101:]
    assert told[100]["theta"] == told[99]["theta"]
    piece = Stream(settings, fields="row,skipped,error,theta")
    parts = [line for each in broken for line in piece.feed(each).lines]
    assert parts == stream.lines


def test_repeated_lines_bring_nothing():
    given = as_csv(plant(100)).splitlines(keepends=True)
    plain = rows(fed(b"".join(given), ARMAX).lines)
    again = fed(b"".join([*given[:51], given[50], given[50], *given[51:]]), ARMAX)
    told = rows(again.lines)
    assert [each["skipped"] for each in told[50:52]] == ["repeated"] * 2
    assert told[50]["theta"] == told[49]["theta"] == told[51]["theta"]
    left = [{**each, "row": None} for each in told[:50] + told[52:]]
    assert left == [{**each, "row": None} for each in plain]
    one = Stream(ARMAX)
    lines = [line for each in given[:51] + [given[50]] * 2 for line in one.feed(each).lines]
    assert rows(lines) == told[:52]


def test_the_class_tells_the_same():
    table = plant(400)
    told = rows(fed(as_csv(table), ARMAX, "theta,error").lines)
    course = fg.ARMAX(offset=True).course(table[:, 1], table[:, 2], ("theta", "error"))
    assert [list(each["theta"].values()) for each in told] == course["theta"].tolist()
    error = [np.nan if each["error"] is None else each["error"] for each in told]
    assert np.array_equal(error, course["error"], equal_nan=True)


@pytest.mark.parametrize(
    ("said", "words"),
    [
        ((*SAID, "--model", "armax:nq=1"), "'nq=1' is not an order"),
        ((*PLANT, "--model", "armax:na=1"), "say the model once"),
        ((*SAID, "--model", "oe:nb=1", "--half-life", "5"), "forgets by samples"),
        ((*SAID, "--output", "t_s", "--model", "oe:nb=1"), "has one output; 2 columns"),
        (("--output", "y", "--model", "oe:nb=1"), "nb = 0 goes with u = None"),
        (("--output", "y", "--input", "x", "--model", "oe:nb=1"), "x"),
    ],
)
def test_what_is_wrong_is_said_in_one_sentence(said, words):
    done = command(*said, data=as_csv(plant(30)))
    assert (done.returncode, done.stdout) == (2, b"")
    assert words in done.stderr.decode() and done.stderr.count(b"\n") == 1


def test_alarms_look_at_the_regressors_of_the_model():
    table = plant(1500)
    table[700:, 2] += 5.0
    stream = fed(as_csv(table), ARMAX)
    alarms = [json.loads(line) for line in stream.lines if b'"alarm"' in line]
    assert any(each["alarm"] == "change" and each["row"] >= 700 for each in alarms)
