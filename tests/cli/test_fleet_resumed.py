"""`forgetting fleet` goes on where it was stopped: no partition is taken twice, or half."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time

import pyarrow as pa
import pytest
from fleet_rows import DEVICES, FILES, MODEL, ROWS, part, streams_of, whole_fleet, whole_fleet_told
from pyarrow import feather, parquet

from forgetting.tables import TableFleet
from forgetting.tables.partitions import find
from forgetting.tables.resumable import Work


def test_a_run_that_is_stopped_goes_on(data, tmp_path):
    state = tmp_path / "f.arrow"

    def work() -> Work:
        fleet = TableFleet("device", "y", "u", time="t", offset=True)
        return Work(fleet, find([str(data)]), tmp_path / "out", state)

    for stop in range(FILES):

        def stopping(done: int, total: int, rate: float, stop: int = stop) -> None:
            if done > stop:
                raise KeyboardInterrupt

        if stop < FILES - 1:
            with pytest.raises(KeyboardInterrupt):
                work().run(stopping)
            assert [each.name for each in work().left] == [
                f"part{k}.parquet" for k in range(stop + 1, FILES)
            ]
            assert sorted(p.name for p in (tmp_path / "out").iterdir()) == [
                f"part{k}.parquet" for k in range(stop + 1)
            ]
        else:
            last = work()
            last.run()
            assert last.rows == ROWS
    assert streams_of(state) == whole_fleet().to_arrow().to_pylist()
    again = work()
    again.run()
    assert again.rows == 0 and len(again.fleet) == DEVICES


def test_a_run_that_is_killed_goes_on(tmp_path):
    """SIGKILL at any moment: no partition is taken twice, and no file is half."""
    data, state, out = tmp_path / "data", tmp_path / "f.arrow", tmp_path / "out"
    data.mkdir()
    for k in range(40):
        parquet.write_table(part(k, 200), data / f"{k:02d}.parquet")
    command = [sys.executable, "-m", "forgetting.cli", "fleet", str(data), *MODEL]
    command += ["--state", str(state), "--out", str(out)]
    for _ in range(3):
        size = len(list(out.iterdir())) if out.exists() else 0
        child = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        limit = time.monotonic() + 60
        while child.poll() is None and time.monotonic() < limit:
            if out.exists() and len(list(out.glob("*.parquet"))) > size + 3:
                os.kill(child.pid, signal.SIGKILL)
                break
            time.sleep(0.002)
        child.communicate(timeout=60)
    done = subprocess.run([*command, "--json"], capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout)["this_run"]["rows"] < 40 * 200
    fleet = TableFleet("device", "y", "u", time="t", offset=True)
    for k in range(40):
        told = fleet.update(part(k, 200))
        assert parquet.read_table(out / f"{k:02d}.parquet").to_pylist() == told.to_pylist()
    assert streams_of(state) == fleet.to_arrow().to_pylist()


DYING = """
import os, signal, sys
from pathlib import Path
from forgetting.tables import TableFleet, pages, state
from forgetting.tables.partitions import find
from forgetting.tables.resumable import Work

pages.PAGE = state.PAGE = 8  # several pages
whole, saves = state.parts, []

def dying(streams):
    saves.append(None)
    for count, part in enumerate(whole(streams)):
        yield part
        if len(saves) == 3 and count == 2:
            os.kill(os.getpid(), signal.SIGKILL)

state.parts = dying
fleet = TableFleet("device", "y", "u", time="t", offset=True)
Work(fleet, find([sys.argv[1]]), Path(sys.argv[2]), Path(sys.argv[3])).run()
"""


def test_a_run_that_is_killed_while_it_writes_its_state_goes_on(data, tmp_path):
    state, out = tmp_path / "f.arrow", tmp_path / "out"
    child = subprocess.run([sys.executable, "-c", DYING, str(data), str(out), str(state)])
    assert child.returncode == -signal.SIGKILL
    (half,) = tmp_path.glob(".f.*.arrow")  # what it was at
    with pytest.raises(pa.ArrowInvalid):
        feather.read_table(half)
    fleet = TableFleet("device", "y", "u", time="t", offset=True)
    again = Work(fleet, find([str(data)]), out, state)
    assert [each.name for each in again.left] == ["part2.parquet", "part3.parquet"]
    again.run()
    assert streams_of(state) == whole_fleet().to_arrow().to_pylist()
    told = whole_fleet_told()
    for k in range(FILES):
        assert parquet.read_table(out / f"part{k}.parquet").equals(told[k])


def test_new_partitions_are_taken_by_the_next_run(forgetting, data, tmp_path):
    late = data / "part3.parquet"
    aside = tmp_path / "part3.parquet"
    late.rename(aside)
    state = ("--state", tmp_path / "f.arrow")
    assert (
        json.loads(forgetting("fleet", data, *MODEL, *state, "--json").out)["totals"]["rows"]
        == 1800
    )
    aside.rename(late)
    told = json.loads(forgetting("fleet", data, *MODEL, *state, "--json").out)
    assert told["totals"]["rows"] == 2400 and told["this_run"]["rows"] == 600
    assert streams_of(tmp_path / "f.arrow") == whole_fleet().to_arrow().to_pylist()


def test_an_altered_state_is_named_and_the_others_go_on(forgetting, data, tmp_path):
    state = tmp_path / "f.arrow"
    first = str(data / "part[012].parquet")
    forgetting("fleet", first, *MODEL, "--state", state)
    table = feather.read_table(state)
    states = table.column("state").to_pylist()
    states[4] = states[4][:50] + bytes([states[4][50] ^ 1]) + states[4][51:]
    bad = table.column("key")[4].as_py()
    column = pa.array(states, pa.large_binary())
    feather.write_feather(table.set_column(1, "state", column), state)
    run = forgetting("fleet", data, *MODEL, "--state", state)
    assert run.code == 1 and bad in run.out and "altered" in run.out
    here = {row["key"]: row for row in streams_of(state)}
    expected = {row["key"]: row for row in whole_fleet().to_arrow().to_pylist()}
    assert here.pop(bad)["state"] == states[4] and expected.pop(bad)
    assert here == expected


def test_a_partition_with_a_bad_row_is_left_whole(forgetting, data, tmp_path):
    state = tmp_path / "f.arrow"
    rows = part(2).to_pydict()
    rows["device"][5] = None
    parquet.write_table(pa.table(rows), data / "part2.parquet")
    run = forgetting("fleet", data, *MODEL, "--state", state, "--out", tmp_path / "out")
    assert "part2.parquet: key column 'device' is missing in row 5" in run.sentence()
    assert sorted(p.name for p in (tmp_path / "out").iterdir()) == [
        "part0.parquet",
        "part1.parquet",
    ]
    parquet.write_table(part(2), data / "part2.parquet")
    forgetting("fleet", data, *MODEL, "--state", state)
    assert streams_of(state) == whole_fleet().to_arrow().to_pylist()
