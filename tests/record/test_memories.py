"""Which memory of the bank fitted when, in samples and in time; forgetting by the clock."""

from __future__ import annotations

import json

import numpy as np
import pandas as pd
import pytest
from matplotlib import pyplot as plt

import forgetting as fg
from forgetting import plot
from forgetting.cli.app import run
from forgetting.record import identify
from forgetting.record.memories import length
from forgetting.record.moved import Moved
from forgetting.record.samples import Samples
from forgetting.words.errors import RecordError


def walking(steps: float, samples: int = 6000, clock: float | None = None) -> pd.DataFrame:
    """y = θ x + noise of variance 1, θ a random walk with steps of this variance."""
    random = np.random.default_rng(3)
    theta = 5 + np.cumsum(np.sqrt(steps) * random.normal(size=samples))
    x = random.normal(size=samples)
    frame = pd.DataFrame({"x": x, "y": theta * x + random.normal(size=samples)})
    if clock is not None:
        frame.insert(0, "time_s", clock * np.arange(samples))
    return frame


def best_memory(steps: float) -> float:
    """Of the Kalman filter in its steady state, regressor 1: (1 + P)/P where P = P/(1+P) + q."""
    before = steps / 2 + np.sqrt(steps**2 / 4 + steps)
    return (1 + before) / before


@pytest.mark.parametrize("steps", [1e-2, 1e-4])
def test_the_memory_is_that_of_the_filter_that_knows_the_steps(steps):
    found = identify(walking(steps), formula="y ~ 0 + x").memories
    low, typical, high = found.quartiles()
    assert low <= typical <= high
    assert best_memory(steps) / 4 < typical < 4 * best_memory(steps)
    assert "The parameters change within about" in found.describe()


def test_parameters_that_stand_still_are_said_to():
    found = identify(walking(0.0), formula="y ~ 0 + x").memories
    assert "hardly change" in found.describe() and "all 6000 samples" in found.describe()


def test_a_record_in_which_the_speed_changes():
    frame = pd.concat([walking(1e-5, 8000), walking(0.3, 8000)], ignore_index=True)
    found = identify(frame, formula="y ~ 0 + x").memories
    assert "In the course of the record from" in found.describe()
    settled = found.typical[found.rows > 1000]
    rows = found.rows[found.rows > 1000]
    assert np.median(settled[rows < 8000]) > 10 * np.median(settled[rows > 9000])


def test_the_clock_turns_samples_into_time():
    found = identify(walking(1e-2, clock=2.0), formula="y ~ 0 + x")
    told = found.memories.to_dict()
    for part, samples in told["samples"].items():
        assert told["seconds"][part] == pytest.approx(2.0 * samples)
    assert " s)" in told["in_words"] and "samples (" in found.rule_in_words
    assert identify(walking(1e-2), formula="y ~ 0 + x").memories.to_dict()["seconds"] is None


@pytest.mark.parametrize("noise", [1e-4, 1e-2, 1.0])
def test_the_memory_of_a_member(noise):
    ones = Moved(Samples(np.ones((5000, 1)), np.zeros((5000, 1)), ("x",), ("y",), "", None, ""))
    settings = {"targets": 1, "initial_covariance": None, "dtype": "float64"}
    found = length(ones, fg.rule("random_walk", process_noise=noise), settings)
    assert found == pytest.approx(best_memory(noise), rel=1e-6)


def test_weights_along_the_record():
    found = identify(walking(1e-2, 900), formula="y ~ 0 + x")
    known = found.memories
    assert known.weights.shape == (len(known.rows), len(found.members)) == (900, 8)
    np.testing.assert_allclose(known.weights.sum(axis=1), 1.0)
    bank = fg.Bank(1)
    frame = walking(1e-2, 900)
    expected = bank.run(frame[["x"]].to_numpy(), frame["y"].to_numpy(), outputs=("weights",))
    np.testing.assert_array_equal(known.weights, expected.weights)


