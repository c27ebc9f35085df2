"""A long record is never there twice; what is done piece by piece is what is done at once."""

from __future__ import annotations

import gc
import json
import tracemalloc
from importlib import import_module
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

import forgetting as fg
from forgetting.cli.app import run
from forgetting.record import compare as comparing
from forgetting.record import identify, samples
from forgetting.record.moved import Moved
from forgetting.record.origin import origin
from forgetting.record.read import Record, read
from forgetting.record.regression import regression
from forgetting.record.samples import Samples

COLUMNS = 8
MOST = 40
"""Columns of numbers that an identification may hold at a time, 8 regressors among them: these and
the output, the estimates and their variances (25), what is known of every sample (5), and work."""
MADE = 22
"""Columns that a formula may take beside the table: 8 regressors and the output as formulaic gives
them, the same as samples, and work."""


def wide(rows: int) -> pd.DataFrame:
    random = np.random.default_rng(0)
    x = random.normal(size=(rows, COLUMNS))
    frame = pd.DataFrame(x, columns=[f"x{i}" for i in range(COLUMNS)])
    return frame.assign(y=x.sum(axis=1) + random.normal(size=rows))


def peak_columns(model: str, rows: int, **options) -> float:
    """Peak of the memory that `identify` takes for itself, in columns of the record."""
    frame = wide(rows)
    identify(frame[:500], formula=model, **options)  # libraries are loaded
    tracemalloc.start()
    identify(frame, formula=model, **options)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    return peak / (8 * rows)


@pytest.mark.parametrize("rule", ["auto", "exponential"])
@pytest.mark.parametrize("constant", ["0", "1"])
def test_a_record_is_not_there_twice(rule, constant):
    model = f"y ~ {constant} + " + " + ".join(f"x{i}" for i in range(COLUMNS))
    more = 3 * int(constant)  # regressor, estimate and variance of the constant
    assert peak_columns(model, 200_000, rule=rule) < MOST + more


def test_a_formula_takes_the_columns_of_a_table_as_they_are():
    record, model = read(wide(400_000)), "y ~ 0 + " + " + ".join(f"x{i}" for i in range(COLUMNS))
    regression(read(wide(500)), model)  # libraries are loaded
    gc.collect()
    tracemalloc.start()
    regression(record, model)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak / (8 * len(record.frame)) < MADE


@pytest.fixture
def some() -> Samples:
    random = np.random.default_rng(1)
    phi, y = random.normal(300.0, 1.0, size=(1000, 3)), random.normal(size=(1000, 2))
    phi[:, 1] = 1.0
    phi[:4, 0], phi[500:510, 2], y[700, 1] = np.nan, np.nan, np.nan
    return Samples(phi, y, ("a", "1", "b"), ("p", "q"), "", None, "")


def test_pieces_are_what_the_whole_is(some, monkeypatch):
    here = origin(some)
    assert here.constant == 1 and here.phi.tolist() == [some.phi[4, 0], 0.0, some.phi[4, 2]]
    moved = here.moved(some)
    phi = some.phi - here.phi
    known = phi[some.complete]
    for length in (7, 65_536):
        monkeypatch.setattr(samples.pieces, "__defaults__", (length,))
        np.testing.assert_allclose(moved.information(), known.T @ known, rtol=1e-12)
        part = phi[300:600][some.complete[300:600]]
        np.testing.assert_allclose(moved.information(300, 600), part.T @ part, rtol=1e-12)
        np.testing.assert_allclose(moved.mean_squares, np.nanmean(phi**2, axis=0), rtol=1e-12)
        assert not moved.silent.any()
        np.testing.assert_array_equal(moved.column(2), phi[:, 2])
        np.testing.assert_array_equal(moved.last(10).rows(slice(None))[0], phi[-10:])


def test_some_columns_of_samples(some):
    part = Moved(some, columns=[2, 0])
    assert part.regressors == ("b", "a") and part.parameters == 2
    np.testing.assert_array_equal(part.rows(slice(0, 9))[0], some.phi[:9, [2, 0]])
    np.testing.assert_array_equal(part.column(0), some.phi[:, 2])


@pytest.mark.parametrize("suffix", [".csv", ".parquet"])
def test_estimates_are_written_by_pieces(tmp_path, monkeypatch, suffix):
    frame = wide(1000)
    found = identify(frame, formula="y ~ x0 + x1")
    path = tmp_path / f"estimates{suffix}"
    monkeypatch.setattr(samples.pieces, "__defaults__", (300,))
    found.save_estimates(path)
    table = pd.read_csv(path) if suffix == ".csv" else pd.read_parquet(path)
    pd.testing.assert_frame_equal(table, found.estimates(), check_exact=True)


