"""The judge: for each finding a record that deserves it, and one that does not."""

from __future__ import annotations

import json

import numpy as np
import pandas as pd
import pytest

import forgetting as fg
from forgetting.cli.app import run
from forgetting.judgement import accuracy, inputs, poles, residuals
from forgetting.record import identify

SAMPLES = 2000


def coloured(random, pole, samples=SAMPLES):
    """Noise of variance 1 whose neighbours correlate at `pole`."""
    noise = np.zeros(samples)
    for k in range(1, samples):
        noise[k] = pole * noise[k - 1] + np.sqrt(1 - pole**2) * random.normal()
    return noise


def regression(pole=0.0, noise=0.5, seed=0):
    random = np.random.default_rng(seed)
    x = random.normal(size=SAMPLES)
    return pd.DataFrame({"x": x, "y": 1 + 2 * x + noise * coloured(random, pole)})


def plant(a=0.8, delay=1, seed=0, noise=0.1, samples=SAMPLES):
    """y(k) = a y(k-1) + u(k - delay) + noise."""
    random = np.random.default_rng(seed)
    u, y = random.normal(size=samples), np.zeros(samples)
    for k in range(delay, samples):
        y[k] = a * y[k - 1] + u[k - delay] + noise * random.normal()
    return pd.DataFrame({"u": u, "y": y})


def judged(frame, formula="y ~ x", **more):
    return identify(frame, formula=formula, **more).judgement


def judged_arx(frame, arx=(1, 1, 1), **more):
    return identify(frame, output="y", input="u", arx=arx, **more).judgement


@pytest.mark.parametrize("rule", ["auto", "subspace", "none", "exponential"])
def test_a_right_model_is_good(rule):
    for found in (judged(regression(), rule=rule), judged_arx(plant(), rule=rule)):
        assert found.severity == "good", found.sentences()
        assert found.first is None and found.verdict.startswith("Good")


def test_errors_that_follow_from_their_past_are_wrong_whatever_the_excitation():
    found = judged(regression(0.99), rule="subspace")
    assert found["residuals"].severity == "wrong"
    assert found["excitation"].severity == found["windup"].severity == "good"
    assert found.first is not None and found.first.name == "residuals"
    assert "Add past outputs" in found.verdict


@pytest.mark.parametrize(
    ("pole", "severity"), [(0.0, "good"), (0.15, "good"), (0.6, "warning"), (0.99, "wrong")]
)
def test_whiteness_is_judged_by_the_size_of_the_effect(pole, severity):
    assert judged(regression(pole), rule="none")["residuals"].severity == severity


def test_a_hundred_thousand_samples_do_not_make_a_small_effect_large():
    noise = coloured(np.random.default_rng(0), 0.1, 100_000)
    found = residuals.own_past(noise)
    assert found is not None and found.probability < 1e-9
    assert residuals.whiteness(found, "y").severity == "good"


def test_the_share_is_that_of_the_process():
    """Of an autoregression with the pole p its past explains p² of the variance."""
    for pole in (0.3, 0.8, 0.95):
        found = residuals.own_past(coloured(np.random.default_rng(1), pole, 50_000))
        assert found.share == pytest.approx(pole**2, abs=0.02)
        assert found.correlation == pytest.approx(pole, abs=0.02)


def test_the_test_rejects_white_noise_as_often_as_it_says():
    """Over 400 white records probabilities below 5 %: 20 expected, standard deviation 4.4."""
    random = np.random.default_rng(2)
    below = sum(residuals.own_past(random.normal(size=500)).probability < 0.05 for _ in range(400))
    assert below <= 20 + 4 * 4.4


def test_estimated_output_lags_take_degrees_of_freedom():
    """Errors of a fitted autoregression are too white for a test that does not know of the fit."""
    random, right, naive = np.random.default_rng(3), [], []
    for _ in range(100):
        y = coloured(random, 0.5, 400)
        phi = np.column_stack([y[2:-1], y[1:-2], y[:-3]])
        error = y[3:] - phi @ np.linalg.lstsq(phi, y[3:], rcond=None)[0]
        right.append(residuals.own_past(error, 3).probability)
        naive.append(residuals.own_past(error, 0).probability)
    assert np.mean(np.array(right) < 0.5) > np.mean(np.array(naive) < 0.5)


def test_gaps_are_no_correlation():
    noise = np.random.default_rng(4).normal(size=4000)
    noise[::3] = np.nan
    assert residuals.whiteness(residuals.own_past(noise), "y").severity == "good"


def test_a_delay_that_is_wrong_is_found_in_the_inputs():
    late = judged_arx(plant(delay=3), arx=(1, 1, 1), rule="none")
    assert late["inputs"].severity == "wrong" and "u" in late["inputs"].text
    assert judged_arx(plant(delay=3), arx=(1, 1, 3), rule="none")["inputs"].severity == "good"


def test_an_input_that_correlates_with_itself_is_no_cause():
    random = np.random.default_rng(5)
    share, chance = inputs.explained(random.normal(size=5000), coloured(random, 0.99, 5000))
    assert share < 0.01 and chance > 1e-3


def test_a_model_that_diverges_is_wrong():
    found = judged_arx(plant(a=1.01, samples=400), rule="none")
    assert found["poles"].severity == "wrong" and "1.0098" in found["poles"].text
    assert judged_arx(plant(a=0.99), rule="none")["poles"].severity == "good"


def test_poles_of_several_outputs_act_on_one_another():
    """Each output alone decays; together they grow: eigenvalues 0.5 ± 0.6."""
    across = np.array([[[0.5, 0.6], [0.6, 0.5]]])
    assert poles.largest_pole(across) == pytest.approx(1.1)
    assert poles.poles(across).severity == "wrong"
    assert poles.poles(0.8 * across).severity == "good"


