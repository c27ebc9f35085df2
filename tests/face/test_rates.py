"""Rates as Python objects, and as callables."""

import copy
import pickle
from functools import partial

import numpy as np
import pytest

import forgetting as fg

DATA = [about for about in fg.rates() if all(p["kind"] != "function" for p in about["parameters"])]
NAMES = [about["name"] for about in DATA]


def record(samples=400, rows=1, targets=1, jump=200):
    random = np.random.default_rng(7)
    phi = random.normal(size=(samples, rows, 3))
    theta = random.normal(size=(3, targets))
    y = phi @ theta + random.normal(size=(samples, rows, targets))
    y[jump:] += 5.0 * phi[jump:] @ random.normal(size=(3, targets))
    return phi, y


def namespace():
    return {name: getattr(fg, name) for name in fg.__all__}


def test_every_rate_is_a_class_of_the_package():
    for about in fg.rates():
        kind = getattr(fg, about["type_name"])
        assert issubclass(kind, fg.Rate)
        assert about["type_name"] in fg.__all__
        assert kind.name == about["name"]
        assert kind.__doc__.startswith(about["summary"])


@pytest.mark.parametrize("name", NAMES)
def test_a_rate_prints_compares_and_pickles_as_what_made_it(name):
    rate = fg.rate(name)
    assert eval(repr(rate), namespace()) == rate
    assert pickle.loads(pickle.dumps(rate)) == rate
    assert copy.deepcopy(rate) == rate
    assert hash(pickle.loads(pickle.dumps(rate))) == hash(rate)
    assert fg.Exponential(rate) == fg.rule("exponential", forgetting_factor=rate)
    assert fg.Exponential(rate) != fg.Exponential(0.5)


@pytest.mark.parametrize("dtype", ["float64", "float32"])
@pytest.mark.parametrize("name", NAMES)
def test_an_estimator_gives_back_its_rule_with_the_rate(name, dtype):
    rule = fg.Subspace(fg.rate(name), threshold=0.1)
    est = fg.RLS(3, rule=rule, rows=2, dtype=dtype)
    assert est.rule == rule
    phi, y = record(rows=2)
    est.run(phi, y)
    again = pickle.loads(pickle.dumps(est))
    assert again.rule == rule
    assert fg.RLS(3, rule=est.rule, rows=2, dtype=dtype).rule == rule
    ahead = [e.run(phi, y).forgetting_factor for e in (est, again)]
    assert np.array_equal(*ahead)


@pytest.mark.parametrize("name", NAMES)
def test_factors_are_within_the_limits_and_move(name):
    phi, y = record(rows=2, targets=2)
    rate = fg.rate(name)
    if "smallest" not in rate.parameters:
        return
    rate = fg.rate(name, smallest=0.95, largest=0.99)
    found = fg.RLS(3, rule=fg.Exponential(rate), rows=2, targets=2).run(phi, y).forgetting_factor
    assert found.min() >= 0.95
    assert found.max() <= 0.99
    assert len(set(found)) > 1


def test_prediction_error_is_the_published_formula():
    phi, y = record(rows=2)
    rule = fg.Exponential(fg.PredictionError(2.0, smallest=0.1))
    est = fg.RLS(3, rule=rule, rows=2, initial_covariance=100.0)
    for p, t in zip(phi, y, strict=True):
        spread = 2.0 + np.trace(p @ est.covariance @ p.T)
        square = np.sum((t[:, 0] - est.predict(p)) ** 2)
        expected = min(1.0 - square / (2.0 + square) / spread, 0.999)
        assert est.update(p, t).forgetting_factor == pytest.approx(expected, rel=1e-12)


