"""Columns of several rates joined to one clock."""

from __future__ import annotations

import json

import numpy as np
import pandas as pd
import pytest

from forgetting.cli import main
from forgetting.record import at_one_rate, identify, read
from forgetting.words.errors import RecordError


def plant(seconds: int = 600, seed: int = 3) -> tuple[pd.DataFrame, np.ndarray]:
    """y at 10 Hz, u written when it changes, both in one log; and u at 1 Hz."""
    random = np.random.default_rng(seed)
    u = np.repeat(random.normal(size=seconds // 5), 5)
    y = np.zeros(seconds)
    for k in range(1, seconds):
        y[k] = 0.8 * y[k - 1] + 0.5 * u[k - 1]
    # ten readings in each second up to the tick, of which y is the mean
    offsets = random.normal(size=(seconds, 10))
    offsets -= offsets.mean(axis=1, keepdims=True)
    times = np.arange(seconds)[:, None] - np.arange(9, -1, -1) / 10
    fast = pd.DataFrame({"time": times.ravel(), "y": (y[:, None] + 0.1 * offsets).ravel()})
    changes = np.flatnonzero(np.r_[True, np.diff(u) != 0])
    slow = pd.DataFrame({"time": changes + 0.0, "u": u[changes]})
    log = pd.concat([fast[fast["time"] >= 0], slow]).sort_values("time", kind="stable")
    return log.reset_index(drop=True), u


def test_a_model_across_two_rates():
    log, u = plant()
    joined = at_one_rate(read(log), "1s", mean=["y"], hold=["u"])
    assert np.array_equal(joined.frame["u"].to_numpy(), u)
    found = identify(joined, output="y", input="u", arx=(1, 1, 1), offset=False, rule="none")
    np.testing.assert_allclose(found.theta[-1, :, 0], [0.8, 0.5], atol=2e-3)
    with pytest.raises(RecordError, match="no complete sample"):
        identify(read(log), output="y", input="u", arx=(1, 1, 1))


def test_each_way_against_its_definition():
    random = np.random.default_rng(1)
    seconds = np.sort(random.uniform(0.0, 100.0, size=400))
    seconds[0] = 0.0
    columns = {name: np.where(random.random(400) < 0.3, random.normal(size=400), np.nan)
               for name in ("held", "mean", "nearest")}  # fmt: skip
    record = read(pd.DataFrame({"time": seconds, **columns}), "time")
    joined = at_one_rate(record, 2.5, mean=["mean"], nearest=["nearest"], age="1500ms").frame
    assert joined["time"].tolist() == (2.5 * np.arange(len(joined))).tolist()
    for k, tick in enumerate(joined["time"]):
        there = {name: np.isfinite(values) for name, values in columns.items()}
        before = there["held"] & (seconds <= tick) & (seconds >= tick - 1.5)
        held = columns["held"][before][-1] if before.any() else np.nan
        inside = there["mean"] & (seconds > tick - 2.5) & (seconds <= tick)
        mean = columns["mean"][inside].mean() if inside.any() else np.nan
        own = np.where(there["nearest"], np.abs(seconds - tick), np.inf)
        nearest = columns["nearest"][own.argmin()] if own.min() <= 1.5 else np.nan
        row = joined.loc[k, ["held", "mean", "nearest"]].to_numpy(float)
        np.testing.assert_allclose(row, [held, mean, nearest], rtol=1e-12)


def test_dates_stay_dates_and_units_stay():
    times = pd.date_range("2026-10-25T00:00", periods=50, freq="7s")
    frame = pd.DataFrame({"when": times, "x": np.arange(50.0), "word": "a"})
    joined = at_one_rate(read(frame), "21s", mean=["x"])
    assert joined.frame["when"].tolist() == list(times[::3])
    assert joined.frame["x"].tolist() == [0.0, *(3.0 * k - 1 for k in range(1, 17))]
    assert "joined every 21 s (the mean since the last tick of x)" in joined.found.words()
    assert any("word" in text for text in joined.found.skipped)
    assert not joined.clock.is_gap.any()


@pytest.mark.parametrize(
    ("every", "named", "words"),
    [
        ("soon", {}, "every"),
        (0, {}, "every"),
        ("1s", {"hold": ["z"]}, "no column 'z'"),
        ("1s", {"hold": ["y"], "mean": ["y"]}, "'y' is named by hold and by mean"),
        ("1s", {"age": "-1"}, "age"),
        (1e-12, {}, "rows every"),
    ],
)
def test_what_cannot_be_is_refused(every, named, words):
    record = read(pd.DataFrame({"time": np.arange(9.0), "y": np.arange(9.0)}), "time")
    with pytest.raises(RecordError, match=words):
        at_one_rate(record, every, **named)
    with pytest.raises(RecordError, match="no clock"):
        at_one_rate(read(pd.DataFrame({"y": [1.0, 2.0]})), "1s")


def test_on_the_command_line(tmp_path, capsys):
    path = tmp_path / "log.csv"
    plant()[0].to_csv(path, index=False)
    command = ["identify", str(path), "--output", "y", "--input", "u", "--arx", "1,1,1", "--json"]
    command += ["--rule", "none", "--no-offset"]
    assert main([*command, "--every", "1s", "--hold", "u", "--mean", "y"]) == 0
    found = json.loads(capsys.readouterr().out)
    values = [each["value"] for each in found["parameters"]]
    np.testing.assert_allclose(values, [0.8, 0.5], atol=2e-3)
    assert found["read_as"]["joined"].startswith("every 1 s")
    assert main([*command, "--hold", "u"]) == 2
    assert "--every" in capsys.readouterr().err
