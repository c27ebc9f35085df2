"""ARX over a record, against regressors built by hand."""

from __future__ import annotations

import numpy as np
import pytest

import forgetting as fg
from forgetting.record import RecordError, identify


def by_hand(y, u, na, nb, nk):
    """Equation (1) of Zhu, Yu and Wan, one element at a time."""
    rows = []
    for k in range(len(y)):
        row = []
        for lag in range(1, na + 1):
            row += [y[k - lag, j] if k >= lag else np.nan for j in range(y.shape[1])]
        for lag in range(nk, nk + nb):
            row += [u[k - lag, j] if k >= lag else np.nan for j in range(u.shape[1])]
        rows.append(row)
    return np.array(rows)


@pytest.mark.parametrize("orders", [(1, 1, 0), (2, 3, 1), (0, 2, 2), (3, 1, 4)])
def test_regressors_of_two_inputs_and_two_outputs(plant, orders):
    found = identify(plant, output=["y1", "y2"], input=["u1", "u2"], arx=orders, offset=False)
    y, u = plant[["y1", "y2"]].to_numpy(), plant[["u1", "u2"]].to_numpy()
    np.testing.assert_array_equal(found.samples.phi, by_hand(y, u, *orders))


def test_estimates_follow_the_dense_recursion(plant):
    """P-form recursion (9)-(10) of the GF-RLS paper, dense, both outputs at once."""
    found = identify(
        plant,
        output=["y1", "y2"],
        input=["u1", "u2"],
        arx=(1, 1, 1),
        offset=False,
        rule=fg.Exponential(0.95),
        initial_covariance=100.0,
    )
    y, u = plant[["y1", "y2"]].to_numpy(), plant[["u1", "u2"]].to_numpy()
    phi = by_hand(y, u, 1, 1, 1)
    information, theta = np.eye(4) / 100.0, np.zeros((4, 2))
    for k in range(1, len(y)):
        information = 0.95 * information + np.outer(phi[k], phi[k])
        gain = np.linalg.solve(information, phi[k])
        theta = theta + np.outer(gain, y[k] - phi[k] @ theta)
        np.testing.assert_allclose(found.theta[k], theta, rtol=1e-8, atol=1e-8)
    np.testing.assert_allclose(found.trace.covariance, np.linalg.inv(information), rtol=1e-8)


def test_finds_the_plant(plant):
    found = identify(plant, output=["y1", "y2"], input=["u1", "u2"], arx=(1, 1, 1), rule="none")
    truth = {"y1": [0.7, 0.1, 1.0, 0.0, 0.0], "y2": [-0.2, 0.5, 0.5, -0.3, 0.0]}
    table = found.parameters
    for output, values in truth.items():
        rows = table[table["output"] == output]
        names = ["y1(k-1)", "y2(k-1)", "u1(k-1)", "u2(k-1)", "offset"]
        assert rows["parameter"].tolist() == names
        # Four standard errors: one in 16 000 for each of ten values.
        assert (np.abs(rows["value"] - values) < 4 * rows["standard_error"]).all()
    # The noise of the plant has standard deviation 0.01.
    np.testing.assert_allclose(np.sqrt(found.noise_variance[-1]), 0.01, rtol=0.15)


def test_a_missing_cell_breaks_the_lags(plant):
    plant.loc[100, "y1"] = np.nan
    found = identify(plant, output="y1", input="u1", arx=(2, 1, 0))
    # Rows 0 and 1 have no lags; 100 misses its output, 101 and 102 a lag.
    assert np.flatnonzero(found.trace.skipped).tolist() == [0, 1, 100, 101, 102]
    assert (found.used, found.missing) == (395, 5)


def test_a_step_in_time_breaks_the_lags(plant):
    plant.loc[200:, "time"] += 1.0
    found = identify(plant, output="y1", input="u1", arx=(1, 2, 0))
    assert np.flatnonzero(found.trace.skipped).tolist() == [0, 200]


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"output": "y1", "input": "u1", "arx": (1, 1)}, "three whole numbers; got 2"),
        ({"output": "y1", "input": "u1", "arx": (1, -1, 0)}, "nb is -1"),
        ({"output": "y1", "arx": (0, 0, 0)}, "na and nb are both 0"),
        ({"output": "y1", "arx": (1, 1, 0)}, "no input is named"),
        ({"output": "y1", "input": "u1", "arx": (1, 0, 0)}, "nb is 0 but 1 input"),
        ({"output": "y1", "input": "y1", "arx": (1, 1, 0)}, "'y1' is named twice"),
        ({"output": "y1", "input": "u1"}, "say the model"),
        ({"output": "y1", "formula": "y1 ~ u1"}, "not both"),
        ({}, "say the model"),
        ({"output": "y1", "arx": (400, 0, 0)}, "no complete sample"),
    ],
)
def test_bad_models(plant, arguments, words):
    with pytest.raises(RecordError, match=words):
        identify(plant, **arguments)


@pytest.mark.parametrize(
    "arguments",
    [
        {"initial_covariance": -1.0},
        {"initial_covariance": np.ones(7)},
        {"dtype": "float16"},
        {"rule": fg.Exponential(1.5)},
        {"rule": "no such rule"},
    ],
)
def test_bad_estimator_parameters_are_the_cores(plant, arguments):
    with pytest.raises(fg.InvalidInput):
        identify(plant, formula="y1 ~ u1", **arguments)
