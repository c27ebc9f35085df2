"""`forgetting identify`: what it prints and writes."""

from __future__ import annotations

import json

import numpy as np
import pandas as pd
import pytest

import forgetting as fg
from forgetting.record import identify

FORMULA = ("--formula", "V ~ lag(V) + I + lag(I)")


def test_prints_what_was_found(forgetting, battery):
    run = forgetting("identify", battery, *FORMULA, "--rule", "none")
    assert (run.code, run.err) == (0, "")
    for part in (
        "battery.csv",
        "NoForgetting()",
        "lag(V)",
        "One-step RMSE on 195 samples",
        "no forgetting",
        "last value",
        "200: 199 used, 1 missing, 0 in the dead zone",
        "largest / smallest eigenvalue of P",
        "All parameters were excited.",
    ):
        assert part in run.out, part


def test_json_equals_python(forgetting, battery):
    arguments = ("--output", "V", "--input", "I", "--arx", "1,2,0", "--rule", "exponential")
    run = forgetting("identify", battery, *arguments, "--forgetting-factor", "0.98", "--json")
    printed = json.loads(run.out)
    found = identify(battery, output="V", input="I", arx=(1, 2, 0), rule=fg.Exponential(0.98))
    assert printed == json.loads(json.dumps(found.summary())) | {"written": []}
    assert [row["parameter"] for row in printed["parameters"]] == [
        "V(k-1)",
        "I(k)",
        "I(k-1)",
        "offset",
    ]


def test_finds_the_coefficients(forgetting, battery):
    run = forgetting(
        "identify", battery, *FORMULA, "--initial-covariance", "1e8", "--rule", "none", "--json"
    )
    values = {row["parameter"]: row["value"] for row in json.loads(run.out)["parameters"]}
    expected = {"Intercept": 0.4, "lag(V)": 0.9, "I": 0.05, "lag(I)": -0.03}
    assert values == pytest.approx(expected, rel=1e-4)


def test_several_outputs_and_inputs(forgetting, tmp_path):
    rng = np.random.default_rng(0)
    frame = pd.DataFrame(rng.normal(size=(50, 4)), columns=["p", "q", "r", "s"])
    frame.to_parquet(tmp_path / "four.parquet")
    run = forgetting(
        "identify",
        tmp_path / "four.parquet",
        "-y",
        "p",
        "-y",
        "q",
        "-u",
        "r",
        "-u",
        "s",
        "--arx",
        "1,1,1",
        "--json",
    )
    rows = json.loads(run.out)["parameters"]
    assert [row["output"] for row in rows] == ["p"] * 5 + ["q"] * 5
    names = ["p(k-1)", "q(k-1)", "r(k-1)", "s(k-1)", "offset"]
    assert [row["parameter"] for row in rows[:5]] == names


def test_writes_all_files(forgetting, battery, tmp_path):
    report, plot = tmp_path / "o.html", tmp_path / "o.png"
    estimates = tmp_path / "o.parquet"
    run = forgetting(
        "identify", battery, *FORMULA, "--report", report, "--plot", plot, "--estimates", estimates
    )
    assert run.code == 0
    assert report.read_text(encoding="utf-8").startswith("<!doctype html>")
    assert plot.read_bytes().startswith(b"\x89PNG")
    assert len(pd.read_parquet(estimates)) == 200
    for path in (report, plot, estimates):
        assert f"wrote {path}" in run.out


def test_every_rule_by_its_parameters(forgetting, battery):
    common = ("identify", battery, *FORMULA, "--json", "--rule")
    run = forgetting(*common, "exponential_resetting", "-l", "0.9", "--set", "information=0.5")
    assert json.loads(run.out)["rule"] == (
        "ExponentialResetting(forgetting_factor=0.9, information=0.5)"
    )
    run = forgetting(*common, "subspace", "--threshold", "0.25")
    assert json.loads(run.out)["rule"] == "Subspace(forgetting_factor=0.99, threshold=0.25)"
    diagonal = "information=0.1,0.2,0.3,0.4"
    run = forgetting(*common, "exponential_resetting", "--set", diagonal)
    assert run.code == 0


def test_initial_covariance_per_parameter(forgetting, battery):
    run = forgetting(
        "identify",
        battery,
        *FORMULA,
        "--initial-covariance",
        "1,2,3,4",
        "--json",
        "--dtype",
        "float32",
    )
    assert run.code == 0 and len(json.loads(run.out)["parameters"]) == 4


def test_windup_is_told(forgetting, tmp_path):
    x = np.r_[np.sin(np.arange(100.0)), np.zeros(300)]
    pd.DataFrame({"x": x, "y": 2 * x}).to_csv(tmp_path / "quiet.csv", index=False)
    run = forgetting(
        "identify", tmp_path / "quiet.csv", "-f", "y ~ 0 + x", "-r", "exponential", "-l", "0.9"
    )
    assert run.code == 0 and "Windup:" in run.out


def test_what_is_known_is_told_by_name(forgetting, battery):
    known = ("--bounds", "lag(I)=-0.01:,Intercept=:0.39", "--fixed", "I=0.05")
    run = forgetting("identify", battery, *FORMULA, *known, "--prior", "lag(V)=0.9+-0.01", "--json")
    printed = json.loads(run.out)
    found = identify(
        battery,
        formula=FORMULA[1],
        bounds={"lag(I)": (-0.01, None), "Intercept": (None, 0.39)},
        fixed={"I": 0.05},
        prior={"lag(V)": (0.9, 0.01)},
    )
    assert printed == json.loads(json.dumps(found.summary())) | {"written": []}
    rows = {row["parameter"]: row for row in printed["parameters"]}
    assert rows["lag(I)"]["value"] >= -0.01 and rows["Intercept"]["value"] <= 0.39
    assert (rows["I"]["value"], rows["I"]["known"]) == (0.05, "given")
    assert rows["lag(V)"]["known"] == "prior 0.9 ± 0.01"


def test_the_report_shows_what_was_known(forgetting, battery, tmp_path):
    report = tmp_path / "out.html"
    known = ("--bounds", "I=0:", "--fixed", "lag(I)=-0.03")
    run = forgetting("identify", battery, *FORMULA, *known, "--report", report)
    assert (run.code, run.err) == (0, "")
    for text in (run.out, report.read_text(encoding="utf-8")):
        for part in ("known before", "at least 0", "given"):
            assert part in text


def test_a_level_gives_intervals(forgetting, battery, tmp_path):
    estimates, report = tmp_path / "e.csv", tmp_path / "out.html"
    files = ("--estimates", estimates, "--report", report)
    run = forgetting("identify", battery, *FORMULA, "--level", "0.8", *files)
    assert (run.code, run.err) == (0, "")
    table = pd.read_csv(estimates)
    known = table.dropna(subset=["lower:V"])
    assert len(known) > 150
    assert (known["lower:V"] + known["upper:V"]).to_numpy() == pytest.approx(
        2 * known["predicted:V"]
    )
    assert "within the 0.8 interval" in run.out
    assert "within the 0.8 interval" in report.read_text(encoding="utf-8")
