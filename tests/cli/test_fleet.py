"""`forgetting fleet`: partition by partition, resumable, with a report over all streams."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pyarrow as pa
import pytest
from pyarrow import csv, feather, parquet

import forgetting as fg
from forgetting.tables import TableFleet
from forgetting.tables.partitions import find
from forgetting.tables.resumable import Work

MODEL = ("--by", "device", "--time", "t", "--output", "y", "--input", "u")
DEVICES, ROWS, FILES = 30, 600, 4


def part(k: int, rows: int = ROWS) -> pa.Table:
    """Rows of partition k: y = 2 u + 1, one device with a slope of its own."""
    random = np.random.default_rng(k)
    device, u = random.integers(0, DEVICES, rows), random.normal(size=rows)
    y = np.where(device == 17, 9.0, 2.0 + 0.01 * device) * u + 1.0 + 0.1 * random.normal(size=rows)
    y[random.uniform(size=rows) < 0.02] = np.nan
    names = np.array([f"dev {d:02d}" for d in device])
    return pa.table({"device": names, "t": k * rows + random.permutation(rows), "u": u, "y": y})


@pytest.fixture
def data(tmp_path: Path) -> Path:
    """A folder of partitions."""
    folder = tmp_path / "data"
    folder.mkdir()
    for k in range(FILES):
        parquet.write_table(part(k), folder / f"part{k}.parquet", row_group_size=100)
    return folder


def whole_fleet() -> TableFleet:
    """What the command is to come to."""
    fleet = TableFleet("device", "y", "u", time="t", offset=True)
    for k in range(FILES):
        fleet.update(part(k))
    return fleet


def whole_fleet_told() -> list[pa.Table]:
    """What is told of each partition."""
    fleet = TableFleet("device", "y", "u", time="t", offset=True)
    return [fleet.update(part(k)) for k in range(FILES)]


def streams_of(path: Path) -> list[dict[str, object]]:
    return feather.read_table(path).to_pylist()


def test_a_linear_structure_is_arx(forgetting, data, tmp_path):
    streams = []
    for name, said in (("a", ("--arx", "1,2,0")), ("m", ("--model", "arx:na=1,nb=2,nk=0"))):
        path = tmp_path / f"{name}.parquet"
        assert forgetting("fleet", data, *MODEL, *said, "--streams", path).code == 0
        streams.append(parquet.read_table(path))
    assert streams[0].equals(streams[1])


@pytest.mark.parametrize(
    ("said", "words"),
    [
        (("--model", "armax:na=1,nb=1,nc=1"), "allowed: fir, ar and arx"),
        (("--model", "arx:na=1", "--arx", "1,1,1"), "allowed: one of them"),
        (("--model", "arx:nz=1"), "is not an order"),
        (("--model", "ar:na=1"), "inputs go with nb"),
    ],
)
def test_a_model_that_a_fleet_cannot_have_is_refused(forgetting, data, said, words):
    done = forgetting("fleet", data, *MODEL, *said)
    assert done.code == 2 and words in done.err


def test_rows_streams_and_report(forgetting, data, tmp_path):
    out, state, streams = tmp_path / "out", tmp_path / "f.arrow", tmp_path / "s.parquet"
    pattern = str(data / "*.parquet")
    run = forgetting(
        "fleet", pattern, *MODEL, "--out", out, "--state", state, "--streams", streams, "--json"
    )
    told, expected = json.loads(run.out), whole_fleet()
    assert (run.code, run.err) == (0, "")
    assert told["totals"]["rows"] == ROWS * FILES == told["this_run"]["rows"]
    assert told["totals"]["streams"] == DEVICES and told["totals"]["late"] == 0
    assert told["outliers"]["first"][0]["key"] == "dev 17"
    assert len(told["outliers"]["first"]) == told["outliers"]["streams"] < 4
    assert told["outliers"]["first"][0]["regressor"] == "u"
    assert streams_of(state) == expected.to_arrow().to_pylist()
    assert parquet.read_table(streams).equals(expected.estimates())
    fleet = TableFleet("device", "y", "u", time="t", offset=True)
    for k in range(FILES):
        rows = parquet.read_table(out / f"part{k}.parquet")
        assert rows.to_pylist() == fleet.update(part(k)).to_pylist()


def test_the_report_in_words(forgetting, data):
    run = forgetting("fleet", data, *MODEL)
    assert run.code == 0
    for words in (
        f"{DEVICES} streams",
        f"{ROWS * FILES}: ",
        "streams with |z| > 3.5",
        "dev 17",
        "Windup: no streams",
        "Late rows: no streams",
        "Missing rows: ",
    ):
        assert words in run.out
    assert max(map(len, run.out.splitlines())) < 120


def test_batches_of_any_size_and_files_of_any_kind(forgetting, data, tmp_path):
    mixed = tmp_path / "mixed"
    (mixed / "site=a").mkdir(parents=True)
    feather.write_feather(part(0), mixed / "site=a" / "0.arrow")
    csv.write_csv(part(1), mixed / "site=a" / "1.csv")
    parquet.write_table(part(2), mixed / "site=a" / "2.data")
    parquet.write_table(part(3), mixed / "site=a" / "3.parquet")
    sites = ("--by", "site", "--output", "y", "--input", "u")
    told = json.loads(forgetting("fleet", mixed, *sites, "--out", tmp_path / "o", "--json").out)
    assert told["totals"]["streams"] == 1 and told["totals"]["rows"] == 3 * ROWS
    names = [p.name for p in sorted((tmp_path / "o" / "site=a").iterdir())]
    assert names == ["0.arrow.parquet", "1.csv.parquet", "3.parquet"]
    expected = None
    for source, rows in ((f"{mixed}/*/*", 10**6), (str(data), 10**6), (str(data), 250)):
        run = forgetting("fleet", source, *MODEL, "--batch-rows", rows, "--json")
        assert run.code == 0, run.err
        totals = json.loads(run.out)["totals"]
        if rows == 10**6:
            expected = expected or totals
            assert totals == expected
        else:  # times are in any order within a partition: smaller batches make rows late
            assert totals["rows"] == expected["rows"] and totals["late"] > 0


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


def test_windup_is_named(forgetting, tmp_path):
    k = np.arange(1000)
    quiet = np.where((k % 2 == 0) & (k > 100), 0.0, np.sin(k))
    table = {"device": k % 2, "t": k, "u": quiet, "y": 2 * quiet}
    parquet.write_table(pa.table(table), tmp_path / "a.parquet")
    run = forgetting(
        "fleet", tmp_path, *MODEL, "--no-offset", "-r", "exponential", "-l", "0.9", "--json"
    )
    assert json.loads(run.out)["windup"] == [{"key": 0, "status": "windup"}]


def test_half_lives_by_the_clock_and_by_samples(forgetting, data, tmp_path):
    for half_life, more in (
        ("50", {"rule": fg.Exponential(half_life=50)}),
        ("50s", {"rule": "exponential", "half_life": "50s"}),
    ):
        state = tmp_path / f"{half_life}.arrow"
        forgetting(
            "fleet", data, *MODEL, "-r", "exponential", "--half-life", half_life, "--state", state
        )
        fleet = TableFleet("device", "y", "u", time="t", offset=True, **more)
        for k in range(FILES):
            fleet.update(part(k))
        assert streams_of(state) == fleet.to_arrow().to_pylist()


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("--by", "devices"), "part0.parquet has no column 'devices'; close are 'device'"),
        (("--output", "device"), "has two roles"),
        (("--output", "t"), "has two roles"),
        (("--input", "y"), "and not y"),
        (("--arx", "1,2"), "three whole numbers"),
        (("--tell", "gain"), "outputs = 'gain', allowed: prediction"),
        (("--batch-rows", "0"), "batch_rows = 0"),
        (("--streams", "s.csv"), "--streams writes .parquet"),
        (("--state", "no/such/f.arrow"), "there is no folder"),
        (("--half-life", "1h", "--forgetting-factor", "0.9"), "--half-life goes without"),
        (("--half-life", "soon"), "half_life"),
        (("--rule", "best"), "no rule 'best'"),
        (
            ("--rule", "auto", "--half-life", "1h"),
            "--half-life needs a rule with a forgetting factor",
        ),
        (("--rule", "auto", "--forgetting-factor", "0.9"), "the rule 'auto' has no parameters"),
    ],
)
def test_bad_use(forgetting, data, arguments, words):
    assert words in forgetting("fleet", data, *MODEL, *arguments).sentence()


def test_a_bank_each(forgetting, data, tmp_path):
    state = tmp_path / "f.arrow"
    run = forgetting("fleet", data, *MODEL, "--rule", "auto", "--state", state, "--json")
    assert run.code == 0, run.err
    told, expected = json.loads(run.out), fg.Bank(2)
    assert told["totals"]["status"] == {"ok": DEVICES, "windup": 0, "saturated": 0}
    assert told["outliers"]["first"][0]["key"] == "dev 17"
    rows = pa.concat_tables([part(k) for k in range(FILES)])
    own = rows.filter(pa.array([d == "dev 03" for d in rows.column("device").to_pylist()]))
    own = own.sort_by("t")
    phi = np.column_stack([own.column("u").to_numpy(), np.ones(len(own))])
    expected.run(phi, own.column("y").to_numpy(), missing="skip")
    assert TableFleet.load(state)["dev 03"].to_bytes() == expected.to_bytes()


def test_bad_files(forgetting, data, tmp_path):
    def refused(*arguments: object) -> str:
        return forgetting("fleet", *arguments, *MODEL).sentence()

    assert "there is no file" in refused(tmp_path / "nothing*.parquet")
    assert "write elsewhere" in refused(data, "--out", data)
    for option in ("--state", "--streams"):
        for path in (data / "part0.parquet", data / "new.parquet"):
            assert "is the record that is read" in refused(data, option, path)
        assert "is the record" in refused(data / "*.parquet", option, data / "part1.parquet")
    assert "are one file" in refused(data, "--state", "a.parquet", "--streams", "a.parquet")
    assert len(list(data.iterdir())) == FILES
    state = tmp_path / "f.arrow"
    forgetting("fleet", data / "part0.parquet", *MODEL, "--state", state)
    before = state.read_bytes()
    assert "of other columns or another rule" in refused(data, "--state", state, "--no-offset")
    assert "of other columns or another rule" in refused(data, "--state", state, "-r", "none")
    (data / "part1.parquet").write_bytes(b"PAR1 and nothing more")
    assert "part1.parquet" in refused(data, "--state", state, "--out", tmp_path / "out")
    assert state.read_bytes() == before
    parquet.write_table(part(7), data / "part0.parquet")
    assert "part0.parquet has changed since" in refused(data, "--state", state)
    state.write_text("something else")
    assert "is no state of a fleet" in refused(data, "--state", state)
    feather.write_feather(part(0), state)
    assert "is no state of a fleet" in refused(data, "--state", state)


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
