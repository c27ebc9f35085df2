"""`--follow`: a file that grows, is renamed and begun anew, or cut, as by log rotation."""

from __future__ import annotations

import os
import select
import signal
import time
from pathlib import Path

import pytest

from forgetting.stream import Settings
from forgetting.stream.inputs import File

from .conftest import PLANT, as_csv, command, fed, plant

PATIENCE = 30.0
SETTINGS = Settings(output=("y",), input=("u",), arx=(1, 1, 1))


class Log:
    """What a sensor writes."""

    def __init__(self, folder: Path, samples: int = 600) -> None:
        self.path = folder / "sensor.csv"
        self.given = as_csv(plant(samples)).splitlines(keepends=True)

    def begin(self, start: int, stop: int) -> None:
        """A new file, with the names above."""
        self.path.write_bytes(self.given[0] + self.part(start, stop))

    def append(self, start: int, stop: int) -> None:
        with self.path.open("ab") as file:
            file.write(self.part(start, stop))

    def part(self, start: int, stop: int) -> bytes:
        """Rows, counted from 1."""
        return b"".join(self.given[start : stop + 1])

    def expected(self, stop: int) -> list[bytes]:
        return fed(b"".join(self.given[: stop + 1]), SETTINGS).lines


@pytest.fixture
def log(tmp_path: Path) -> Log:
    return Log(tmp_path)


class Follower:
    """The command at work: its lines, as many as are waited for."""

    def __init__(self, process) -> None:
        self.process = process
        self.rest = b""
        self.told: list[bytes] = []

    def until(self, rows: int) -> list[bytes]:
        """All that was told once so many lines were."""
        deadline = time.monotonic() + PATIENCE
        while len(self.told) < rows:
            rest = deadline - time.monotonic()
            assert rest > 0, self.told[-1:]
            if not select.select([self.process.stdout], [], [], rest)[0]:
                continue
            data = os.read(self.process.stdout.fileno(), 1 << 16)
            assert data, self.process.stderr.read()
            *whole, self.rest = (self.rest + data).split(b"\n")
            self.told += [line + b"\n" for line in whole]
        return self.told

    def stop(self) -> str:
        self.process.send_signal(signal.SIGTERM)
        assert self.process.wait(PATIENCE) == 0
        return self.process.stderr.read().decode()


@pytest.fixture
def follower(started, log):
    return lambda *more: Follower(started(log.path, "--follow", *PLANT, *more))


def test_grows(log, follower):
    log.begin(1, 100)
    at_work = follower()
    at_work.until(100)
    for start in range(101, 201, 9):
        log.append(start, min(start + 8, 200))
    assert at_work.until(200) == log.expected(200)
    assert "200 rows: 199 used" in at_work.stop()


def test_half_a_line_waits_for_its_end(log, follower):
    log.begin(1, 10)
    at_work = follower()
    at_work.until(10)
    line = log.part(11, 11)
    with log.path.open("ab") as file:
        file.write(line[:5])
        file.flush()
        time.sleep(0.6)
        file.write(line[5:] + log.part(12, 12))
    assert at_work.until(12) == log.expected(12)


def test_renamed_and_begun_anew(log, follower):
    """The old file is read to its end, then the new one from its beginning."""
    log.begin(1, 100)
    at_work = follower()
    at_work.until(100)
    old = log.path.rename(log.path.with_suffix(".1"))
    with old.open("ab") as file:
        file.write(log.part(101, 150))
    log.begin(151, 200)
    at_work.until(200)
    log.append(201, 210)
    assert at_work.until(210) == log.expected(210)


def test_cut_and_written_again(log, follower):
    log.begin(1, 100)
    at_work = follower()
    at_work.until(100)
    os.truncate(log.path, 0)
    time.sleep(0.6)
    log.append(0, 0)
    log.append(101, 130)
    assert at_work.until(130) == log.expected(130)


def test_comes_into_being(log, follower):
    at_work = follower()
    time.sleep(1.5)
    log.begin(1, 50)
    assert at_work.until(50) == log.expected(50)


def test_rotated_while_nobody_followed(tmp_path, log, follower):
    """The rest of the old file is found under its new name, and read first."""
    state = ("--state", tmp_path / "state")
    log.begin(1, 100)
    first = follower(*state)
    told = list(first.until(100))
    first.stop()
    log.append(101, 140)
    log.path.rename(tmp_path / "sensor.csv.1")
    log.begin(141, 180)
    second = follower(*state)
    assert told + second.until(80) == log.expected(180)
    assert "goes on after row 100" in second.stop()


def test_a_rotated_file_without_following(tmp_path, log):
    state = ("--state", tmp_path / "state")
    log.begin(1, 100)
    told = command(log.path, *PLANT, *state).stdout
    log.append(101, 140)
    log.path.rename(tmp_path / "sensor.csv.1")
    log.begin(141, 180)
    told += command(log.path, *PLANT, *state).stdout
    assert told == b"".join(log.expected(180))


def test_another_file_is_said_to_be_one(tmp_path, log):
    state = ("--state", tmp_path / "state")
    log.begin(1, 100)
    told = command(log.path, *PLANT, *state).stdout
    log.path.unlink()
    (tmp_path / "padding").write_bytes(b"")  # so that the next file is another one
    log.begin(101, 180)
    done = command(log.path, *PLANT, *state)
    assert told + done.stdout == b"".join(log.expected(180))
    assert "the file is another than that of the state" in done.stderr.decode()


def test_a_file_that_is_replaced_before_it_holds_a_row():
    stream = fed(b"t_s,u,y\n", SETTINGS)
    stream.further_input()
    assert len(stream.feed(as_csv(plant(20))).lines) == 20


def test_a_file_with_other_columns_is_refused(log):
    log.begin(1, 20)
    source = File(log.path, follow=False)
    stream = fed(log.given[0] + log.part(1, 20), SETTINGS)
    stream.further_input()
    with pytest.raises(ValueError, match="the columns so far are"):
        stream.feed(b"t_s,y,u\n1,2,3\n")
    source.close()


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("--follow",), "--follow needs a file"),
        (("nowhere.csv",), "there is no file nowhere.csv"),
        (("/dev/null",), "/dev/null is no file on a disk"),
        (("tests",), "tests is a folder"),
        (("--to", "xml"), "--to is 'xml'"),
        (("--save-every", "0"), "--save-every is 0"),
        (("--separator", "::"), "--separator is '::'"),
        (("--gap", "-1"), "gap is '-1'"),
        (("--rule", "subspce"), "close are 'subspace'"),
        (("--dtype", "int8"), "--dtype is 'int8'"),
        (("--state", "/nowhere/state"), "there is no folder"),
    ],
)
def test_refusals(arguments, words):
    done = command(*arguments, *PLANT)
    said = done.stderr.decode()
    assert (done.returncode, done.stdout) == (2, b"")
    assert words in said and said.count("\n") == 1


def test_lines_that_end_with_a_carriage_return_alone_are_refused():
    stream = fed(b"", SETTINGS)
    with pytest.raises(ValueError, match="end them with a line feed"):
        stream.feed(b"t,u,y\r1,2,3\r4,5,6\r\n")


def test_a_value_beyond_all_range_warns_of_nothing():
    given = "u,y\n1,1e300\n2,-1e300\n1e300,3\n"
    done = command("-f", "y ~ u", data=given.encode())
    assert done.returncode == 0 and b"Warning" not in done.stderr
    assert b"2 out of range" in done.stderr
