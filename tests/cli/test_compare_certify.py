"""`forgetting compare` and `forgetting certify` on a record whose input stops."""

import json

import numpy as np
import pandas as pd
import pytest

import forgetting as fg
from forgetting.cli.app import run


@pytest.fixture
def record(tmp_path):
    random = np.random.default_rng(0)
    x = random.normal(size=600)
    x[300:] = 0.0
    frame = pd.DataFrame({"x": x, "y": 3.0 * x + 0.1 * random.normal(size=600)})
    path = tmp_path / "record.csv"
    frame.to_csv(path, index=False)
    return str(path)


def test_every_rule_is_ranked_or_said_to_be_refused(record, tmp_path, capsys):
    page = tmp_path / "page.html"
    assert run(["compare", record, "--formula", "y ~ 0 + x", "--report", str(page)]) == 0
    printed = capsys.readouterr().out
    for rule in fg.rules():
        if rule["name"] != "custom":
            assert rule["name"] in printed
    text = page.read_text(encoding="utf-8")
    assert "Ranked by one-step error" in text
    assert "http" not in text.replace("http://www.w3.org", "")


def test_named_rules_come_in_the_order_of_their_error(record, capsys):
    command = ["compare", record, "--formula", "y ~ 0 + x", "--rules", "exponential,none"]
    assert run([*command, "--forgetting-factor", "0.5"]) == 0
    printed = capsys.readouterr().out
    assert printed.index("none") < printed.index("exponential")
    assert "subspace" not in printed
    assert run(["compare", record, "--formula", "y ~ 0 + x", "--rules", "nonsense"]) == 2
    assert "there is no rule 'nonsense'" in capsys.readouterr().err


@pytest.mark.parametrize(("rule", "code"), [("exponential", 1), ("subspace", 0)])
def test_the_certificate_tells_windup_by_its_exit_code(record, rule, code, capsys):
    command = ["certify", record, "--formula", "y ~ 0 + x", "--rule", rule]
    assert run([*command, "--forgetting-factor", "0.95"]) == code
    assert "windup" in capsys.readouterr().out.lower()
    assert run([*command, "--forgetting-factor", "0.95", "--json"]) == code
    assert isinstance(json.loads(capsys.readouterr().out), dict)


def test_a_gate_keeps_the_certificate_free_of_windup(record, capsys):
    command = ["certify", record, "--formula", "y ~ 0 + x", "--rule", "exponential"]
    command += ["--forgetting-factor", "0.95"]
    assert run([*command, "--gate", "minimum_information:information=1e-4"]) == 0
    assert run([*command, "--gate", "dead_zone:width=0.5,otherwise=freeze"]) == 0
    assert run([*command, "--gate", "open"]) == 1
    capsys.readouterr()
    for text, words in (
        ("shut", "there is no gate 'shut'"),
        ("gate_function", "there is no gate 'gate_function'"),
        ("dead_zone:depth=1", "has no parameter 'depth'; it has width, otherwise"),
        ("dead_zone:width", "--gate takes name=value"),
        ("dead_zone:width=-1", "width = -1"),
    ):
        assert run([*command, "--gate", text]) == 2
        assert words in capsys.readouterr().err


def test_rows_with_a_missing_value_keep_their_numbers(tmp_path, capsys):
    random = np.random.default_rng(1)
    x = random.normal(size=400)
    frame = pd.DataFrame({"x": x, "y": 3.0 * x})
    frame.loc[50:149, "x"] = np.nan
    frame.loc[200:, "x"] = 0.0
    path = tmp_path / "holes.csv"
    frame.to_csv(path, index=False)
    command = ["certify", str(path), "--formula", "y ~ 0 + x", "--rule", "exponential"]
    assert run([*command, "--forgetting-factor", "0.9", "--json"]) == 1
    found = json.loads(capsys.readouterr().out)
    # nothing is forgotten in the gap; 0.9^-22 is the first power above 10
    assert 215 < found["windup"]["sample"] < 230


def test_bad_input_is_one_sentence(tmp_path, capsys):
    for command in ("compare", "certify"):
        assert run([command, str(tmp_path / "absent.csv"), "--formula", "y ~ x"]) == 2
        assert "absent.csv" in capsys.readouterr().err
