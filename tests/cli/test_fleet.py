"""`forgetting fleet`: partition by partition, with a report over all streams."""

from __future__ import annotations

import json

import numpy as np
import pyarrow as pa
from fleet_rows import DEVICES, FILES, MODEL, ROWS, part, streams_of, whole_fleet
from pyarrow import csv, feather, parquet

import forgetting as fg
from forgetting.tables import TableFleet


def test_a_linear_structure_is_arx(forgetting, data, tmp_path):
    streams = []
    for name, said in (("a", ("--arx", "1,2,0")), ("m", ("--model", "arx:na=1,nb=2,nk=0"))):
        path = tmp_path / f"{name}.parquet"
        assert forgetting("fleet", data, *MODEL, *said, "--streams", path).code == 0
        streams.append(parquet.read_table(path))
    assert streams[0].equals(streams[1])


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
