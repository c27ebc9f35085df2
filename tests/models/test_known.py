"""What is known of the parameters of models with coloured noise: bounds, fixed values, priors."""

from __future__ import annotations

import json

import numpy as np
import pandas as pd
import pytest
from scipy.optimize import lsq_linear

import forgetting as fg
from forgetting._core import SignalModel
from forgetting.cli import main
from forgetting.record import RecordError, identify
from forgetting.stream import Settings, Stream
from reference.polynomial import SYSTEMS, record

ARMAX = "armax:na=1,nb=1,nc=1,nk=1"
NAMES = ["y(k-1)", "u(k-1)", "e(k-1)", "offset"]
RULES = ["none", "auto", fg.Exponential(0.99)]
SAID = {"output": "y", "input": "u", "model": ARMAX}


@pytest.fixture(scope="module")
def frame():
    """y = 0.9 y(k-1) + u(k-1) + e + 0.6 e(k-1) about an operating point."""
    u, e = np.random.default_rng(0).normal(size=(2, 1500))
    y = np.zeros(1500)
    for k in range(1, 1500):
        y[k] = 0.9 * y[k - 1] + u[k - 1] + e[k] + 0.6 * e[k - 1]
    return pd.DataFrame({"u": u + 20.0, "y": y + 300.0})


def values(found):
    return dict(zip(found.parameters["parameter"], found.parameters["value"], strict=True))


@pytest.mark.parametrize("rule", RULES)
def test_a_fixed_parameter_is_that_of_the_output_without_it(frame, rule):
    """With A known, A y is a model without past outputs."""
    frame = frame - [20.0, 300.0]
    found = identify(frame, **SAID, fixed={"y(k-1)": 0.9}, rule=rule, offset=False)
    past = frame["y"].shift(1)
    rest = frame.assign(y=frame["y"] - 0.9 * past)[1:]
    moved = identify(rest, **SAID | {"model": "armax:na=0,nb=1,nc=1,nk=1"}, rule=rule, offset=False)
    assert list(values(found)) == ["u(k-1)", "e(k-1)", "y(k-1)"]
    assert values(found)["y(k-1)"] == 0.9
    # the start fades by the number of parameters, of which one model has one less
    assert found.theta[-1] == pytest.approx(moved.theta[-1], abs=0.01)
    assert found.trace.error[600:] == pytest.approx(moved.trace.error[599:], abs=0.1)


@pytest.mark.parametrize("name", ["armax", "oe", "bj", "arma"])
def test_the_others_are_nearer_where_some_are_fixed(name):
    system = SYSTEMS[name]
    u, y = record(system, 5, 3000)
    table = pd.DataFrame({"y": y} if u is None else {"y": y, "u": np.ravel(u)})
    said = {"output": "y", "input": [c for c in table if c != "y"], "offset": False}
    orders = {"armax": "na=2,nb=2,nc=2,nk=1", "oe": "nb=2,nf=2,nk=1", "arma": "na=1,nc=1"}
    model = f"{name}:{orders.get(name, 'nb=2,nc=2,nd=2,nf=2,nk=1')}"
    free = identify(table, **said, model=model, rule="none")
    names = list(free.samples.regressors)
    if len(names) != len(system.theta):
        pytest.skip("the system has other orders")
    last = {names[-1]: float(system.theta[-1])}
    found = identify(table, **said, model=model, rule="none", fixed=last)
    told = values(found)
    assert told[names[-1]] == system.theta[-1]
    error = [told[each] - true for each, true in zip(names, system.theta, strict=True)]
    assert np.abs(error).max() < 0.15


@pytest.mark.parametrize("offset", [False, True])
def test_a_prior_is_what_bayes_makes_of_it(frame, offset):
    prior = {"y(k-1)": (0.8, 0.02), "e(k-1)": (0.2, 0.05)}
    found = identify(frame, **SAID, prior=prior, noise=1.0, rule="none", offset=offset)
    phi, y = found.samples.phi, found.samples.y[:, 0]
    known = ~np.isnan(y)
    phi, y = phi[known], y[known]
    information, right = phi.T @ phi, phi.T @ y
    for place, name in enumerate(NAMES[:3]):
        if name in prior:
            value, deviation = prior[name]
            information[place, place] += deviation**-2
            right[place] += value / deviation**2
    expected = np.linalg.solve(information, right)[:3]
    spread = np.sqrt(np.diag(np.linalg.inv(information)))[:3]
    assert np.abs((found.theta[-1, :3, 0] - expected) / spread).max() < 2e-3
    before = found.theta[0, :, 0]
    assert (before[0], before[2]) == (0.8, 0.2)


