"""`forgetting tune` prints lines that run as printed and do what it says they do."""

from __future__ import annotations

import json
import shlex

import numpy as np
import pandas as pd
import pytest

import forgetting as fg
from forgetting.record.usage import Usage
from forgetting.tuning import grid
from forgetting.tuning.candidate import Candidate, with_values

FAST = ("--no-rates", "--no-priors")


@pytest.fixture
def plant(tmp_path):
    """A plant whose gain drifts, far from zero, with awkward names and a few words for missing."""
    random = np.random.default_rng(3)
    u, y = random.normal(size=900), np.full(900, 293.15)
    gain = 1 + np.cumsum(0.05 * random.normal(size=900))
    for k in range(2, 900):
        y[k] = 293.15 + 0.7 * (y[k - 1] - 293.15) + gain[k] * u[k - 2] + 0.05 * random.normal()
    text = [f"{value:.6f}" for value in y]
    text[300] = text[400] = "gone"
    frame = pd.DataFrame({"s": np.arange(900.0), "u (V)": u, 'it\'s "T" $x': text})
    folder = tmp_path / "a folder"
    folder.mkdir()
    path = folder / "the plant.csv"
    frame.to_csv(path, index=False)
    return path


def options(path):
    """The ARX model of the plant, and how it is read."""
    return (path, "--output", 'it\'s "T" $x', "--input", "u (V)", "--missing", "gone")


def used(found):
    """The lines to use: of what was chosen, and of the bank."""
    return (
        (found["command"], found["python"], found["errors_on_rest"]["tuned"]),
        (found["command_of_bank"], found["python_of_bank"], found["errors_on_rest"]["bank"]),
    )


def check_lines(forgetting, found):
    """Both lines run, and give the errors that were reported."""
    for command, python, reported in used(found):
        words = shlex.split(command)
        assert words[0] == "forgetting"
        identified = forgetting(*words[1:], "--json")
        assert identified.code == 0, identified.err
        names = {}
        exec(python, names)
        trace, samples = names["found"].trace, names["found"].samples
        rows = np.arange(len(trace.error)) >= found["first_row_of_the_rest"]
        rest = trace.error[rows & samples.complete]
        measured = np.sqrt(np.mean(rest**2, axis=0))
        assert list(measured) == pytest.approx(list(reported.values()), rel=1e-9)
        assert json.loads(identified.out)["rule"] == names["found"].rule_in_words


def test_lines_of_an_arx_model_run_as_printed(forgetting, plant):
    run = forgetting("tune", *options(plant), "--arx", "1-2,1,0-3", *FAST, "--json")
    assert run.code == 0, run.err
    found = json.loads(run.out)
    assert found["orders"] == [1, 1, 2]
    assert found["differences"]["no_forgetting"]["beyond_chance"]
    check_lines(forgetting, found)


def test_lines_of_a_formula_run_as_printed(forgetting, tmp_path):
    random = np.random.default_rng(0)
    x = random.normal(size=700)
    y = np.cumsum(0.1 * random.normal(size=700)) * x + 0.1 * random.normal(size=700)
    path = tmp_path / "x.csv"
    pd.DataFrame({"x": x, "y": y}).to_csv(path, index=False)
    run = forgetting("tune", path, "--formula", "y ~ 0 + x", "--encoding", "utf-8", "--json")
    found = json.loads(run.out)
    assert "--encoding utf-8" in found["command"] and "read(" in found["python"]
    check_lines(forgetting, found)


def test_a_model_without_offset_and_an_ignored_clock(forgetting, plant):
    more = ("--no-offset", "--time", "none", "--gap", "none")
    run = forgetting("tune", *options(plant), *more, "--arx", "1,1,2", *FAST, "--json")
    found = json.loads(run.out)
    for part in ("--no-offset", "--time none", "--gap none"):
        assert part in found["command"]
    assert "offset=False" in found["python"]
    check_lines(forgetting, found)


@pytest.mark.parametrize("name", grid.named_rules("all"))
def test_every_rule_rate_and_prior_is_said_so_that_it_runs(forgetting, battery, name):
    rule = grid.plain_rule(name)
    for values in grid.variants(rule):
        rule = with_values(rule, **values)
    if rule.about["forgetting_factor"]:
        rates = grid.rates(1)
        rule = with_values(rule, forgetting_factor=rates[3 * len(name) % len(rates)])
    usage = Usage(str(battery), "V ~ 0 + lag(V) + I", (), (), True)
    lines = usage.lines(Candidate(rule, (2.5e-7, 1e8)))
    run = forgetting(*shlex.split(lines.command)[1:], "--json")
    assert json.loads(run.out)["rule"] == repr(rule)
    names = {}
    exec(lines.python, names)
    assert repr(names["found"].rule) == repr(rule)
    assert np.allclose(names["found"].initial_covariance, np.diag([2.5e-7, 1e8]))