def test_lags_of_a_formula_have_poles_too():
    found = judged(plant(a=1.01, samples=400), "y ~ 0 + lag(y) + lag(u)", rule="none")
    assert found["poles"].severity == "wrong"


def test_windup_is_wrong_while_it_lasts():
    frame = regression()
    quiet = frame.copy()
    quiet.loc[1000:1399, ["x", "y"]] = 0.0
    formula = "y ~ 0 + x"
    lasting = judged(quiet.head(1400), formula, rule=fg.Exponential(0.9))
    assert lasting["windup"].severity == "wrong" and lasting.first.name in ("windup", "residuals")
    gone = judged(quiet, formula, rule=fg.Exponential(0.9))
    assert gone["windup"].severity == "warning"
    assert judged(quiet, formula, rule=fg.Subspace(0.9))["windup"].severity == "good"


def test_a_parameter_that_is_silent_at_the_end_is_named():
    frame = regression().assign(z=np.random.default_rng(6).normal(size=SAMPLES))
    frame.loc[1500:, "z"] = 0.0
    found = judged(frame, "y ~ x + z", rule=fg.Subspace(0.98))
    assert found["excitation"].severity == "warning"
    assert (
        "z" in found["excitation"].text and "x" not in found["excitation"].text.split("z")[0][-9:]
    )


def test_a_short_memory_is_told():
    found = judged(regression(), rule=fg.Exponential(0.4))
    assert found["memory"].severity == "wrong"
    assert judged(regression(), rule=fg.Exponential(0.8))["memory"].severity == "warning"
    assert judged(regression(), rule=fg.Exponential(0.95))["memory"].severity == "good"


def test_a_bank_that_follows_the_output_does_not_explain_it():
    """A level that wanders by more than the noise: its last samples predict, and say little."""
    random = np.random.default_rng(10)
    x, level = random.normal(size=SAMPLES), np.cumsum(random.normal(size=SAMPLES))
    found = judged(pd.DataFrame({"x": x, "y": 0.1 * x + level}))
    assert found["memory"].severity == "wrong" and "carried by forgetting" in found["memory"].text


def test_noise_that_grows_makes_intervals_too_narrow():
    frame = regression()
    noise = frame["y"] - 1 - 2 * frame["x"]
    frame["y"] += noise * np.exp(np.arange(SAMPLES) / 200)
    assert judged(frame, rule="none")["intervals"].severity == "wrong"
    assert judged(regression(), rule="none")["intervals"].severity == "good"


def test_coverage_by_hand():
    errors = np.r_[np.full(90, 1.0), np.full(10, 3.0)]
    found = accuracy.intervals(errors, np.ones(100), "y")
    assert found.severity == "good" and "90.0%" in found.text
    assert accuracy.intervals(errors[30:], np.ones(70), "y").severity == "warning"
    assert accuracy.intervals(errors, np.full(100, np.nan), "y") is None


def test_a_model_of_unrelated_columns_is_of_no_use():
    random = np.random.default_rng(7)
    frame = pd.DataFrame(random.normal(size=(SAMPLES, 2)), columns=["x", "y"])
    found = judged(frame, rule="exponential")
    assert found["baselines"].severity == "wrong" and "mean" in found["baselines"].text


def test_an_input_that_brings_nothing_is_told():
    frame = plant()
    frame["u"] = np.random.default_rng(8).normal(size=SAMPLES)
    found = judged_arx(frame, rule="none")
    assert found["baselines"].severity == "warning" and "inputs bring nothing" in str(
        found["baselines"]
    )


def test_repeating_the_last_value_can_be_better():
    random = np.random.default_rng(9)
    slow = np.cumsum(random.normal(size=SAMPLES))
    x = random.normal(size=SAMPLES)
    found = judged(pd.DataFrame({"x": x, "y": 0.2 * x + slow}), rule=fg.Exponential(0.99))
    assert found["baselines"].severity == "warning"


def test_few_samples_are_no_basis():
    assert judged(regression().head(8))["memory"].severity == "warning"


def test_errors_of_rounding_are_not_judged():
    frame = regression(noise=0.0)
    found = judged(frame, rule="none", initial_covariance=1e12)
    assert found["residuals"].severity == "good"


@pytest.mark.parametrize("unit", [1e-9, 1e6])
@pytest.mark.parametrize("pole", [0.0, 0.6, 0.99])
def test_units_change_no_verdict(pole, unit):
    frame = regression(pole)
    scaled = frame.assign(x=frame["x"] * unit, y=frame["y"] / unit)
    one, other = judged(frame), judged(scaled)
    assert [(f.name, f.severity) for f in one.findings] == [
        (f.name, f.severity) for f in other.findings
    ]


def test_every_place_says_the_same(tmp_path, capsys):
    from forgetting.report import save

    path = tmp_path / "record.csv"
    regression(0.99).to_csv(path, index=False)
    rule = ["--rule", "none"]
    arguments = [str(path), "-f", "y ~ x", *rule]
    assert run(["identify", *arguments, "--json"]) == 0
    one = json.loads(capsys.readouterr().out)["judgement"]
    run(["certify", *arguments, "--json"])
    two = json.loads(capsys.readouterr().out)["judgement"]
    assert one == two and one["severity"] == "wrong" and one["first"] == "residuals"
    for command in ("identify", "certify"):
        run([command, *arguments])
        printed = capsys.readouterr().out
        assert one["verdict"] in printed
        assert all(finding["text"] in printed for finding in one["findings"])
    save(identify(path, formula="y ~ x", rule="none"), tmp_path / "page.html")
    page = (tmp_path / "page.html").read_text(encoding="utf-8")
    assert one["verdict"] in page and "No windup" in page
