"""The ARX class: scikit-learn's conventions, chunks, gaps, prediction and free run."""

from __future__ import annotations

import copy
import pickle
import sys

import numpy as np
import pytest

import forgetting as fg
from forgetting.record import identify


def signals(outputs=1, length=300):
    rng = np.random.default_rng(5)
    u = rng.normal(size=(length, 2))
    y = np.zeros((length, outputs))
    for k in range(2, length):
        y[k] = 0.6 * y[k - 1] - 0.1 * y[k - 2] + u[k - 1].sum() + 0.5 * u[k - 2, 0]
    return (u, y[:, 0]) if outputs == 1 else (u, y * np.array([1.0, -2.0])[:outputs])


def test_equals_identify_bit_for_bit(plant):
    u, y = plant[["u1", "u2"]].to_numpy(), plant[["y1", "y2"]].to_numpy()
    model = fg.ARX(2, 2, 1, rule=fg.Exponential(0.98)).fit(u, y)
    found = identify(
        plant,
        output=["y1", "y2"],
        input=["u1", "u2"],
        arx=(2, 2, 1),
        offset=False,
        rule=fg.Exponential(0.98),
    )
    assert np.array_equal(model.theta_, found.theta[-1])
    assert np.array_equal(model.covariance_, found.trace.covariance)


@pytest.mark.parametrize("outputs", [1, 2])
@pytest.mark.parametrize("cuts", [[1], [2, 3, 4], [150], [7, 8, 100, 299]])
def test_chunks_are_the_whole_bit_for_bit(outputs, cuts):
    u, y = signals(outputs)
    u[120, 1] = np.nan
    y[200] = np.nan
    whole = fg.ARX(2, 2, 1).fit(u, y)
    pieces = fg.ARX(2, 2, 1)
    for part in np.split(np.arange(300), cuts):
        pieces.partial_fit(u[part], y[part])
    assert np.array_equal(whole.theta_, pieces.theta_)
    assert np.array_equal(whole.covariance_, pieces.covariance_)
    assert (whole.samples_, whole.used_) == (pieces.samples_, pieces.used_)


def test_gaps_are_skipped():
    u, y = signals()
    y[100] = np.nan
    model = fg.ARX(2, 2, 1).fit(u, y)
    # Two rows of start, the gap, and two rows whose lags reach it.
    assert (model.samples_, model.used_) == (300, 295)
    assert np.isfinite(model.theta_).all()


def test_predict_is_one_step():
    u, y = signals()
    model = fg.ARX(2, 2, 1, rule="none", initial_covariance=1e10).fit(u, y)
    predicted = model.predict(u, y)
    assert predicted.shape == (300,) and np.isnan(predicted[:2]).all()
    np.testing.assert_allclose(predicted[2:], y[2:], atol=1e-6)
    theta = model.theta_
    k = 57
    by_hand = (
        theta[0] * y[k - 1] + theta[1] * y[k - 2] + u[k - 1] @ theta[2:4] + u[k - 2] @ theta[4:]
    )
    assert predicted[k] == pytest.approx(by_hand, rel=1e-12)


def test_simulate_is_a_free_run():
    u, y = signals(2)
    model = fg.ARX(2, 2, 1, rule="none", initial_covariance=1e10).fit(u, y)
    simulated = model.simulate(u, y_start=y[:2])
    assert simulated.shape == (300, 2)
    np.testing.assert_allclose(simulated, y, atol=1e-4)
    # From rest, the start is forgotten at the pace of the poles (0.34 and 0.26).
    np.testing.assert_allclose(model.simulate(u)[60:], y[60:], atol=1e-4)
    begun = model.simulate(u, y_start=y[:50] + 1.0)
    assert np.array_equal(begun[:50], y[:50] + 1.0)
    assert np.abs(begun[50] - y[50]).max() > 0.1
    np.testing.assert_allclose(begun[150:], y[150:], atol=1e-4)


def by_recursion(model, u, start):
    """A free run sample by sample, from rest: a different computation of the same outputs."""
    theta, outputs = model.theta_.reshape(-1, start.shape[1]), start.shape[1]
    y = np.zeros((len(u), outputs))
    y[: len(start)] = start
    for k in range(len(start), len(u)):
        past = [y[k - lag] if k >= lag else np.zeros(outputs) for lag in range(1, model.na + 1)]
        lags = range(model.nk, model.nk + model.nb)
        past += [u[k - lag] if k >= lag else np.zeros(u.shape[1]) for lag in lags]
        y[k] = np.concatenate(past) @ theta
    return y


