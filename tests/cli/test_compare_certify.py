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


@pytest.fixture
def drifting(tmp_path):
    """A gain that walks."""
    random = np.random.default_rng(1)
    x, gain = random.normal(size=900), np.cumsum(0.1 * random.normal(size=900))
    frame = pd.DataFrame({"x": x, "y": gain * x + 0.3 * random.normal(size=900)})
    path = tmp_path / "drifting.csv"
    frame.to_csv(path, index=False)
    return path


def ranked(command, capsys):
    assert run([*command, "--json"]) == 0
    return json.loads(capsys.readouterr().out)


def test_every_rule_has_the_factor_that_is_best_on_the_first_part(drifting, capsys):
    command = ["compare", str(drifting), "--formula", "y ~ 0 + x"]
    found = ranked([*command, "--rules", "exponential,subspace,random_walk,none"], capsys)
    frame = pd.read_csv(drifting)
    phi, y = frame[["x"]].to_numpy(), frame["y"].to_numpy()
    first, rest = slice(60, 600), slice(600, 900)
    rms = {}
    for factor in (0.5, 0.7, 0.8, 0.9, 0.95, 0.98, 0.99, 0.998):
        estimator = fg.RLS(1, rule=fg.Exponential(factor))
        error = estimator.run(phi, y, outputs=("error",)).error
        rms[factor] = np.sqrt(np.mean(error[first] ** 2))
    by_rule = {each["rule"]: each for each in found["rules"]}
    chosen = by_rule["exponential"]
    assert chosen["error_on_first_part"] <= min(rms.values()) * 1.001
    estimator = fg.RLS(1, rule=fg.Exponential(**chosen["setting"]))
    error = estimator.run(phi, y, outputs=("error",)).error[rest]
    assert chosen["error"] == pytest.approx(np.sqrt(np.mean(error**2)), rel=1e-12)
    assert list(by_rule["random_walk"]["setting"]) == ["process_noise"]
    assert by_rule["none"]["setting"] is None
    errors = [each["error"] for each in found["rules"]]
    assert errors == sorted(errors) and found["rules"][-1]["rule"] == "none"
    assert found["scored"].startswith("the last 300 samples, each rule with its best factor")


def test_a_factor_for_all_is_said_to_be_not_chosen(drifting, capsys):
    command = ["compare", str(drifting), "--formula", "y ~ 0 + x", "--rules", "exponential,none"]
    command += ["--forgetting-factor", "0.9"]
    found = ranked(command, capsys)
    assert found["scored"] == "all samples, one factor for all rules: none was chosen"
    assert found["rules"][0]["setting"] == {"forgetting_factor": 0.9}
    assert found["first_row_of_the_rest"] is None
    assert run(command) == 0
    assert "none was chosen" in " ".join(capsys.readouterr().out.split())
    assert run([*command, "--plot", "x.png"]) == 2
    assert "which --forgetting-factor fixes" in capsys.readouterr().err


def test_a_short_record_is_said_to_be_too_short_to_choose_by(drifting, tmp_path, capsys):
    short = tmp_path / "short.csv"
    pd.read_csv(drifting).head(60).to_csv(short, index=False)
    command = ["compare", str(short), "--formula", "y ~ x", "--rules", "exponential,none"]
    found = ranked(command, capsys)
    assert found["scored"].endswith("the record is too short to choose factors")
    by_rule = {each["rule"]: each for each in found["rules"]}
    assert by_rule["exponential"]["setting"] == {"forgetting_factor": 0.99}
    assert by_rule["exponential"]["error_on_first_part"] is None
    assert run([*command, "--plot", str(tmp_path / "x.png")]) == 2
    assert "there is no choice to draw" in capsys.readouterr().err


