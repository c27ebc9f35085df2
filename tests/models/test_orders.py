"""Orders and delays of their own for several inputs: in texts, in commands, in streams."""

from __future__ import annotations

import json
import shlex

import numpy as np
import pandas as pd
import pyarrow as pa
import pytest

import forgetting as fg
from forgetting.cli.app import run
from forgetting.models.orders import Orders
from forgetting.record.identify import identify
from forgetting.stream import Settings, Stream
from forgetting.tables import TableFleet
from forgetting.tuning.orders import order_grid, widest

ROWS = 900
SAID = ["-y", "y", "-u", "u", "-u", "v"]
MODEL = "arx:na=1,nb=2/1,nk=1/0"
NAMES = ["y(k-1)", "v(k)", "u(k-1)", "u(k-2)", "offset"]
TRUTH = [0.8, -0.5, 1.0, 0.4, 2.0]


@pytest.fixture(scope="module")
def frame():
    """y = 0.8 y(k-1) - 0.5 v(k) + u(k-1) + 0.4 u(k-2) + 2, and little noise."""
    u, v, e = np.random.default_rng(3).normal(size=(3, ROWS))
    y = np.zeros(ROWS)
    for k in range(2, ROWS):
        y[k] = 0.8 * y[k - 1] - 0.5 * v[k] + u[k - 1] + 0.4 * u[k - 2] + 2 + 0.01 * e[k]
    y[400] = np.nan
    return pd.DataFrame({"u": u, "v": v, "y": y})


@pytest.fixture(scope="module")
def record(frame, tmp_path_factory):
    path = tmp_path_factory.mktemp("orders") / "record.csv"
    frame.to_csv(path, index=False)
    return str(path)


def by_hand(frame):
    """The regression in the order of `NAMES`, written out."""
    u, v, y = (frame[name].to_numpy() for name in ("u", "v", "y"))
    phi = np.full((ROWS, 5), np.nan)
    for k in range(2, ROWS):
        phi[k] = y[k - 1], v[k], u[k - 1], u[k - 2], 1.0
    phi[1, :3], phi[0, 1] = (y[0], v[1], u[0]), v[0]
    return phi, y


def told(command, capsys, code=0):
    assert run([*command, "--json"]) == code
    return json.loads(capsys.readouterr().out)


def test_regressors_are_those_written_out(frame):
    phi, y = by_hand(frame)
    found = identify(frame, output="y", input=["u", "v"], model=MODEL, rule="none")
    assert list(found.samples.regressors) == NAMES
    usable = ~np.isnan(phi).any(axis=1)
    assert np.array_equal(found.samples.phi[usable], phi[usable])
    assert found.used == (usable & ~np.isnan(y)).sum()
    assert found.parameters["value"].to_numpy() == pytest.approx(TRUTH, abs=0.01)
    assert "ARX(1,2/1,1/0) of y on u, v" in found.samples.model


def test_one_order_for_all_is_the_same_for_each(frame):
    each = identify(frame, output="y", input=["u", "v"], model="arx:na=1,nb=2/2,nk=1/1")
    same = identify(frame, output="y", input=["u", "v"], arx=(1, 2, 1))
    assert np.array_equal(each.theta, same.theta)


@pytest.mark.parametrize("command", ["identify", "compare", "certify"])
def test_commands_take_both_ways_to_say_it(command, record, capsys):
    rules = ["--rules", "none"] if command == "compare" else ["--rule", "none"]
    by_model = told([command, record, *SAID, "--model", MODEL, *rules], capsys)
    by_orders = told([command, record, *SAID, "--arx", "1,2/1,1/0", *rules], capsys)
    assert by_model == by_orders
    if command == "identify":
        values = {each["parameter"]: each["value"] for each in by_model["parameters"]}
        assert [values[name] for name in NAMES] == pytest.approx(TRUTH, abs=0.01)


def test_a_delay_of_its_own_is_chosen(record, capsys):
    fast = ["--no-rates", "--no-priors", "--rules", "none"]
    model = ["--model", "arx:na=1-2,nb=2/1,nk=1/0"]
    found = told(["tune", record, *SAID, *model, *fast], capsys)
    assert found["orders"] == [1, [2, 1], [1, 0]]
    assert len({str(each["orders"]) for each in found["trials"]}) == 2
    assert "--arx 1,2/1,1/0" in found["command"]
    said = told(shlex.split(found["command"])[1:], capsys)
    names = {}
    exec(found["python"], names)
    first = found["first_row_of_the_rest"]
    error = names["found"].trace.error[first:, 0]
    reported = found["errors_on_rest"]["tuned"]["y"]
    assert np.sqrt(np.nanmean(error**2)) == pytest.approx(reported, rel=1e-12)
    assert said["model"] == "ARX(1,2/1,1/0) of y on u, v"