def test_compare_says_by_how_many_rows_factors_were_chosen(monkeypatch, tmp_path, capsys):
    random = np.random.default_rng(0)
    x, gain = random.normal(size=3000), np.cumsum(0.1 * random.normal(size=3000))
    frame = pd.DataFrame({"x": x, "y": gain * x + 0.3 * random.normal(size=3000)})
    monkeypatch.setattr(comparing, "CHOOSING", 800)
    model = {"formula": "y ~ 0 + x"}
    found = comparing.compare(read(frame), ["exponential", "none"], **model)
    assert found.choosing == 800 and found.summary()["rows_that_choose"] == 800
    assert found.scored_in_words().endswith("with its best factor on the 800 rows before")
    best = found.ranked[0]
    phi, y = frame[["x"]].to_numpy(), frame["y"].to_numpy()
    part = slice(1200, 2000)  # the last 800 of the first 2000, a tenth of them to settle
    rms = [
        np.sqrt(np.mean(fg.RLS(1, rule=fg.Exponential(f)).run(phi[part], y[part]).error[80:] ** 2))
        for f in (0.5, 0.7, 0.9, 0.99, 0.999)
    ]
    assert best.name == "exponential" and best.chosen_by <= min(rms) * 1.001
    error = fg.RLS(1, rule=best.rule).run(phi, y).error[2000:]
    assert best.error == pytest.approx(np.sqrt(np.mean(error**2)), rel=1e-12)
    path = tmp_path / "r.csv"
    frame.to_csv(path, index=False)
    assert run(["compare", str(path), "-f", "y ~ 0 + x", "--rules", "exponential,none"]) == 0
    assert "on the 800 rows before" in " ".join(capsys.readouterr().out.split())


def test_numbers_beyond_all_range_are_refused_with_their_row(monkeypatch):
    frame = pd.DataFrame({"x": [1.0] * 500, "y": [1.0] * 500})
    frame.loc[400, "y"] = 1e200
    monkeypatch.setattr(samples.pieces, "__defaults__", (64,))
    model = {"formula": "y ~ 0 + x", "forgetting_factor": 0.5}
    found = comparing.compare(read(frame), ["exponential", "subspace"], **model)
    assert found.ranked == []
    with pytest.raises(fg.NumericalRange, match="row 401: ") as caught:
        identify(frame, formula="y ~ 0 + x", rule=fg.Exponential(0.5))
    assert found.refused == [f"{name}: {caught.value}" for name in ("exponential", "subspace")]


def test_compare_takes_a_model_without_a_constant(tmp_path, capsys):
    path = tmp_path / "r.csv"
    wide(400).to_csv(path, index=False)
    command = ["compare", str(path), "--output", "y", "--input", "x0", "--arx", "1,1,0"]
    command += ["--rules", "none", "--json"]
    errors = []
    for more in ([], ["--no-offset"]):
        assert run([*command, *more]) == 0
        errors.append(json.loads(capsys.readouterr().out)["rules"][0]["error"])
    assert errors[0] != errors[1]


def test_several_outputs_are_certified(tmp_path, capsys):
    random = np.random.default_rng(0)
    u, y = random.normal(size=(1500, 2)), np.zeros((1500, 2))
    for k in range(1, 1500):
        y[k] = 0.8 * y[k - 1] + u[k - 1] + 0.1 * random.normal(size=2)
    path = tmp_path / "two.csv"
    columns = {"u1": u[:, 0], "u2": u[:, 1], "y1": y[:, 0], "y2": y[:, 1]}
    pd.DataFrame(columns).to_csv(path, index=False)
    command = ["certify", str(path), "-y", "y1", "-y", "y2", "-u", "u1", "-u", "u2"]
    assert run([*command, "--arx", "1,1,1", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["confidence"]["coverage"] == pytest.approx(0.95, abs=0.02)


def test_a_page_of_twelve_parameters_is_small(tmp_path):
    from forgetting.report import save

    random = np.random.default_rng(0)
    x = random.normal(size=(60_000, 12))
    frame = pd.DataFrame(x, columns=[f"x{i}" for i in range(12)])
    frame["y"] = x.sum(axis=1) + random.normal(size=len(x))
    model = "y ~ 0 + " + " + ".join(f"x{i}" for i in range(12))
    page = Path(tmp_path / "page.html")
    save(identify(frame, formula=model), page)
    assert page.stat().st_size < 2_000_000


@pytest.mark.parametrize("command", ["identify", "certify", "compare"])
def test_no_command_holds_the_table_while_it_works(command, tmp_path, monkeypatch, capsys):
    alive = []

    def count(rows: int) -> None:
        gc.collect()
        alive.append(sum(isinstance(each, Record) for each in gc.get_objects()))

    for module in ("identify", "compare"):
        monkeypatch.setattr(import_module(f"forgetting.record.{module}"), "release", count)
    path = tmp_path / "r.csv"
    wide(300).to_csv(path, index=False)
    options = ["--rules", "none"] if command == "compare" else []
    assert run([command, str(path), "--formula", "y ~ x0", *options]) == 0
    assert alive == [0]