def test_units_change_no_ranking(drifting, tmp_path, capsys):
    frame = pd.read_csv(drifting)
    other = tmp_path / "other.csv"
    frame.assign(x=1e3 * frame["x"], y=1e-4 * frame["y"]).to_csv(other, index=False)
    rules = [r["name"] for r in fg.rules() if r["name"] not in ("custom", "data_dependent")]
    command = ["--formula", "y ~ x", "--rules", ",".join(rules)]
    one = ranked(["compare", str(drifting), *command], capsys)["rules"]
    two = {
        each["rule"]: each for each in ranked(["compare", str(other), *command], capsys)["rules"]
    }
    for each in one:
        assert two[each["rule"]]["setting"] == each["setting"]
        assert two[each["rule"]]["error"] == pytest.approx(1e-4 * each["error"], rel=1e-6)


def test_the_factors_are_drawn(drifting, tmp_path, capsys):
    picture = tmp_path / "compare.png"
    command = ["compare", str(drifting), "--formula", "y ~ x", "--plot", str(picture)]
    assert run(command) == 0
    assert picture.read_bytes().startswith(b"\x89PNG")
    assert f"wrote {picture}" in capsys.readouterr().out


def test_a_given_prior_is_used_for_every_rule(drifting, capsys):
    command = ["compare", str(drifting), "--formula", "y ~ 0 + x", "--rules", "exponential"]
    found = ranked([*command, "--initial-covariance", "1e-9"], capsys)["rules"][0]
    frame = pd.read_csv(drifting)
    estimator = fg.RLS(1, rule=fg.Exponential(**found["setting"]), initial_covariance=1e-9)
    run_ = estimator.run(frame[["x"]].to_numpy(), frame["y"].to_numpy(), outputs=("error",))
    assert found["error"] == pytest.approx(np.sqrt(np.mean(run_.error[600:] ** 2)), rel=1e-12)


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
    assert run([*command, "--gate", "dead_zone:width=5,otherwise=freeze"]) == 0
    # in units of y, where P is given
    in_units = ["--initial-covariance", "100", "--gate", "dead_zone:width=0.5,otherwise=freeze"]
    assert run([*command, *in_units]) == 0
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


@pytest.mark.parametrize("rule", ["subspace", "exponential", "random_walk"])
def test_a_prior_that_is_set_late_is_no_forgetting(rule, tmp_path, capsys):
    """The input speaks at row 11: until then the prior of its parameter is not known."""
    random = np.random.default_rng(3)
    x = np.r_[np.zeros(10), 20 + random.normal(size=400)]
    y = 1 + 0.5 * x + 0.1 * random.normal(size=410)
    pd.DataFrame({"x": x, "y": y}).to_csv(tmp_path / "late.csv", index=False)
    command = ["certify", str(tmp_path / "late.csv"), "-f", "y ~ x", "-r", rule, "--json"]
    run(command)
    found = json.loads(capsys.readouterr().out)
    assert found["conditions"]["A1"]["verdict"] == "holds"
    assert found["first_row_examined"] == 12


def test_a_half_life_is_certified_as_the_factor_that_it_is(drifting, tmp_path, capsys):
    frame = pd.read_csv(drifting)
    frame.insert(0, "seconds", 0.5 * np.arange(len(frame)))
    path = tmp_path / "timed.csv"
    frame.to_csv(path, index=False)
    command = ["certify", str(path), "-f", "y ~ x", "-r", "exponential", "--json"]
    found = []
    for more in (
        ["-l", str(0.5 ** (1 / 64))],
        ["--half-life", "64"],
        ["--half-life", "32s", "--time", "seconds"],
    ):
        run([*command, *more])
        found.append(json.loads(capsys.readouterr().out))
    assert found[0]["excitation"] == found[1]["excitation"]
    for each in found[1:]:
        ours, others = each["stability"], found[0]["stability"]
        assert ours["conclusions"] == others["conclusions"]
        for name in ("observed_decrease", "lyapunov_decrease"):
            assert ours[name] == pytest.approx(others[name], rel=1e-5)
    assert run([*command, "--half-life", "64", "-l", "0.9"]) == 2
    assert "--half-life goes without" in capsys.readouterr().err


def test_bad_input_is_one_sentence(tmp_path, capsys):
    for command in ("compare", "certify"):
        assert run([command, str(tmp_path / "absent.csv"), "--formula", "y ~ x"]) == 2
        assert "absent.csv" in capsys.readouterr().err
