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


def test_bad_input_is_one_sentence(tmp_path, capsys):
    for command in ("compare", "certify"):
        assert run([command, str(tmp_path / "absent.csv"), "--formula", "y ~ x"]) == 2
        assert "absent.csv" in capsys.readouterr().err