def test_a_prior_of_the_offset_is_that_of_signals_as_they_are(frame):
    truth = 300 * 0.1 - 20
    found = identify(frame, **SAID, prior={"offset": (truth, 1e-6)}, noise=1.0, rule="none")
    assert values(found)["offset"] == pytest.approx(truth, abs=1e-4)
    assert values(found)["y(k-1)"] == pytest.approx(0.9, abs=0.01)
    fixed = identify(frame, **SAID, fixed={"offset": truth}, rule="none")
    assert values(fixed)["y(k-1)"] == pytest.approx(values(found)["y(k-1)"], abs=1e-4)


def test_the_noise_is_found_in_the_record(frame):
    found = identify(frame, **SAID, prior={"y(k-1)": (0.9, 0.1)}, rule="none")
    assert found.known.noise == pytest.approx(1.0, rel=0.1)


def test_bounds_are_those_of_a_solver(frame):
    bounds = {"y(k-1)": (None, 0.85), "e(k-1)": (0.7, 0.8)}
    found = identify(frame, **SAID, bounds=bounds, rule="none", offset=False)
    known = ~np.isnan(found.samples.y[:, 0])
    phi, y = found.samples.phi[known], found.samples.y[known, 0]
    lower, upper = found.known.limits(NAMES[:3])
    solved = lsq_linear(phi, y, (lower, upper), method="bvls").x
    assert found.theta[-1, :, 0] == pytest.approx(solved, rel=1e-3)


@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize("dtype", ["float64", "float32"])
def test_bounds_hold_at_every_sample_and_change_no_error(frame, rule, dtype):
    bounds = {"u(k-1)": (1.05, None), "offset": (9.0, 9.5)}
    found = identify(frame, **SAID, bounds=bounds, rule=rule, dtype=dtype)
    free = identify(frame, **SAID, rule=rule, dtype=dtype)
    lower, upper = found.known.limits(NAMES)
    theta = found.theta[:, :, 0]
    assert ((theta >= lower) & (theta <= upper)).all()
    assert np.array_equal(found.trace.error, free.trace.error, equal_nan=True)
    assert not np.array_equal(found.theta, free.theta)


@pytest.mark.parametrize("rule", ["none", fg.Exponential(0.99)])
def test_bounds_are_fed_back_on_request(frame, rule):
    bounds = {"u(k-1)": (1.05, None), "offset": (None, 12.0)}
    found = identify(frame, **SAID, bounds=bounds, rule=rule, feed_back=True)
    free = identify(frame, **SAID, rule=rule)
    lower, upper = found.known.limits(NAMES)
    theta = found.theta[:, :, 0]
    assert ((theta >= lower) & (theta <= upper)).all()
    assert not np.array_equal(found.trace.error, free.trace.error, equal_nan=True)
    assert found.trace.error[200:, 0].std() < 1.2
    assert found.summary()["known"]["feed_back"] is True


KNOWN = [
    {"fixed": {"y(k-1)": 0.9}},
    {"fixed": {"offset": 10.0}, "bounds": {"e(k-1)": (0.0, 0.4)}},
    {"prior": {"u(k-1)": (1.1, 0.05)}, "noise": 1.0, "bounds": {"offset": (8.0, 9.0)}},
    {"bounds": {"u(k-1)": (1.05, None), "offset": (None, 12.0)}, "feed_back": True},
]


@pytest.mark.parametrize("rule", ["auto", fg.Exponential(0.99)])
@pytest.mark.parametrize("known", KNOWN)
def test_a_stream_is_the_record_and_goes_on(frame, known, rule, tmp_path):
    if rule == "auto" and known.get("feed_back"):
        return
    table = frame[:400].reset_index(drop=True)
    table.loc[100, "y"] = np.nan
    found = identify(table, **SAID, **known, rule=rule)
    settings = Settings(output=("y",), input=("u",), model=ARMAX, rule=rule, **known)
    table.to_csv(tmp_path / "r.csv", index=False)
    with open(tmp_path / "r.csv", "rb") as given:
        every = given.readlines()
    whole = Stream(settings, fields="theta,error,standard_errors")
    lines = whole.feed(b"".join(every)).lines
    first = Stream(settings, fields="theta,error,standard_errors")
    parts = first.feed(b"".join(every[:150])).lines
    second = Stream(settings, fields="theta,error,standard_errors")
    second.restore(json.loads(json.dumps(first.state())))
    for line in every[150:]:
        parts += second.feed(line).lines
    assert parts == lines
    rows = [row for row in map(json.loads, lines) if "alarm" not in row]
    places = [NAMES.index(name) for name in found.samples.regressors]
    theta = np.array([list(row["theta"].values()) for row in rows])
    assert np.array_equal(theta[:, places], found.theta[:, :, 0])
    for name, value in known.get("fixed", {}).items():
        assert (theta[:, NAMES.index(name)] == value).all()
    error = [np.nan if row["error"] is None else row["error"] for row in rows]
    assert np.array_equal(error, found.trace.error[:, 0], equal_nan=True)


