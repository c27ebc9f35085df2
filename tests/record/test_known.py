"""What is known of parameters: fixed values, bounds and priors, by name."""

from __future__ import annotations

import numpy as np
import pandas as pd
import pytest
from scipy.optimize import lsq_linear

import forgetting as fg
from forgetting.record import RecordError, identify
from forgetting.record.known import Known

FORMULA = "V ~ I + T"
RULES = ["auto", "none", fg.Exponential(0.99)]
PRIOR = 1e-3
"""Of a standard deviation: what P before the first sample, 1e5, adds to what is known."""


@pytest.fixture
def cell() -> pd.DataFrame:
    """A voltage at a current that hardly varies, at a temperature in kelvin."""
    rng = np.random.default_rng(4)
    current = 1.0 + 0.01 * rng.normal(size=300)
    kelvin = 300.0 + rng.normal(size=300)
    voltage = 3.7 - 0.05 * current + 0.002 * kelvin + 0.01 * rng.normal(size=300)
    return pd.DataFrame({"I": current, "T": kelvin, "V": voltage})


def values(found) -> dict[str, float]:
    return dict(zip(found.parameters["parameter"], found.parameters["value"], strict=True))


def dense(cell):
    phi = np.column_stack([np.ones(len(cell)), cell["I"], cell["T"]])
    return phi, cell["V"].to_numpy()


@pytest.mark.parametrize("rule", RULES)
def test_a_fixed_parameter_is_taken_from_the_output(cell, rule):
    found = identify(cell, formula=FORMULA, fixed={"T": 0.002}, rule=rule)
    rest = cell.assign(V=cell["V"] - 0.002 * cell["T"])
    expected = identify(rest, formula="V ~ I", rule=rule)
    assert np.array_equal(found.theta, expected.theta)
    assert np.array_equal(found.trace.error, expected.trace.error, equal_nan=True)
    assert found.prediction[5:, 0] == pytest.approx(
        expected.prediction[5:, 0] + 0.002 * cell["T"][5:], rel=1e-12
    )
    assert found.parameters.iloc[-1].tolist() == ["V", "T", 0.002, 0.0, None, "given"]


def test_a_constant_and_a_lag_can_be_fixed(cell):
    rng = np.random.default_rng(5)
    y = np.zeros(400)
    u = rng.normal(size=400)
    for k in range(1, 400):
        y[k] = 0.8 * y[k - 1] + 0.5 * u[k - 1] + 3.0 + 0.01 * rng.normal()
    table = pd.DataFrame({"u": u, "y": y})
    given = {"y(k-1)": 0.8, "offset": 3.0}
    found = identify(table, output="y", input="u", arx=(1, 1, 1), fixed=given)
    assert values(found)["u(k-1)"] == pytest.approx(0.5, abs=0.005)
    assert list(values(found)) == ["u(k-1)", "y(k-1)", "offset"]
    second = identify(table, output="y", input="u", arx=(2, 1, 1), fixed={"y(k-1)": 1.2})
    # the poles are those of all lags: z² = 1.2 z + a2
    a2 = values(second)["y(k-2)"]
    pole = np.abs(np.roots([1.0, -1.2, -a2])).max()
    assert f"{pole:.4f}" in second.judgement["poles"].text


@pytest.mark.parametrize("offset", [0.0, 5.0])
def test_a_prior_is_what_bayes_makes_of_it(cell, offset):
    prior = {"I": (-0.1 + offset, 0.03), "T": (0.004, 0.0005)}
    found = identify(cell, formula=FORMULA, prior=prior, noise=0.01, rule="none")
    phi, y = dense(cell)
    information = phi.T @ phi / 0.01**2
    right = phi.T @ y / 0.01**2
    for i, (value, deviation) in ((1, prior["I"]), (2, prior["T"])):
        information[i, i] += deviation**-2
        right[i] += value / deviation**2
    expected = np.linalg.solve(information, right)
    spread = np.sqrt(np.diag(np.linalg.inv(information)))
    assert np.abs(found.theta[-1, :, 0] - expected).max() < PRIOR * np.max(spread)
    assert np.abs((found.theta[-1, :, 0] - expected) / spread).max() < PRIOR
    claimed = np.sqrt(np.diag(found.trace.covariance)) * 0.01
    assert claimed == pytest.approx(spread, rel=PRIOR)


def test_a_prior_of_the_constant(cell):
    found = identify(
        cell, formula="V ~ I", prior={"Intercept": (4.3, 0.01)}, noise=0.01, rule="none"
    )
    phi, y = dense(cell)
    phi = phi[:, :2]
    information = phi.T @ phi / 0.01**2 + np.diag([1e4, 0.0])
    expected = np.linalg.solve(information, phi.T @ y / 0.01**2 + [4.3 * 1e4, 0.0])
    spread = np.sqrt(np.diag(np.linalg.inv(information)))
    assert np.abs((found.theta[-1, :, 0] - expected) / spread).max() < PRIOR


@pytest.mark.parametrize("rule", RULES)
def test_before_the_first_sample_only_the_prior_speaks(cell, rule):
    silent = cell.assign(I=0.0)
    found = identify(silent, formula="V ~ 0 + I + T", prior={"I": (0.3, 0.1)}, rule=rule)
    assert found.theta[:, 0, 0] == pytest.approx(0.3, rel=1e-12)