def test_a_rule_has_no_memories_and_no_picture_of_them():
    found = identify(walking(1e-2, 500), formula="y ~ 0 + x", rule="exponential")
    assert found.memories is None and found.summary()["memories"] is None
    with pytest.raises(ValueError, match="memories are those of a bank"):
        plot.memories(found)


def test_the_picture_has_samples_and_time():
    found = identify(walking(1e-2, 3000, clock=60.0), formula="y ~ 0 + x")
    ax = plot.memories(found)
    other = ax.child_axes[0]
    assert ax.get_yscale() == "log" and ax.get_ylabel() == "memory (samples)"
    assert other.get_ylabel() == "memory (min)"
    ax.figure.canvas.draw()
    assert other.get_ylim() == pytest.approx(ax.get_ylim())  # a sample a minute
    plt.close(ax.figure)


def test_the_command_and_the_page_answer_the_question(tmp_path, capsys):
    path, page = tmp_path / "walking.csv", tmp_path / "page.html"
    walking(1e-2, 2000, clock=2.0).to_csv(path, index=False)
    command = ["identify", str(path), "--formula", "y ~ 0 + x"]
    assert run([*command, "--report", str(page)]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert "The parameters change within about" in said
    text = page.read_text()
    assert "How fast do the parameters change?" in text and "memory (samples)" in text
    assert run([*command, "--json"]) == 0
    told = json.loads(capsys.readouterr().out)["memories"]
    assert told["in_words"] in said


def with_holes() -> pd.DataFrame:
    """A walk of which two rows of three are missing in the second half."""
    frame = walking(1e-2, 3000, clock=2.0)
    late = frame["time_s"] > 3000
    return frame[~late | (frame.index % 3 == 0)].reset_index(drop=True)


@pytest.mark.parametrize("rule", ["auto", "random_walk", "exponential"])
def test_by_the_clock_usual_steps_are_what_counts(rule):
    frame = with_holes()
    found = identify(frame, formula="y ~ 0 + x", rule=rule, by_clock=True)
    estimator = fg.Bank(1) if rule == "auto" else fg.RLS(1, rule=rule)
    expected = estimator.run(
        frame[["x"]].to_numpy(), frame["y"].to_numpy(), time=frame["time_s"].to_numpy() / 2.0
    )
    np.testing.assert_array_equal(found.trace.error[:, 0], expected.error)
    by_samples = identify(frame, formula="y ~ 0 + x", rule=rule)
    assert not np.array_equal(by_samples.trace.error, found.trace.error)


def test_by_an_even_clock_nothing_changes():
    frame = walking(1e-2, 2000, clock=0.1)
    one = identify(frame, formula="y ~ 0 + x")
    other = identify(frame, formula="y ~ 0 + x", by_clock=True)
    np.testing.assert_allclose(other.trace.error, one.trace.error, rtol=1e-6, atol=1e-9)


def test_units_of_the_clock_change_nothing():
    frame = with_holes()
    hours = frame.rename(columns={"time_s": "time_h"})
    hours["time_h"] /= 3600
    one = identify(frame, formula="y ~ 0 + x", by_clock=True)
    other = identify(hours, formula="y ~ 0 + x", by_clock=True)
    np.testing.assert_allclose(other.trace.error, one.trace.error, rtol=1e-6, atol=1e-9)


def test_a_half_life_in_usual_steps_by_the_clock():
    frame = with_holes()
    model = {"formula": "y ~ 0 + x", "rule": "exponential"}
    steps = identify(frame, half_life=50, by_clock=True, **model)
    seconds = identify(frame, half_life="100s", **model)
    np.testing.assert_allclose(steps.trace.error, seconds.trace.error, rtol=1e-4, atol=1e-6)


def test_no_clock_no_time(tmp_path, capsys):
    with pytest.raises(RecordError, match="by_clock needs a clock, and record has none"):
        identify(walking(1e-2, 300), formula="y ~ 0 + x", by_clock=True)
    path = tmp_path / "walking.csv"
    walking(1e-2, 300).to_csv(path, index=False)
    assert run(["identify", str(path), "--formula", "y ~ 0 + x", "--by-clock"]) == 2
    assert "needs a clock" in capsys.readouterr().err
