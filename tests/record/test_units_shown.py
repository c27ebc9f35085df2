"""Units of parameters and axes, signs of lags, and P drawn in the units of the end."""

from __future__ import annotations

import json

import numpy as np
import pandas as pd
import pytest

from forgetting.cli.app import run
from forgetting.plot import parameter, prediction
from forgetting.record import identify, theory
from forgetting.report import save_certificate


@pytest.fixture
def cell(tmp_path):
    """V(k) = 0.9 V(k-1) + 0.4 + 0.05 I(k) + noise, with a row of units."""
    random = np.random.default_rng(0)
    current, voltage = random.normal(size=300), np.full(300, 4.0)
    for k in range(1, 300):
        voltage[k] = 0.9 * voltage[k - 1] + 0.4 + 0.05 * current[k] + 0.001 * random.normal()
    rows = [f"{k},{current[k]:.9f},{voltage[k]:.9f}" for k in range(300)]
    path = tmp_path / "cell.csv"
    path.write_text("\n".join(["time,I,V", "s,A,mV", *rows]) + "\n")
    return path


def test_parameters_have_units_and_the_sign_of_the_pole(cell, tmp_path, capsys):
    arguments = [str(cell), "-y", "V", "-u", "I", "--arx", "1,1,0", "-r", "none"]
    estimates, page = tmp_path / "e.parquet", tmp_path / "p.html"
    files = ["--estimates", str(estimates), "--report", str(page)]
    assert run(["identify", *arguments, "--json", *files]) == 0
    rows = json.loads(capsys.readouterr().out)["parameters"]
    assert [(row["parameter"], row["unit"]) for row in rows] == [
        ("V(k-1)", "1"),
        ("I(k)", "mV/A"),
        ("offset", "mV"),
    ]
    values = [row["value"] for row in rows]
    np.testing.assert_allclose(values[:2], [0.9, 0.05], atol=0.02)
    kept = pd.read_parquet(estimates)
    assert kept["estimate:V(k-1)"].iloc[-1] == values[0]
    assert run(["identify", *arguments]) == 0
    printed = capsys.readouterr().out
    assert "mV/A" in printed and "V [mV]" in printed
    text = page.read_text(encoding="utf-8")
    assert "mV/A" in text and "V [mV]" in text and "V(k-1)" in text and "-V(k-1)" not in text


def test_axes_have_units(cell):
    found = identify(cell, output="V", input="I", arx=(1, 1, 0), rule="none")
    assert prediction(found).get_ylabel() == "V [mV]"
    assert parameter(found, 1).get_title() == "I(k) [mV/A]"


def test_eigenvalues_do_not_step_where_units_are_renewed():
    """Units are renewed at 2n, 4n, 8n ... samples; without excitation P must not move there."""
    random = np.random.default_rng(1)
    x = random.normal(size=(200, 2)) * np.where(np.arange(200) < 4, 1.0, 30.0)[:, None]
    frame = pd.DataFrame({"a": x[:, 0], "b": x[:, 1], "y": x.sum(axis=1)})
    found = identify(frame, formula="y ~ 0 + a + b", rule="none")
    largest = found.trace.eigenvalues[:, -1]
    # P of a rule that never forgets only falls
    assert (np.diff(largest) <= 1e-9 * largest[:-1]).all()


def test_the_page_of_a_certificate(cell, tmp_path, capsys):
    page = tmp_path / "c.html"
    command = ["certify", str(cell), "-y", "V", "-u", "I", "--arx", "1,1,0", "--report", str(page)]
    assert run(command) == 0
    printed, text = capsys.readouterr().out, page.read_text(encoding="utf-8")
    found = identify(cell, output="V", input="I", arx=(1, 1, 0), rule="subspace")
    assert found.judgement.verdict in printed and found.judgement.verdict in text
    for part in ("Stability of the estimator", "A1: F", "When to trust it", "svg"):
        assert part in text
    assert "http:" not in text and "https:" not in text


def test_a_long_record_is_certified_on_its_end(cell, monkeypatch, tmp_path):
    monkeypatch.setattr(theory, "MOST", 900)  # 100 samples of 3 x 3
    found = identify(cell, output="V", input="I", arx=(1, 1, 0), rule="exponential")
    certificate, first = theory.theory(found, "exponential")
    assert first == 200
    assert "on the rows from 201 on" in certificate.theory(first)
    save_certificate(found, certificate, first, tmp_path / "c.html")
    monkeypatch.undo()
    whole, first = theory.theory(found, "exponential")
    assert first == 3  # the inputs speak, and have their priors
    ends = [each.conditions.trajectory.after[-1] for each in (certificate, whole)]
    np.testing.assert_allclose(ends[0], ends[1], rtol=1e-9)