def test_the_noise_is_found_in_the_record(cell):
    found = identify(cell, formula=FORMULA, prior={"I": (-0.05, 0.01)}, rule="none")
    assert found.known.noise == pytest.approx(0.01, rel=0.15)
    assert found.summary()["known"]["noise"] == found.known.noise


@pytest.mark.parametrize("formula", ["V ~ 0 + I + T", "V ~ I + T"])
def test_bounds_are_those_of_a_solver(cell, formula):
    constant = formula == FORMULA
    bounds = {"I": (None, -0.2), "T": (0.0025, 0.0040)}
    if constant:
        bounds["Intercept"] = (3.3, 3.4)
    found = identify(cell, formula=formula, bounds=bounds, rule="none", initial_covariance=1e9)
    phi, y = dense(cell)
    names = ["Intercept", "I", "T"] if constant else ["I", "T"]
    lower, upper = Known(bounds=bounds).limits(names)
    solved = lsq_linear(phi[:, 0 if constant else 1 :], y, (lower, upper), method="bvls").x
    assert found.theta[-1, :, 0] == pytest.approx(solved, rel=1e-4)
    theta = found.theta[:, :, 0]
    assert ((theta >= lower) & (theta <= upper)).all()


@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize("dtype", ["float64", "float32"])
def test_bounds_hold_at_every_sample_and_change_no_error(cell, rule, dtype):
    bounds = {"I": (0.0, 0.5), "Intercept": (None, 3.9)}
    found = identify(cell, formula=FORMULA, bounds=bounds, rule=rule, dtype=dtype)
    free = identify(cell, formula=FORMULA, rule=rule, dtype=dtype)
    lower, upper = found.known.limits(found.samples.regressors)
    theta = found.theta[:, :, 0]
    assert ((theta >= lower) & (theta <= upper)).all()
    assert np.array_equal(found.trace.error, free.trace.error, equal_nan=True)
    inside = ((free.theta[:, :, 0] >= lower) & (free.theta[:, :, 0] <= upper)).all(axis=1)
    assert np.array_equal(found.theta[inside], free.theta[inside])
    assert not inside.all()


@pytest.mark.parametrize("rule", RULES)
def test_units_do_not_matter(cell, rule):
    known = {
        "bounds": {"I": (-0.2, -0.04)},
        "prior": {"I": (-0.1, 0.02)},
        "fixed": {"T": 0.002},
    }
    other = {
        "bounds": {"I": (-0.2 * 1e3, -0.04 * 1e3)},
        "prior": {"I": (-0.1 * 1e3, 0.02 * 1e3)},
        "fixed": {"T": 0.002 * 1e6},
    }
    found = identify(cell, formula=FORMULA, rule=rule, **known)
    # I in kA and V in µV: a coefficient of V over A is 1e6 times 1e3 of µV over kA
    scaled = cell.assign(I=cell["I"] * 1e3, V=cell["V"] * 1e6)
    again = identify(scaled, formula=FORMULA, rule=rule, **other)
    assert again.theta[:, 1] == pytest.approx(found.theta[:, 1] * 1e3, rel=1e-9)
    assert again.prediction[3:] == pytest.approx(found.prediction[3:] * 1e6, rel=1e-9)


@pytest.mark.parametrize(
    ("known", "words"),
    [
        ({"bounds": {"R": (0, 1)}}, "no parameter 'R'; the parameters are 'Intercept', 'I', 'T'"),
        ({"fixed": {"intercept": 1.0}}, "close are 'Intercept'"),
        ({"bounds": {"I": (1, 0)}}, "bounds of 'I' are 1 and 0"),
        ({"bounds": {"I": (np.nan, 0)}}, "bounds of 'I' are nan"),
        ({"bounds": {"I": 3}}, "bounds of 'I' are 3; allowed: two numbers"),
        ({"fixed": {"I": np.inf}}, "fixed value of 'I' is inf"),
        ({"fixed": {"I": 1.0}, "bounds": {"I": (0, 1)}}, "'I' is fixed; it takes no bounds"),
        ({"fixed": {"I": 1.0, "T": 1.0, "Intercept": 0.0}}, "every parameter is fixed"),
        ({"prior": {"I": (1.0, 0.0)}}, "standard deviation of the prior of 'I' is 0.0"),
        ({"prior": {"I": (1.0, 0.1)}, "noise": -1.0}, "the noise is -1.0"),
    ],
)
def test_what_is_refused_is_named(cell, known, words):
    with pytest.raises(RecordError, match=words.replace("(", r"\(")):
        identify(cell, formula=FORMULA, **known)


def test_what_does_not_take_it_says_so(cell):
    table = cell.assign(W=cell["V"] + 1.0)
    with pytest.raises(RecordError, match="a model with one output; this one has 2"):
        identify(table, formula="V + W ~ I", fixed={"I": 1.0})
    with pytest.raises(RecordError, match="the parameters are 'I\\(k-1\\)'"):
        identify(table, output="V", input="I", model="oe:nb=1,nf=1", bounds={"I": (0, 1)})
    with pytest.raises(RecordError, match="does not tell the noise"):
        identify(cell[:2], formula="V ~ 0 + I", prior={"I": (0.0, 1.0)})
    with pytest.raises(RecordError, match="function of yours needs the noise"):
        gate = fg.gate("dead_zone", width=1)
        rule = fg.Exponential(lambda evidence: 0.99)
        identify(cell, formula=FORMULA, rule=rule, gate=gate, prior={"I": (0.0, 1.0)})