def test_it_prints_the_choice_its_errors_and_the_lines(forgetting, plant):
    run = forgetting("tune", *options(plant), "--arx", "1,1,2", *FAST)
    assert (run.code, run.err) == (0, "")
    for part in (
        "Chosen on the first part",
        "the bank",
        "samples that no choice has seen",
        "last value",
        "runs over the first part",
        "Diebold-Mariano p = ",
        "To use what was chosen:",
        "To use the bank:",
        "    forgetting identify ",
        "    import forgetting as fg; ",
    ):
        assert part in run.out, part


def test_parameters_that_stand_still_are_told_to_need_no_forgetting(forgetting, battery):
    run = forgetting("tune", battery, "--formula", "V ~ I", "--rules", "none", *FAST)
    assert run.code == 0 and "What was chosen is no forgetting." in run.out


@pytest.mark.parametrize("suffix", ["png", "svg", "pdf"])
def test_the_picture_is_written(forgetting, plant, tmp_path, suffix):
    path = tmp_path / f"factors.{suffix}"
    run = forgetting(
        "tune", *options(plant), "--arx", "1,1,2", *FAST, "--rules", "all", "--plot", path
    )
    assert run.code == 0 and f"wrote {path}" in run.out
    start = {"png": b"\x89PNG", "svg": b"<?xml", "pdf": b"%PDF"}[suffix]
    assert path.read_bytes().startswith(start)


def test_the_picture_has_a_line_for_each_rule_with_a_factor():
    from forgetting.plot.tuning import factors

    random = np.random.default_rng(0)
    phi = random.normal(size=(600, 2))
    found = fg.tune(phi, phi.sum(axis=1) + random.normal(size=600), rates=False)
    axes = factors(found.trials, found.best)
    labels = [line.get_label() for line in axes.get_lines()]
    assert labels[:3] == ["exponential", "exponential_resetting", "subspace"]
    assert {label.rpartition(" ")[0] for label in labels[3:]} == {
        "the bank",
        "none",
        "random_walk",
        "chosen",
    }
    x, y = axes.get_lines()[0].get_data()
    tried = {
        1 / (1 - t.candidate.rule.forgetting_factor): t.error
        for t in found.trials
        if t.candidate.rule is not None and t.candidate.rule.name == "exponential"
    }
    assert dict(zip(x, y, strict=True)) == tried and list(x) == sorted(x)


@pytest.mark.parametrize(
    ("more", "words"),
    [
        (("--arx", "1,2"), "--arx takes na,nb,nk"),
        (("--arx", "3-1,2,0"), "or a range such as 1-4, but got '3-1,2,0'"),
        (("--arx", "1-10,1-10,0-3"), "400 models are to be tried, allowed: 1 to 300"),
        (("--arx", "1,0,0"), "nb is 0 where there is no input"),
        (("--rules", "nothing"), "rule = 'nothing', allowed: shortlist, all"),
        (("--rules", ","), "--rules names no rule"),
        (("--share", "1.5"), "share = 1.5, allowed: between 0 and 1"),
        (("--share", "0.99"), "to report on; at least 50 and 30 are needed"),
        (("--plot", "x.html"), "--plot writes .png, .svg, .pdf"),
        (("--formula", "y ~ x", "--arx", "1,1,1"), "not both"),
    ],
)
def test_bad_input_is_one_sentence(forgetting, plant, more, words):
    assert words in forgetting("tune", *options(plant), *more).sentence()


def test_a_model_must_be_said(forgetting, plant):
    assert "say the model" in forgetting("tune", plant).sentence()


def test_show_only_says_how_the_record_is_read(forgetting, plant):
    run = forgetting("tune", *options(plant), "--show")
    assert run.code == 0 and "clock" in run.out and "Diebold" not in run.out


def test_a_rate_is_an_option_of_identify(forgetting, battery):
    model = ("identify", battery, "--formula", "V ~ I", "--json", "--rule", "exponential")
    run = forgetting(*model, "--rate", "noise_power:ratio=2,smallest=0.8")
    assert json.loads(run.out)["rule"] == repr(
        fg.Exponential(fg.NoisePower(ratio=2.0, smallest=0.8))
    )
    for text, words in (
        ("nonsense", "there is no rate 'nonsense'"),
        ("function", "there is no rate 'function'"),
        ("f_test:depth=1", "the rate 'f_test' has no parameter 'depth'; it has sensitivity"),
        ("f_test:sensitivity", "--rate takes name=value"),
    ):
        assert words in forgetting(*model, "--rate", text).sentence()
    certified = ("certify", *model[1:-2], "--rule", "exponential", "--rate")
    assert forgetting(*certified, "f_test").code == 0
    assert "no rate 'nonsense'" in forgetting(*certified, "nonsense").sentence()
    both = forgetting(*model, "--rate", "f_test", "--forgetting-factor", "0.9")
    assert "say --forgetting-factor or --rate, not both" in both.sentence()
