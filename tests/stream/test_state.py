"""`--state`: a stream goes on bit for bit, from the very line, and only from its own state."""

from __future__ import annotations

import json
import signal
import time
from pathlib import Path

import numpy as np
import pytest

import forgetting as fg
from forgetting.stream import Settings, Stream
from forgetting.stream.position import Position, Replay
from forgetting.stream.state import load, save
from forgetting.words.errors import RecordError

from .conftest import PLANT, as_csv, command, fed, objects, plant

ALL = {
    "bank": Settings(output=("y",), input=("u",), arx=(2, 2, 1)),
    "rule": Settings(output=("y",), input=("u",), arx=(1, 1, 0), rule=fg.Subspace(0.98)),
    "by the clock": Settings(
        output=("y",), input=("u",), rule="subspace", half_life="5s", arx=(1, 1, 0)
    ),
    "outputs": Settings(output=("y", "u"), arx=(1, 0, 0), dtype="float32"),
    "structure": Settings(output=("y",), input=("u",), model="armax:na=1,nb=2,nc=1,nk=1"),
    "structure and rule": Settings(
        output=("y",), input=("u",), model="bj:nb=1,nc=1,nd=1,nf=1,nk=1", rule=fg.Subspace(0.98)
    ),
    "formula": Settings(formula="y ~ lag(y) + lag(lag(u), 2)"),
    "no clock": Settings(output=("y",), input=("u",), time="none", gate="dead_zone"),
}


def troubled() -> list[bytes]:
    """Lines with a gap, a repeated and a late line, rubbish, a change and a standstill."""
    table = plant(1500)
    table[400:, 0] += 9.0
    table[700:, 2] += 3.0
    table[1000:1300, 1] = 0.5
    given = as_csv(table).splitlines(keepends=True)
    given[200], given[201] = given[201], given[200]
    given[300] = b"rubbish\n"
    given.insert(350, given[349])
    return given


@pytest.mark.parametrize("settings", ALL.values(), ids=ALL)
def test_goes_on_bit_for_bit(tmp_path, settings):
    """Whatever the line at which it was saved, through the file."""
    given = troubled()
    whole = fed(b"".join(given), settings)
    for place in (2, 3, 200, 201, 301, 350, 351, 402, 777, 1150, 1499):
        first = fed(b"".join(given[:place]), settings)
        save(tmp_path / "state", first.state())
        second = Stream(settings)
        second.restore(load(tmp_path / "state"))
        rest = second.feed(b"".join(given[place:])).lines
        assert first.lines + rest == whole.lines
        assert json.dumps(second.state()) == json.dumps(whole.state())


def test_the_command_goes_on(tmp_path):
    """The same input again from its beginning: what was told is not told again."""
    given = troubled()
    arguments = (*PLANT, "--state", tmp_path / "state")
    whole = fed(b"".join(given), Settings(output=("y",), input=("u",), arx=(1, 1, 1))).lines
    first = command(*arguments, data=b"".join(given[:800]))
    again = command(*arguments, data=b"".join(given))
    assert first.stdout + again.stdout == b"".join(whole)
    assert f"goes on after row 799 of {tmp_path / 'state'}" in again.stderr.decode()
    nothing = command(*arguments, data=b"".join(given))
    assert nothing.stdout == b""
    assert nothing.stderr.decode().splitlines()[-1].startswith("forgetting: 1501 rows: ")


def test_lines_that_are_offered_once_go_on(tmp_path):
    """A pipe that does not begin again: its lines are new, with or without the names above."""
    given = troubled()
    arguments = (*PLANT, "--state", tmp_path / "state")
    whole = fed(b"".join(given), Settings(output=("y",), input=("u",), arx=(1, 1, 1))).lines
    told = command(*arguments, data=b"".join(given[:500])).stdout
    second = command(*arguments, data=b"".join([given[0], *given[500:900]]))
    told += second.stdout + command(*arguments, data=b"".join(given[900:])).stdout
    assert told == b"".join(whole)
    assert "its lines are new" in second.stderr.decode()