def test_units_change_nothing(frame):
    known = {"fixed": {"y(k-1)": 0.9}, "prior": {"u(k-1)": (1.2, 0.05)}, "noise": 1.0}
    other = {"fixed": {"y(k-1)": 0.9}, "prior": {"u(k-1)": (1.2e6, 0.05e6)}, "noise": 1e3}
    bounds = {"e(k-1)": (0.0, 0.3)}
    one = identify(frame, **SAID, **known, bounds=bounds, rule=fg.Exponential(0.99))
    scaled = frame.assign(u=1e-3 * frame["u"], y=1e3 * frame["y"])
    two = identify(scaled, **SAID, **other, bounds=bounds, rule=fg.Exponential(0.99))
    assert two.prediction[5:] == pytest.approx(1e3 * one.prediction[5:], rel=1e-9)
    assert two.theta[:, 1] == pytest.approx(one.theta[:, 1], rel=1e-8)


def test_a_model_keeps_what_is_known_in_its_bytes(frame):
    orders = {"na": 1, "nc": 1, "inputs": [(1, 0, 1)], "constant": True}
    model = SignalModel(**orders, fixed={0: 0.9}, prior={3: 10.0})
    est = fg.RLS(3, rule="none")
    assert (model.parameters, model.estimated) == (4, 3)
    u, y = frame[["u"]].to_numpy(), frame["y"].to_numpy()
    model.learn(est, u[:700], y[:700])
    again, copy = SignalModel.from_bytes(model.to_bytes()), fg.RLS.from_bytes(est.to_bytes())
    one = model.learn(est, u[700:], y[700:], "theta")["theta"]
    assert np.array_equal(again.learn(copy, u[700:], y[700:], "theta")["theta"], one)
    assert (one[:, 0] == 0.9).all()
    plain = SignalModel(**orders)
    assert len(plain.to_bytes()) < len(model.to_bytes())


@pytest.mark.parametrize(
    ("known", "words"),
    [
        ({"bounds": {"b1": (0, None)}}, "no parameter 'b1'"),
        ({"fixed": {"e(k-1)": 1.5}}, "C or F is unstable with the values that are known"),
        ({"prior": {"e(k-1)": (-1.1, 0.1)}, "noise": 1.0}, "C or F is unstable"),
        ({"fixed": dict.fromkeys(NAMES, 0.1)}, "every parameter is fixed"),
        ({"feed_back": True}, "there are none; say bounds"),
        ({"feed_back": True, "bounds": {"u(k-1)": (0, 1)}}, "fed back to one rule; say which"),
    ],
)
def test_what_is_refused_is_named(frame, known, words):
    with pytest.raises((RecordError, fg.InvalidInput), match=words):
        identify(frame, **SAID, **known)


def test_the_command_takes_it(frame, tmp_path, capsys):
    frame.to_csv(tmp_path / "r.csv", index=False)
    said = [str(tmp_path / "r.csv"), "-y", "y", "-u", "u", "--model", ARMAX, "--rule", "none"]
    more = ["--bounds", "u(k-1)=1.05:", "--feed-back", "--fixed", "offset=10", "--json"]
    assert main(["identify", *said, *more]) == 0
    told = json.loads(capsys.readouterr().out)
    found = {each["parameter"]: each for each in told["parameters"]}
    assert found["u(k-1)"]["value"] >= 1.05 and found["offset"]["value"] == 10.0
    assert told["known"]["feed_back"] is True
    assert main(["identify", *said[:-2], "--bounds", "u(k-1)=1.05:", "--feed-back"]) == 2
    error = capsys.readouterr().err
    assert "say which, as the bank mixes several" in error and error.count("\n") == 1
