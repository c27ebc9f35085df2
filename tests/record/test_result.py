"""What an identification says: scores, standard errors, verdicts, files."""

from __future__ import annotations

import json
import math

import numpy as np
import pandas as pd
import pytest

import forgetting as fg
from forgetting.record import RecordError, identify
from forgetting.record import read as forgetting_read


@pytest.fixture
def line() -> pd.DataFrame:
    """y = 1 + 2 x + noise of standard deviation 0.1."""
    rng = np.random.default_rng(3)
    x = rng.normal(size=500)
    return pd.DataFrame({"x": x, "y": 1 + 2 * x + 0.1 * rng.normal(size=500)})


def test_scores_by_hand(line):
    line.loc[50, "y"] = np.nan
    found = identify(line, formula="y ~ x", rule=fg.Exponential(0.97))
    error = found.trace.error[:, 0]
    plain = identify(line, formula="y ~ x", rule="none").trace.error[:, 0]
    y = line["y"].to_numpy()
    last = [y[k] - (y[k - 1] if k != 51 else y[49]) for k in range(2, 500) if k != 50]
    scored = [k for k in range(2, 500) if k != 50]
    assert found.scores.samples == len(scored) == 497
    assert found.scores.model[0] == pytest.approx(math.sqrt(np.mean(error[scored] ** 2)))
    assert found.scores.no_forgetting[0] == pytest.approx(math.sqrt(np.mean(plain[scored] ** 2)))
    assert found.scores.last_value[0] == pytest.approx(math.sqrt(np.mean(np.square(last))))


def test_standard_errors_without_forgetting_are_those_of_least_squares(line):
    found = identify(line, formula="y ~ x", rule="none", initial_covariance=1e6)
    x = np.column_stack([np.ones(500), line.x])
    _, residual, _, _ = np.linalg.lstsq(x, line.y.to_numpy(), rcond=None)
    batch = np.sqrt(residual[0] / 498 * np.diag(np.linalg.inv(x.T @ x)))
    # One-step errors, scaled by 1 + leverage, sum exactly to the residual sum of squares.
    np.testing.assert_allclose(found.standard_error[-1, :, 0], batch, rtol=1e-4)
    assert np.isnan(found.standard_error[:2]).all() and not np.isnan(found.standard_error[2:]).any()


def test_standard_errors_cover():
    """Of 400 runs about 95 % must hold the truth within 1.96 standard errors."""
    rng = np.random.default_rng(4)
    inside = 0
    for _ in range(400):
        x = rng.normal(size=60)
        frame = pd.DataFrame({"x": x, "y": 2 * x + rng.normal(size=60)})
        found = identify(frame, formula="y ~ 0 + x", rule="none").parameters
        inside += abs(found["value"][0] - 2) < 1.96 * found["standard_error"][0]
    # 380 expected; the binomial standard deviation is 4.4.
    assert 362 <= inside <= 394


def test_one_chunk_or_many(line, monkeypatch):
    whole = identify(line, formula="y ~ x")
    monkeypatch.setattr("forgetting.record.trace.CHUNKS", 3)
    calls = []
    pieces = identify(line, formula="y ~ x", progress=lambda done, total: calls.append(done))
    assert calls == [167, 334, 500]
    assert np.array_equal(whole.theta, pieces.theta)
    assert np.array_equal(whole.trace.eigenvalues[-1], pieces.trace.eigenvalues[-1])


def test_excited(line):
    found = identify(line, formula="y ~ x")
    assert "All parameters were excited." in found.verdicts
    assert found.judgement.severity == "good"


def test_zero_regressor_is_named(line):
    found = identify(line.assign(z=0.0), formula="y ~ x + z")
    assert any(text.startswith("Not excited: z;") for text in found.verdicts)


def test_collinear_regressors_are_named(line):
    found = identify(line.assign(z=3 * line.x, w=line.y * 0 + 1), formula="y ~ 0 + x + z + w")
    assert any(text.startswith("Not told apart: x and z;") for text in found.verdicts)


def test_windup_is_told(line):
    quiet = line.copy()
    quiet.loc[200:, ["x", "y"]] = 0.0
    found = identify(quiet, formula="y ~ 0 + x", rule=fg.Exponential(0.9))
    assert any(text.startswith("Windup:") for text in found.verdicts)
    held = identify(quiet, formula="y ~ 0 + x", rule=fg.Subspace(0.9, threshold=1e-3))
    assert held.dead_zone == 300 and held.used == 200
    assert any(text.startswith("300 samples carried less") for text in held.verdicts)
    assert not any(text.startswith("Windup") for text in held.verdicts)


def test_windup_to_the_end_of_the_numbers_is_told(line):
    quiet = pd.DataFrame({"x": np.r_[line.x, np.zeros(20000)], "y": np.r_[line.y, np.zeros(20000)]})
    # 0.9^-k reaches the limit of the core, 3e150, some 3 200 samples after the input went silent.
    found = identify(quiet, formula="y ~ 0 + x", rule=fg.Exponential(0.9))
    assert any(text.startswith("Windup:") for text in found.verdicts)
    assert np.isfinite(found.theta).all()


@pytest.mark.parametrize("suffix", [".csv", ".parquet"])
def test_estimates_round_trip(plant, tmp_path, suffix):
    plant.loc[100, "u1"] = np.nan
    found = identify(plant, output=["y1", "y2"], input="u1", arx=(1, 1, 0))
    path = tmp_path / f"estimates{suffix}"
    found.save_estimates(path)
    read = forgetting_read(path).frame
    assert read["row"].tolist() == list(range(1, 401))
    assert read["skipped"].value_counts().to_dict() == {"used": 398, "missing": 2}
    np.testing.assert_array_equal(read["time"], plant["time"])
    np.testing.assert_array_equal(read["estimate:y2:u1(k)"], found.theta[:, 2, 1])
    np.testing.assert_array_equal(read["standard_error:y1:y1(k-1)"], found.standard_error[:, 0, 0])
    known = read["error:y1"].notna()
    np.testing.assert_allclose(
        read["measured:y1"][known], (read["predicted:y1"] + read["error:y1"])[known], atol=1e-12
    )


def test_estimates_go_to_known_files(line, tmp_path):
    with pytest.raises(RecordError, match=r"to \.parquet or \.csv, but the file is 'e\.xlsx'"):
        identify(line, formula="y ~ x").save_estimates(tmp_path / "e.xlsx")


def test_summary_is_json(line):
    line.loc[:, "z"] = 0.0
    summary = identify(line.head(2), formula="y ~ x + z").summary()
    text = json.dumps(summary, allow_nan=False)
    assert json.loads(text)["parameters"][0]["standard_error"] is None
    assert summary["samples"] == {
        "rows": 2,
        "used": 2,
        "missing": 0,
        "dead_zone": 0,
        "within_bound": 0,
        "held": 0,
        "frozen": 0,
        "scored": 0,
    }


def test_covariance_ratio(line):
    found = identify(line, formula="y ~ x", rule="none", initial_covariance=100.0)
    values = np.linalg.eigvalsh(found.trace.covariance)
    assert found.covariance_ratio == pytest.approx(values[-1] / values[0])