def test_arrays_are_tuned_alike(frame):
    u, y = frame[["u", "v"]].to_numpy(), frame["y"].to_numpy()
    fast = {"rules": ["none"], "rates": False, "priors": False}
    found = fg.tune_model(u, y, MODEL, **fast, offset=True)
    assert found.orders == Orders(1, (2, 1), (1, 0))
    model = eval(found.python).fit(u, y)
    assert np.ravel(model.theta_) == pytest.approx(TRUTH, abs=0.01)


def test_lags_of_all_models_are_held_by_the_widest():
    models = order_grid([1, 2], [(2, 1)], [0, 1], 2)
    assert len(models) == 4
    assert widest(models, 2) == Orders(2, (3, 2), 0)


@pytest.mark.parametrize("lines", [1, 7, ROWS + 1])
def test_a_stream_is_the_record(frame, record, lines):
    settings = Settings(output=("y",), input=("u", "v"), model=MODEL)
    stream = Stream(settings, fields="theta,error")
    with open(record, "rb") as given:
        each = given.readlines()
    parts = [b"".join(each[k : k + lines]) for k in range(0, len(each), lines)]
    rows = [json.loads(line) for part in parts for line in stream.feed(part).lines]
    rows = [row for row in rows if "alarm" not in row]
    found = identify(frame, output="y", input=["u", "v"], model=MODEL)
    theta = np.array([list(row["theta"].values()) for row in rows])
    assert np.array_equal(
        theta[2:], found.theta[2:, :, 0]
    )  # a stream cannot know the origin before


def test_a_stream_cuts_the_lags_of_each_input_at_a_gap(frame, tmp_path):
    record = frame.assign(t=np.arange(ROWS) + 100.0 * (np.arange(ROWS) > 600))
    record.to_csv(tmp_path / "r.csv", index=False)
    stream = Stream(Settings(output=("y",), input=("u", "v"), model=MODEL, gap=10.0))
    lines = stream.feed((tmp_path / "r.csv").read_bytes()).lines
    rows = [row for row in map(json.loads, lines) if "alarm" not in row]
    left = [k for k, row in enumerate(rows) if row["skipped"] == "missing"]
    found = identify(tmp_path / "r.csv", output="y", input=["u", "v"], model=MODEL)
    assert left == np.flatnonzero(~found.samples.complete).tolist() == [0, 1, 400, 401, 601, 602]


def test_a_fleet_has_the_same_for_each_key_and_goes_on(frame):
    whole = pa.Table.from_pandas(frame.assign(key="a", t=np.arange(ROWS)))
    settings = {"time": "t", "model": MODEL, "rule": "none", "offset": True}
    settings["initial_covariance"] = 1e6
    fleet = TableFleet("key", "y", ["u", "v"], **settings)
    fleet.update(whole[:333])
    fleet = TableFleet.from_arrow(fleet.to_arrow())
    fleet.update(whole[333:])
    u, y = frame[["u", "v"]].to_numpy(), frame["y"].to_numpy()
    lags = {"na": 1, "nb": [2, 1], "nk": [1, 0], "offset": True}
    model = fg.ARX(**lags, rule="none", initial_covariance=1e6).fit(u, y)
    row = fleet.estimates().to_pylist()[0]
    assert [row[f"theta:{name}"] for name in NAMES] == pytest.approx(
        np.ravel(model.theta_), rel=1e-9
    )


def test_kin_with_coloured_noise_take_the_same_text(record, capsys):
    model = ["--model", "armax:na=1,nb=2/1,nc=0,nk=1/0"]
    found = told(["identify", record, *SAID, *model, "--rule", "none"], capsys)
    values = {each["parameter"]: each["value"] for each in found["parameters"]}
    assert [values[name] for name in NAMES] == pytest.approx(TRUTH, abs=0.02)


@pytest.mark.parametrize(
    ("orders", "words"),
    [
        ((1, (1, 2), (0,)), "nk has 1 orders for 2 input"),
        ((1, (0, 0), 0), "nb is 0 for all inputs"),
        ((1, (1, -2), 0), r"nb\[1\] is -2; it must be a whole number >= 0"),
        (((1, 2), 1, 0), r"na is \(1, 2\); it must be a whole number"),
        ((1, "12", 0), r"nb\[0\] is '1'"),
    ],
)
def test_what_is_no_order_is_named(orders, words):
    with pytest.raises(fg.InvalidInput, match=words):
        Orders(*orders)


@pytest.mark.parametrize(
    ("arx", "words"),
    [
        ("1,2/1/1,0", "nb has 3 orders for 2 input(s): u, v"),
        ("1/1,2,0", "na is (1, 1); it must be a whole number"),
        ("1,2/,0", "or 1,2/1,0 for two inputs of different orders, but got '1,2/,0'"),
    ],
)
def test_the_command_says_what_is_wrong(arx, words, record, capsys):
    assert run(["identify", record, *SAID, "--arx", arx]) == 2
    error = capsys.readouterr().err
    assert words in error and error.count("\n") == 1
