"""`--model` of the commands: one way to say a structure and its orders."""

from __future__ import annotations

import json
import shlex

import numpy as np
import pandas as pd
import pytest

import forgetting as fg
from forgetting.cli.app import run

SAID = ["-y", "y", "-u", "u"]
ARMAX = ["--model", "armax:na=1,nb=1,nc=1,nk=2"]
ROWS = 1500


@pytest.fixture(scope="module")
def frame():
    """y = 0.9 y(k-1) + u(k-2) + e + 0.6 e(k-1) about an operating point."""
    u, e = np.random.default_rng(0).normal(size=(2, ROWS))
    y = np.zeros(ROWS)
    for k in range(2, ROWS):
        y[k] = 0.9 * y[k - 1] + u[k - 2] + e[k] + 0.6 * e[k - 1]
    return pd.DataFrame({"u": u + 20.0, "y": y + 300.0})


@pytest.fixture(scope="module")
def record(frame, tmp_path_factory):
    path = tmp_path_factory.mktemp("model") / "record.csv"
    frame.to_csv(path, index=False)
    return str(path)


def told(command, capsys, code=0):
    assert run([*command, "--json"]) == code
    return json.loads(capsys.readouterr().out)


@pytest.mark.parametrize("command", ["identify", "compare", "certify"])
def test_a_linear_structure_is_arx(command, record, capsys):
    rules = ["--rules", "exponential,none"] if command == "compare" else []
    by_orders = told([command, record, *SAID, "--arx", "2,1,1", *rules], capsys)
    by_model = told([command, record, *SAID, "--model", "arx:na=2,nb=1,nk=1", *rules], capsys)
    assert by_model == by_orders
    assert by_orders.get("reservation") is None


def test_rules_are_compared_on_regressors_of_their_own(frame, record, tmp_path, capsys):
    page = tmp_path / "page.html"
    rules = ["--rules", "exponential,subspace,none", "--report", str(page)]
    found = told(["compare", record, *SAID, *ARMAX, *rules], capsys)
    assert "its own estimates" in found["reservation"]
    assert "its own estimates" in page.read_text(encoding="utf-8")
    rest = slice(found["first_row_of_the_rest"], None)
    for each in found["rules"]:
        rule = fg.rule(each["rule"], **(each["setting"] or {}))
        model = fg.ARMAX(na=1, nb=1, nc=1, nk=2, offset=True, rule=rule)
        error = model.course(frame["u"], frame["y"], "error")["error"][rest]
        assert each["error"] == pytest.approx(np.sqrt(np.mean(error**2)), rel=1e-12)
        assert each["left_out"] == 2


def test_models_with_coloured_noise_beat_arx_in_a_comparison(record, capsys):
    rules = ["--rules", "none"]
    coloured = told(["compare", record, *SAID, *ARMAX, *rules], capsys)
    white = told(["compare", record, *SAID, "--arx", "1,1,2", *rules], capsys)
    assert coloured["rules"][0]["error"] < 0.95 * white["rules"][0]["error"]


def test_a_certificate_says_what_does_not_hold(record, tmp_path, capsys):
    page = tmp_path / "page.html"
    command = ["certify", record, *SAID, *ARMAX, "--report", str(page)]
    found = told(command, capsys)
    assert "near the truth" in found["reservation"]
    assert "near the truth" in page.read_text(encoding="utf-8")
    # the start, where samples count less, is left out
    assert found["first_row_examined"] > 600
    assert found["confidence"]["coverage"] == pytest.approx(0.95, abs=0.03)
    assert run(command) == 0
    assert "Reservation" in capsys.readouterr().out
    assert run(["certify", record, *SAID, "--arx", "1,1,2"]) == 0
    assert "Reservation" not in capsys.readouterr().out


FAST = ["--no-rates", "--no-priors", "--rules", "none,exponential"]


def test_orders_and_delay_are_found(record, capsys):
    model = ["--model", "armax:na=1-2,nb=1-2,nc=0-2,nk=1-3"]
    found = told(["tune", record, *SAID, *model, *FAST], capsys)
    assert found["orders"] == "armax:na=1,nb=1,nc=1,nk=2"
    tried = {each["orders"] for each in found["trials"]}
    assert len(tried) == 2 * 2 * 3 * 3
    first = found["first_row_of_the_rest"]
    for command, python, name in (
        (found["command"], found["python"], "tuned"),
        (found["command_of_bank"], found["python_of_bank"], "bank"),
    ):
        said = told(shlex.split(command)[1:], capsys)
        assert said["model"] == "ARMAX(na=1, nb=1, nc=1, nk=2) of y on u"
        names = {}
        exec(python, names)
        error = names["found"].trace.error[first:, 0]
        reported = found["errors_on_rest"][name]["y"]
        assert np.sqrt(np.mean(error**2)) == pytest.approx(reported, rel=1e-12)


def test_ranges_of_a_linear_structure_are_those_of_arx(record, capsys):
    by_model = told(["tune", record, *SAID, "--model", "arx:na=1-2,nb=1,nk=1-3", *FAST], capsys)
    assert by_model == told(["tune", record, *SAID, "--arx", "1-2,1,1-3", *FAST], capsys)


@pytest.mark.parametrize(
    ("model", "words"),
    [
        ("armax:na=3-1", "na=3-1 is no range"),
        ("armax:na=1-9,nb=1-9,nc=1-9", "2916 models are to be tried, allowed: 1 to 300"),
        ("armax:na=1..3", "'na=1..3' is not an order"),
        ("arma:na=1-2", "nb = 0 goes with u = None"),
        ("armax:nb=0", "nb = 0 goes with u = None"),
        ("arx:nb=1/2", "nb has 2 orders for 1 input(s)"),
        ("arx:nk=1/2", "nk has 2 orders for 1 input(s)"),
        ("tree", "the model 'tree' is not known"),
    ],
)
def test_what_cannot_be_tried_is_said_in_one_sentence(model, words, record, capsys):
    assert run(["tune", record, *SAID, "--model", model]) == 2
    error = capsys.readouterr().err
    assert words in error and "Traceback" not in error


@pytest.mark.parametrize("command", ["identify", "compare", "certify"])
@pytest.mark.parametrize(
    ("said", "words"),
    [
        (["--model", "armaxx:na=1"], "the model 'armaxx' is not known"),
        (["--model", "armax:na=x"], "'na=x' is not an order; write armax:na=1,nb=1,nc=1,nk=1"),
        (["--model", "armax:na=1,na=2"], "na is said twice"),
        (["--model", "arma:na=1,nc=1"], "nb = 0 goes with u = None"),
        (["--model", "armax:na=99999999999"], "na is 99999999999; it must be"),
        (["--model", "armax:na=1", "--arx", "1,1,1"], "say the model once"),
    ],
)
def test_what_is_wrong_is_said_in_one_sentence(command, said, words, record, capsys):
    assert run([command, record, *SAID, *said]) == 2
    error = capsys.readouterr().err
    assert words in error and "Traceback" not in error
