"""`forgetting identify --model`: structures whose noise is not white."""

from __future__ import annotations

import json

import numpy as np
import pandas as pd
import pytest

import forgetting as fg
from forgetting import plot
from forgetting.cli import main
from forgetting.record.identify import identify
from forgetting.words.errors import RecordError

ORDERS = "armax:na=1,nb=1,nc=1,nk=1"


@pytest.fixture(scope="module")
def frame():
    """y = 0.9 y(k-1) + u(k-1) + e + 0.6 e(k-1) about an operating point, by a clock with a gap."""
    u, e = np.random.default_rng(0).normal(size=(2, 3000))
    y = np.zeros(3000)
    for k in range(1, 3000):
        y[k] = 0.9 * y[k - 1] + u[k - 1] + e[k] + 0.6 * e[k - 1]
    t = np.arange(3000.0)
    t[2000:] += 100.0
    return pd.DataFrame({"t": t, "u": u + 20.0, "y": y + 300.0})


def test_it_finds_what_arx_cannot(frame):
    found = identify(frame, output="y", input="u", model=ORDERS)
    arx = identify(frame, output="y", input="u", arx=(1, 1, 1))
    values = found.parameters.set_index("parameter")["value"]
    assert list(values.index) == ["y(k-1)", "u(k-1)", "e(k-1)", "offset"]
    assert values[["y(k-1)", "u(k-1)", "e(k-1)"]].tolist() == pytest.approx([0.9, 1, 0.6], abs=0.06)
    assert values["offset"] == pytest.approx(300 * 0.1 - 20, abs=6)
    assert found.scores.model[0] < 0.95 * arx.scores.model[0]
    assert found.scores.mean[0] == pytest.approx(frame["y"].std(), rel=0.01)
    assert {finding.name for finding in arx.judgement.findings if finding.severity != "good"} & {
        "residuals",
        "inputs",
    }
    assert all(finding.severity == "good" for finding in found.judgement.findings)


def test_the_judge_knows_which_regressors_are_measured(frame):
    """Past noise is no input, and past outputs make poles."""
    found = identify(frame, output="y", input="u", model=ORDERS).judgement
    assert "follows from the past of u(k-1)" in str(found["inputs"])
    modulus = float(str(found["poles"]).split("modulus ")[1].rstrip("."))
    assert modulus == pytest.approx(0.9, abs=0.03)
    early = identify(frame, output="y", input="u", model="armax:na=1,nb=1,nc=1,nk=0").judgement
    assert early["inputs"].severity == "warning"
    assert "Add past values of u(k)" in str(early["inputs"])


def test_a_gap_of_the_clock_is_left_out(frame):
    found = identify(frame, output="y", input="u", model=ORDERS)
    # the first, and that after the gap
    assert (found.used, found.missing) == (2998, 2)
    assert np.isnan(found.trace.error[[0, 2000]]).all()


def test_estimates_are_those_of_the_class(frame):
    record = frame.drop(columns="t")
    found = identify(record, output="y", input="u", model=ORDERS, rule=fg.Subspace(0.99))
    plain = fg.ARMAX(na=1, nb=1, nc=1, offset=True, rule=fg.Subspace(0.99))
    course = plain.course(record["u"], record["y"], ("theta", "error"))
    assert np.array_equal(found.theta[:, :, 0], course["theta"])
    assert np.array_equal(found.trace.error[:, 0], course["error"], equal_nan=True)
    errors = found.parameters.set_index("parameter")["standard_error"]
    assert errors.notna().all()
    drawn = plot.prediction(found).lines
    assert all(line.get_ydata().min() > 250 for line in drawn)
    table = found.estimates()
    assert table["measured:y"].tolist() == record["y"].tolist()


def test_a_linear_structure_is_arx(frame):
    by_model = identify(frame, output="y", input="u", model="arx:na=2,nb=1,nk=1")
    by_orders = identify(frame, output="y", input="u", arx=(2, 1, 1))
    assert np.array_equal(by_model.theta, by_orders.theta)


@pytest.mark.parametrize(
    ("said", "words"),
    [
        ({"model": "armaxx"}, "armaxx.* not known; there are: fir, ar"),
        ({"model": "oe:nb"}, "not an order; write oe:nb=1,nf=1,nk=1"),
        ({"model": "oe:na=1"}, "has no na; it has nb, nf, nk"),
        ({"model": "oe", "arx": (1, 1, 1)}, "say the model once"),
        ({"model": "oe", "half_life": 10}, "forgets by samples"),
        ({"model": "fir:nb=1/2"}, r"nb has 2 orders for 1 input\(s\): u"),
        ({"model": "arx:na=1/2"}, "na=1/2 in the model arx; na is one number"),
        ({"model": "armax:nc=1/2"}, "only nb, nf, nk may be different"),
        ({"model": "fir:nb=1/"}, "'nb=1/' is not an order; write fir:nb=1,nk=1, with nb=2/1"),
        ({"model": "oe", "output": ["y", "t"]}, "has one output; 2 columns"),
    ],
)
def test_what_is_refused_is_named(frame, said, words):
    with pytest.raises(RecordError, match=words):
        identify(frame, **{"output": "y", "input": "u"} | said)


def test_the_command_takes_it(frame, tmp_path, capsys):
    frame.to_csv(tmp_path / "r.csv", index=False)
    page = tmp_path / "r.html"
    options = ["-y", "y", "-u", "u", "--model", ORDERS, "--report", str(page), "--json"]
    assert main(["identify", str(tmp_path / "r.csv"), *options]) == 0
    said = json.loads(capsys.readouterr().out)
    assert said["model"] == "ARMAX(na=1, nb=1, nc=1, nk=1) of y on u"
    assert "ARMAX" in page.read_text(encoding="utf-8")