@pytest.mark.parametrize("start", [0, 1, 5, 40])
@pytest.mark.parametrize("orders", [(1, 1, 0), (3, 2, 4), (0, 2, 1), (2, 1, 50)])
def test_outputs_that_act_on_one_another_run_freely(plant, orders, start):
    u, y = plant[["u1", "u2"]].to_numpy(), plant[["y1", "y2"]].to_numpy()
    model = fg.ARX(*orders).fit(u, y)
    expected = by_recursion(model, u[:40], y[:start])
    simulated = model.simulate(u[:40], y_start=y[:start])
    # Sums in another order: 40 samples of rounding.
    np.testing.assert_allclose(simulated, expected, rtol=1e-12, atol=1e-13)
    assert np.array_equal(simulated[:start], y[:start])


def test_a_free_run_of_no_samples_is_empty():
    u, y = signals(2)
    assert fg.ARX(2, 2, 1).fit(u, y).simulate(u[:0]).shape == (0, 2)


def test_a_free_run_without_scipy_says_what_to_install(monkeypatch):
    u, y = signals()
    model = fg.ARX(2, 2, 1).fit(u, y)
    for name in ("scipy", "scipy.linalg", "scipy.linalg.blas"):
        monkeypatch.setitem(sys.modules, name, None)
    with pytest.raises(
        ImportError, match=r"a free run needs scipy: pip install 'forgetting\[cli\]'"
    ):
        model.simulate(u)


def test_without_input():
    y = 0.9 ** np.arange(50)
    model = fg.ARX(na=1, nb=0, rule="none", initial_covariance=1e8).fit(None, y)
    assert model.theta_[0] == pytest.approx(0.9, abs=1e-6)
    np.testing.assert_allclose(model.simulate(50, y_start=y[:1]), y, atol=1e-4)


def test_parameters_the_scikit_learn_way():
    rule = fg.Exponential(0.9)
    model = fg.ARX(1, 2, 3, rule=rule)
    assert model.get_params()["rule"] is rule and model.get_params()["nk"] == 3
    assert model.set_params(na=4) is model and model.na == 4
    with pytest.raises(fg.InvalidInput, match="no parameter 'order'"):
        model.set_params(order=2)
    assert not hasattr(model, "theta_") and not hasattr(model, "covariance_")
    assert "na=4" in repr(model)


def test_copy_and_pickle_go_on_alike():
    u, y = signals()
    model = fg.ARX(2, 2, 1).fit(u[:150], y[:150])
    for twin in (copy.deepcopy(model), pickle.loads(pickle.dumps(model))):
        twin.partial_fit(u[150:], y[150:])
        assert np.array_equal(twin.theta_, fg.ARX(2, 2, 1).fit(u, y).theta_)


def test_fit_starts_anew():
    u, y = signals()
    model = fg.ARX(2, 2, 1).fit(u, -y).fit(u, y)
    assert np.array_equal(model.theta_, fg.ARX(2, 2, 1).fit(u, y).theta_)


@pytest.mark.parametrize(
    ("spoil", "words"),
    [
        (lambda u, y: (u[:-1], y), "u has 299 rows and y has 300"),
        (lambda u, y: (u[:, :1], y), "u has 1 channels; the model has 2"),
        (lambda u, y: (u, np.column_stack([y, y])), "y has 2 channels; the model has 1"),
        (lambda u, y: (u * np.inf, y), "u is infinite in row 0"),
        (lambda u, y: (u[None], y), r"u has shape \(1, 300, 2\)"),
        (lambda u, y: ("text", y), "u must hold numbers"),
    ],
)
def test_refused_data_change_nothing(spoil, words):
    u, y = signals()
    model = fg.ARX(2, 2, 1).fit(u, y)
    before = model.theta_, model.samples_
    with pytest.raises(fg.InvalidInput, match=words):
        model.partial_fit(*spoil(u, y))
    assert np.array_equal(model.theta_, before[0]) and model.samples_ == before[1]


@pytest.mark.parametrize(
    ("orders", "words"),
    [
        ({"na": -1}, "na is -1"),
        ({"nb": 1.5}, "nb is 1.5"),
        ({"na": 0, "nb": 0}, "both 0"),
        ({"nb": 0}, "nb is 0 but u has 2"),
    ],
)
def test_bad_orders(orders, words):
    with pytest.raises(fg.InvalidInput, match=words):
        fg.ARX(**orders).fit(*signals())


def test_before_fit():
    with pytest.raises(fg.InvalidInput, match="call fit or partial_fit first"):
        fg.ARX().predict([1.0], [1.0])


def test_simulate_needs_every_input():
    u, y = signals()
    model = fg.ARX(2, 2, 1).fit(u, y)
    u[5, 0] = np.nan
    with pytest.raises(fg.InvalidInput, match="u is missing in row 5"):
        model.simulate(u)