def test_fortescue_uses_the_last_sample():
    phi, y = record(rows=2, targets=2)
    rule = fg.Exponential(fg.Fortescue(50.0, 2.0, smallest=0.2))
    est = fg.RLS(3, rule=rule, rows=2, targets=2, initial_covariance=100.0)
    expected = 1.0
    for p, t in zip(phi, y, strict=True):
        error = t - est.predict(p)
        weight = np.linalg.inv(np.eye(2) + p @ est.covariance @ p.T)
        assert est.update(p, t).forgetting_factor == pytest.approx(expected, rel=1e-11)
        expected = max(1.0 - np.trace(error.T @ weight @ error) / 2.0 / 100.0, 0.2)


def test_numbers_may_come_from_numpy():
    rate = fg.RmsRatio(np.float64(0.5), short_window=np.int64(3), long_window=12)
    assert repr(rate) == (
        "RmsRatio(sensitivity=0.5, short_window=3, long_window=12, smallest=0.9, largest=1.0)"
    )
    schedule = fg.Schedule(np.array([0.9, 0.95]), end="repeat")
    assert schedule == fg.Schedule([0.9, 0.95], "repeat")
    assert fg.Exponential(np.float32(0.5)) == fg.Exponential(0.5)


def test_a_schedule_is_followed_and_counts_used_samples():
    est = fg.RLS(1, rule=fg.Subspace(fg.Schedule([0.5, 0.6, 0.7], end="repeat"), threshold=0.1))
    found = []
    for k in range(8):
        update = est.update([0.0 if k == 2 else 1.0], 1.0)
        found += [] if update.skipped else [update.forgetting_factor]
    assert found == [0.5, 0.6, 0.7, 0.5, 0.6, 0.7, 0.5]


@pytest.mark.parametrize("given", ["fortescue", fg.Fortescue(), partial(fg.rate, "fortescue")()])
def test_what_may_stand_for_a_factor(given):
    assert fg.Exponential(given).forgetting_factor == fg.Fortescue()
    assert fg.Exponential(fg.Constant(0.9)) == fg.Exponential(0.9)


def test_what_is_refused_names_the_parameter():
    with pytest.raises(fg.InvalidInput, match="rate = 'fortesque', allowed: constant, "):
        fg.rate("fortesque")
    with pytest.raises(
        fg.InvalidInput, match=r"rate fortescue: .*'window'; its parameters: memory"
    ):
        fg.rate("fortescue", window=3)
    with pytest.raises(fg.InvalidInput, match=r"factor = Fortescue, allowed: .*\(\.\.\."):
        fg.Exponential(fg.Fortescue)
    refused = {
        "largest = 0.5, allowed": fg.Fortescue(smallest=0.9, largest=0.5),
        "memory = -1, allowed": fg.Fortescue(-1.0),
        "long_window = 10, allowed": fg.RmsRatio(short_window=10, long_window=10),
        "short_window = 2.5, allowed": fg.RmsRatio(short_window=2.5),
        "largest = 1, allowed": fg.Gradient(largest=1.0),
        r"factors\[1\] = 1.5, allowed": fg.Schedule([0.9, 1.5]),
        "end = ": fg.Schedule([0.9], end="stop"),
    }
    for message, rate in refused.items():
        with pytest.raises(fg.InvalidInput, match=message):
            fg.RLS(2, rule=fg.Exponential(rate))


# callables


def test_a_callable_gives_the_factor_and_sees_the_sample():
    phi, y = record(rows=2, targets=2, samples=30)
    gamma = np.array([[2.0, 0.5], [0.5, 1.0]])
    root = np.linalg.inv(np.linalg.cholesky(gamma))
    seen = []

    def factor(evidence):
        seen.append(evidence)
        return 0.9 if evidence.samples < 10 else 0.98

    est = fg.RLS(3, rule=fg.Exponential(factor), rows=2, targets=2, initial_covariance=100.0)
    for k, (p, t) in enumerate(zip(phi, y, strict=True)):
        spread = root @ p @ est.covariance @ p.T @ root.T
        error = root @ (t - est.predict(p))
        assert est.update(p, t, gamma).forgetting_factor == (0.9 if k < 10 else 0.98)
        evidence = seen[-1]
        assert evidence.error == pytest.approx(error, rel=1e-9)
        assert evidence.squared_error == pytest.approx(np.sum(error**2) / 2, rel=1e-9)
        assert evidence.leverage == pytest.approx(np.trace(spread), rel=1e-9)
        normalized = np.trace(error.T @ np.linalg.inv(np.eye(2) + spread) @ error) / 2
        assert evidence.normalized_error == pytest.approx(normalized, rel=1e-8)
        sizes = (evidence.parameters, evidence.rows, evidence.targets, evidence.samples)
        assert sizes == (3, 2, 2, k)


