"""`RecursiveRegressor` of river: its own checks, and what becomes of names that come and go."""

from __future__ import annotations

import math
import pickle

import numpy as np
import pytest
from river import compose, datasets, evaluate, linear_model, metrics, preprocessing
from river.checks import yield_checks

import forgetting as fg
from forgetting.river import RecursiveRegressor

MODELS = [
    RecursiveRegressor(),
    RecursiveRegressor("subspace"),
    RecursiveRegressor(fg.Exponential(0.99), initial_covariance=1e3),
    RecursiveRegressor("none", fit_intercept=False, weighting=fg.Huber(), history=10),
]
CHECKS = [(model, check) for model in MODELS for check in yield_checks(model)]


@pytest.mark.parametrize(("model", "check"), CHECKS, ids=lambda a: getattr(a, "__name__", "model"))
def test_rivers_own_checks(model, check):
    check(model.clone())


def stream(samples: int = 300, features: int = 3, constant: float = 5.0):
    rng = np.random.default_rng(1)
    x = rng.normal(size=(samples, features))
    return x, constant + x @ rng.normal(size=features) + 0.1 * rng.normal(size=samples)


def named(x):
    return {f"f{i:02}": float(value) for i, value in enumerate(x) if value != 0.0}


def learned(model, x, y):
    errors = []
    for row, target in zip(x, y, strict=True):
        errors.append(target - model.predict_one(named(row)))
        model.learn_one(named(row), target)
    return np.array(errors)


def test_told_nothing_it_halves_the_error_of_rivers_own_on_rivers_record():
    def error(model):
        return evaluate.progressive_val_score(datasets.TrumpApproval(), model, metrics.MAE()).get()

    scaler = preprocessing.StandardScaler
    own = [linear_model.BayesianLinearRegression(), scaler() | linear_model.LinearRegression()]
    least = min(map(error, own))
    assert error(RecursiveRegressor()) < least / 2
    assert error(scaler() | RecursiveRegressor()) < least / 2


@pytest.mark.parametrize("rule", ["none", "subspace", fg.Exponential(0.97)])
def test_with_all_names_from_the_start_it_is_the_estimator(rule):
    x, y = stream()
    model = RecursiveRegressor(rule, fit_intercept=False)
    est = fg.RLS(3, rule=rule)
    errors = learned(model, x, y)
    assert errors == pytest.approx(est.run(x, y).error.ravel(), rel=1e-9, abs=1e-12)
    assert list(model.weights.values()) == pytest.approx(est.theta, rel=1e-12)
    assert model.intercept == 0.0


def test_a_bank_with_room_for_names_to_come_predicts_as_well_as_one_without():
    x, y = stream(samples=2000, constant=0.0)
    model = RecursiveRegressor(fit_intercept=False)
    got, expected = learned(model, x, y), fg.Bank(3).run(x, y).error.ravel()
    # units are renewed after 2n, 4n, ... samples and members weighed after 3n, and n is the room
    assert np.mean(got[500:] ** 2) == pytest.approx(np.mean(expected[500:] ** 2), rel=0.01)


def late(samples: int = 300, features: int = 14):
    """Feature i is 0 until sample 10 i."""
    x, y = stream(samples, features)
    silent = np.arange(samples)[:, None] < 10 * np.arange(features)
    return np.where(silent, 0.0, x), y


def test_a_bank_that_has_grown_is_one_that_always_had_the_room():
    x, y = late()
    model = RecursiveRegressor(fit_intercept=False)
    bank = fg.Bank(20)  # ten and then twenty; names came in this order
    learned(model, x, y)
    bank.run(np.pad(x, [(0, 0), (0, 6)]), y)
    assert list(model.weights.values()) == pytest.approx(bank.theta[:14], rel=1e-6, abs=1e-9)
    assert (bank.theta[14:] == 0.0).all()


@pytest.mark.parametrize("rule", ["none", "subspace"])
def test_a_rule_that_has_grown_is_one_that_always_had_the_room(rule):
    x, y = late()
    for covariance in (None, 100.0):
        model = RecursiveRegressor(rule, fit_intercept=False, initial_covariance=covariance)
        est = fg.RLS(14, rule=rule, initial_covariance=covariance)
        got, expected = learned(model, x, y), est.run(x, y).error.ravel()
        # without a covariance units are renewed at other samples before all names are there
        assert list(model.weights.values()) == pytest.approx(est.theta, rel=1e-6, abs=1e-9)
        if covariance is not None:
            assert got == pytest.approx(expected, rel=1e-6, abs=1e-9)