def test_csv_has_its_names_once(tmp_path):
    given = troubled()
    arguments = (*PLANT, "--to", "csv", "--state", tmp_path / "state")
    first, second = (command(*arguments, data=b"".join(given[:k])).stdout for k in (300, 1502))
    assert (first + second).count(b"row,") == 1
    assert len((first + second).splitlines()) == 1502


def test_an_input_that_was_changed_before_the_position_is_refused(tmp_path):
    given = as_csv(plant(2000)).splitlines(keepends=True)
    arguments = (*PLANT, "--state", tmp_path / "state")
    command(*arguments, data=b"".join(given[:1500]))
    saved = (tmp_path / "state").read_bytes()
    given[1000] = given[1000].replace(b"1", b"2")
    done = command(*arguments, data=b"".join(given))
    assert (done.returncode, done.stdout) == (2, b"")
    assert "differs from it" in done.stderr.decode()
    assert (tmp_path / "state").read_bytes() == saved


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (("--rule", "subspace"), "rule 'auto', and now it is Subspace"),
        (("--no-offset",), "offset True, and now it is False"),
        (("--arx", "2,1,1"), "arx [1, 1, 1], and now it is [2, 1, 1]"),
        (("--gap", "5"), "gap None, and now it is 5.0"),
        (("--output", "u"), "output ['y'], and now it is ['y', 'u']"),
        (("--initial-covariance", "10"), "initial_covariance None, and now it is 10.0"),
    ],
)
def test_other_settings_are_refused(tmp_path, change, words):
    data = as_csv(plant(50))
    state = tmp_path / "state"
    command(*PLANT, "--state", state, data=data)
    saved = state.read_bytes()
    done = command(*PLANT, "--state", state, *change, data=data)
    assert done.returncode == 2 and done.stdout == b""
    assert words in done.stderr.decode() and done.stderr.count(b"\n") == 1
    assert state.read_bytes() == saved


def test_other_columns_are_refused(tmp_path):
    state = tmp_path / "state"
    command(*PLANT, "--state", state, data=as_csv(plant(50)))
    done = command(*PLANT, "--state", state, data=as_csv(plant(50), "t_s,y,u"))
    assert done.returncode == 2
    assert "the columns so far are 't_s', 'u', 'y'" in done.stderr.decode()


def test_fields_and_form_of_output_may_change(tmp_path):
    """They are no part of what the next line needs."""
    given = as_csv(plant(100)).splitlines(keepends=True)
    state = tmp_path / "state"
    command(*PLANT, "--state", state, data=b"".join(given[:50]))
    done = command(*PLANT, "--state", state, "--fields", "row", data=b"".join(given))
    assert done.stdout.splitlines() == [b'{"row":%d}' % k for k in range(50, 101)]


def test_any_altered_byte_is_refused(tmp_path):
    save(tmp_path / "state", fed(as_csv(plant(20)), ALL["rule"]).state())
    good = (tmp_path / "state").read_bytes()
    rng = np.random.default_rng(0)
    for place in [0, 5, 40, *rng.integers(0, len(good) - 1, size=40).tolist()]:
        bad = bytearray(good)
        bad[place] ^= 1
        (tmp_path / "state").write_bytes(bytes(bad))
        with pytest.raises(RecordError, match=r"altered|no state"):
            load(tmp_path / "state")


@pytest.mark.parametrize("content", [b"", b"hello\n", b"\xff\xfe\n", b"t,u,y\n1,2,3\n"])
def test_what_is_no_state_is_refused_and_left_alone(tmp_path, content):
    path = tmp_path / "notes.txt"
    path.write_bytes(content)
    done = command(*PLANT, "--state", path, data=as_csv(plant(20)))
    assert done.returncode == 2 and "no state of a stream" in done.stderr.decode()
    assert path.read_bytes() == content