def test_run_asks_the_callable_as_update_does():
    phi, y = record()
    rule = fg.Exponential(lambda evidence: 1.0 - 0.1 / (1.0 + evidence.samples))
    whole, single = fg.RLS(3, rule=rule), fg.RLS(3, rule=rule)
    run = whole.run(phi, y)
    factors = [single.update(p, t).forgetting_factor for p, t in zip(phi, y, strict=True)]
    assert np.array_equal(run.forgetting_factor, factors)
    assert np.array_equal(whole.theta, single.theta)


def test_an_exception_comes_back_and_nothing_has_changed():
    phi, y = record(samples=20)

    def factor(evidence):
        if evidence.samples == 12:
            raise KeyError("twelve")
        return 0.95

    est = fg.RLS(3, rule=fg.Exponential(factor), initial_covariance=100.0)
    with pytest.raises(KeyError, match="twelve"):
        est.run(phi, y)
    assert est.samples == 0
    assert np.array_equal(est.covariance, 100.0 * np.eye(3))
    est.run(phi[:12], y[:12])
    before = est.theta, est.covariance
    with pytest.raises(KeyError, match="twelve"):
        est.update(phi[12], y[12])
    assert est.samples == 12
    assert np.array_equal(est.theta, before[0])
    assert np.array_equal(est.covariance, before[1])


@pytest.mark.parametrize(
    ("answer", "error"),
    [
        (1.5, fg.InvalidInput),
        (0.0, fg.InvalidInput),
        (float("nan"), fg.InvalidInput),
        (None, TypeError),
        ("0.9", TypeError),
    ],
)
def test_a_callable_must_give_a_factor(answer, error):
    est = fg.RLS(1, rule=fg.Exponential(lambda evidence: answer))
    with pytest.raises(error):
        est.update([1.0], 1.0)
    assert est.samples == 0


def test_a_callable_cannot_use_the_estimator_that_asks_it():
    est = fg.RLS(1, rule=fg.Exponential(lambda evidence: est.update([1.0], 1.0)))
    with pytest.raises(RuntimeError):
        est.update([1.0], 1.0)
    assert est.samples == 0


def test_a_callable_may_change_the_arrays_it_is_asked_about():
    phi, y = record(samples=50)

    def spoil(evidence):
        spoilt[0][:] = np.nan
        spoilt[1][:] = np.nan
        return 0.9

    spoilt = phi.copy(), y.copy()
    est = fg.RLS(3, rule=fg.Exponential(spoil))
    expected = fg.RLS(3, rule=fg.Exponential(0.9))
    est.run(*spoilt)
    expected.run(phi, y)
    assert np.array_equal(est.theta, expected.theta)
    spoilt = phi[0].copy(), y[0].copy()
    est.update(*spoilt)
    expected.update(phi[0], y[0])
    assert np.array_equal(est.theta, expected.theta)


def test_an_estimator_with_a_callable_is_copied_but_not_saved():
    def factor(evidence):
        return 0.9

    est = fg.RLS(1, rule=fg.Exponential(factor))
    assert est.rule == fg.Exponential(factor)
    assert est.rule.forgetting_factor.parameters["function"] is factor
    assert copy.deepcopy(est).update([1.0], 1.0).forgetting_factor == 0.9
    for save in (est.to_bytes, partial(pickle.dumps, est)):
        with pytest.raises(fg.InvalidInput, match="function of yours cannot be saved"):
            save()