def test_growing_from_a_covariance_needs_no_history_and_growing_without_does():
    x, y = late()
    models = [
        RecursiveRegressor("none", fit_intercept=False, initial_covariance=c, history=h)
        for c, h in ((100.0, 0), (100.0, 1000), (None, 5), (None, 1000))
    ]
    for model in models:
        learned(model, x, y)
    theta = [np.array(list(model.weights.values())) for model in models]
    assert (theta[0] == theta[1]).all()
    assert np.abs(theta[2] - theta[3]).max() > 1e-3


def test_names_that_go_leave_what_is_known_of_them():
    x, y = stream(samples=2000)
    x[500:, 2] = 0.0
    y[500:] = 5.0 + x[500:] @ [1.0, 2.0, 0.0]
    model = RecursiveRegressor(fg.Subspace(0.98))
    learned(model, x[:500], y[:500])
    before = dict(model.weights)
    learned(model, x[500:], y[500:])
    after = model.weights
    # the others change by more than 0.3; what P knows of both at once takes a part of it along
    assert after["f02"] == pytest.approx(before["f02"], abs=0.05)
    assert [after["f00"], after["f01"]] == pytest.approx([1.0, 2.0], abs=0.01)
    assert min(abs(after[f] - before[f]) for f in ("f00", "f01")) > 0.3
    assert model.predict_one({"unknown": 1e9, "f00": 0.0}) == model.predict_one({})


def test_weights_of_samples_divide_the_noise():
    x, y = stream(samples=60)
    weight = np.random.default_rng(2).choice([0.0, 1.0, 3.0], size=60)
    model = RecursiveRegressor("none", initial_covariance=50.0)
    for row, target, w in zip(x, y, weight, strict=True):
        model.learn_one(named(row), target, w)
    phi = np.column_stack([np.ones(60), x])
    information = phi.T @ (weight[:, None] * phi) + np.eye(4) / 50.0
    theta = np.linalg.solve(information, phi.T @ (weight * y))
    assert [model.intercept, *model.weights.values()] == pytest.approx(theta, rel=1e-9)


def test_units_change_no_prediction():
    x, y = stream()
    plain, scaled = RecursiveRegressor(), RecursiveRegressor()
    expected = learned(plain, x, y)
    got = learned(scaled, x * [1e-6, 1.0, 1e7], 1e4 * y)
    assert got == pytest.approx(1e4 * expected, rel=1e-5, abs=1e-4)


BAD = [
    ({"a": math.nan}, 1.0, {}, r"x\['a'\] = nan, allowed: finite numbers"),
    ({"a": None}, 1.0, {}, r"x\['a'\] = None"),
    ({"a": "high"}, 1.0, {}, r"x\['a'\] = 'high'"),
    ({"new": math.inf}, 1.0, {}, r"x\['new'\] = inf"),
    ({"a": 1.0}, math.nan, {}, "y = nan"),
    ({"a": 1.0}, 1.0, {"w": -1.0}, "w = -1.0, allowed: numbers >= 0"),
    ({"a": 1e300, "new": 1.0}, 1.0, {}, "exceeds the numerical range"),
]


@pytest.mark.parametrize(("x", "y", "named", "message"), BAD, ids=lambda a: str(a)[:20])
@pytest.mark.parametrize("rule", ["auto", "subspace"])
def test_a_sample_that_is_refused_changes_nothing(rule, x, y, named, message):
    model = RecursiveRegressor(rule)
    for k in range(20):
        model.learn_one({"a": math.sin(k), "b": math.cos(k)}, float(k % 3))
    before = pickle.dumps(model)
    with pytest.raises((fg.InvalidInput, fg.NumericalRange), match=message):
        model.learn_one(x, y, **named)
    assert pickle.dumps(model) == before
    with pytest.raises(fg.InvalidInput, match="rule"):
        RecursiveRegressor("subspase").learn_one({"a": 1.0}, 1.0)
    with pytest.raises(fg.InvalidInput, match="history is -1"):
        RecursiveRegressor(history=-1)
    with pytest.raises(fg.InvalidInput, match="initial_covariance"):
        RecursiveRegressor(initial_covariance=-1.0).learn_one({"a": 1.0}, 1.0)


def test_it_works_behind_what_makes_names():
    model = compose.Select("kind") | preprocessing.OneHotEncoder() | RecursiveRegressor("none")
    for k in range(400):
        model.learn_one({"kind": "abc"[k % 3], "other": 1.0}, float(k % 3))
    predicted = [model.predict_one({"kind": kind}) for kind in "abc"]
    assert predicted == pytest.approx([0.0, 1.0, 2.0], abs=1e-2)