def test_the_state_is_not_the_record(tmp_path):
    path = tmp_path / "plant.csv"
    path.write_bytes(as_csv(plant(20)))
    done = command(path, *PLANT, "--state", path)
    assert done.returncode == 2 and "is the record that is read" in done.stderr.decode()


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT])
def test_a_signal_saves_and_ends(tmp_path, started, number):
    """No line is lost or told twice, half a line included."""
    given = as_csv(plant(400)).splitlines(keepends=True)
    state = tmp_path / "state"
    process = started(*PLANT, "--state", state, "--save-every", "1000000")
    assert process.stdin and process.stdout and process.stderr
    process.stdin.write(b"".join(given[:201]) + given[201][:7])
    process.stdin.flush()
    told = [process.stdout.readline() for _ in range(200)]
    process.send_signal(number)
    assert process.wait(30) == 0
    assert "goes on" not in process.stderr.read().decode()
    second = command(*PLANT, "--state", state, data=b"".join(given))
    settings = Settings(output=("y",), input=("u",), arx=(1, 1, 1))
    assert b"".join(told) + second.stdout == b"".join(fed(b"".join(given), settings).lines)


def test_the_state_keeps_up_while_lines_come_slowly(tmp_path, started):
    """Also when there are fewer than --save-every of them, and the input then is silent."""
    state = tmp_path / "state"
    process = started(*PLANT, "--state", state, "--save-every", "1000")
    assert process.stdin
    process.stdin.write(as_csv(plant(10)))
    process.stdin.flush()
    deadline = time.monotonic() + 30
    while not state.exists() and time.monotonic() < deadline:
        time.sleep(0.1)
    assert rows_in(state) == 10


def rows_in(state: Path) -> int:
    return int(json.loads(state.read_text().partition("\n")[2])["tally"]["rows"])


def test_a_reader_that_leaves_loses_nothing(tmp_path):
    """What was not delivered is not in the state."""
    import subprocess

    from .conftest import COMMAND

    path, state = tmp_path / "plant.csv", tmp_path / "state"
    path.write_bytes(as_csv(plant(30_000)))
    words = [*COMMAND, str(path), *PLANT, "--state", str(state)]
    done = subprocess.run(
        ["sh", "-c", f"{' '.join(words)} | head -3"], capture_output=True, timeout=60
    )
    assert done.stdout.count(b"\n") == 3 and b"Traceback" not in done.stderr
    assert not state.exists() or rows_in(state) < 30_000


def test_replay_byte_by_byte():
    """However the bytes come, what is new begins at the position."""
    data = as_csv(plant(300))
    before = Position()
    before.advance(data[:9000])
    for size in (1, 7, 4096, 10**6):
        replay = Replay(before)
        chunks = [data[k : k + size] for k in range(0, len(data), size)]
        assert b"".join(replay.new(chunk) for chunk in chunks) == data[9000:]
    other = Replay(before)
    changed = b"t_s,u,y\n9.0,1,2\n"
    assert b"".join(other.new(changed[k : k + 1]) for k in range(len(changed))) == changed


def test_a_line_is_torn_where_the_process_was_killed(tmp_path):
    """The next process ends it, so that its own first line is whole."""
    given = as_csv(plant(100)).splitlines(keepends=True)
    state, out = tmp_path / "state", tmp_path / "out.jsonl"
    out.write_bytes(command(*PLANT, "--state", state, data=b"".join(given[:51])).stdout + b'{"ro')
    import subprocess

    from .conftest import COMMAND

    with out.open("ab") as stream:
        subprocess.run(
            [*COMMAND, *PLANT, "--state", str(state)], input=b"".join(given), stdout=stream,
            stderr=subprocess.DEVNULL, timeout=60, check=True,
        )  # fmt: skip
    lines = out.read_bytes().splitlines()
    assert lines[50] == b'{"ro'
    told = objects(lines[:50] + lines[51:])
    assert [each["row"] for each in told] == list(range(1, 101))
