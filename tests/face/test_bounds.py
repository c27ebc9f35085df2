"""Estimates within bounds, and estimates changed by hand."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import lsq_linear

import forgetting as fg


def random_problem(rng, n):
    root = rng.normal(size=(n, n)) * 10.0 ** rng.uniform(-2, 2, size=n)
    covariance = root @ root.T + 1e-6 * np.diag(np.sum(root**2, axis=1))
    theta = np.sqrt(np.diag(covariance)) * rng.normal(size=n)
    size = np.sqrt(np.diag(covariance))
    lower = np.where(rng.random(n) < 0.6, -0.3 * size * rng.random(n), -np.inf)
    upper = np.where(rng.random(n) < 0.6, 0.3 * size * rng.random(n), np.inf)
    return theta, covariance, lower, upper


@pytest.mark.parametrize("n", [1, 2, 3, 5, 8])
def test_the_nearest_point_is_that_of_a_solver(n):
    rng = np.random.default_rng(n)
    for _ in range(60):
        theta, covariance, lower, upper = random_problem(rng, n)
        found = fg.bounded(theta, covariance, lower, upper)
        root = np.linalg.inv(np.linalg.cholesky(covariance))
        upper_open = np.maximum(upper, lower + 1e-12)
        solved = lsq_linear(root, root @ theta, (lower, upper_open), method="bvls", tol=1e-14).x
        assert ((lower <= found) & (found <= upper)).all()

        def cost(x, root=root, theta=theta):
            return np.sum((root @ (x - theta)) ** 2)

        assert cost(found) <= cost(solved) * (1 + 1e-6) + 1e-9


def test_one_active_bound_is_the_formula():
    covariance = np.array([[2.0, 0.7], [0.7, 1.0]])
    found = fg.bounded([1.0, 3.0], covariance, [-np.inf, -np.inf], [np.inf, 2.5])
    assert found == pytest.approx([1.0 - 0.7 * 0.5 / 1.0, 2.5])


def test_bounds_bring_no_true_value_farther_away():
    rng = np.random.default_rng(7)
    for _ in range(300):
        theta, covariance, lower, upper = random_problem(rng, 4)
        # a true value inside the box
        true = np.clip(theta + rng.normal(size=4), lower, upper)
        found = fg.bounded(theta, covariance, lower, upper)
        information = np.linalg.inv(covariance)
        before, after = theta - true, found - true
        assert after @ information @ after <= before @ information @ before * (1 + 1e-9) + 1e-9


def test_many_rows_at_once():
    rng = np.random.default_rng(8)
    problems = [random_problem(rng, 3) for _ in range(5)]
    _, _, lower, upper = problems[0]
    thetas, covariances = (np.array([p[i] for p in problems]) for i in (0, 1))
    together = fg.bounded(thetas, covariances, lower, upper)
    for row, theta, covariance in zip(together, thetas, covariances, strict=True):
        assert np.array_equal(row, fg.bounded(theta, covariance, lower, upper))


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (([1.0], [[1.0]], [2.0], [1.0]), r"lower\[0\] = 2, allowed: at most the upper bound"),
        (([1.0], [[0.0]], [0.0], [1.0]), r"covariance\[0\] = 0"),
        (([np.nan], [[1.0]], [0.0], [1.0]), r"theta\[0\] = NaN"),
        (([1.0], [[1.0]], [0.0, 0.0], [1.0]), "lower has shape"),
        (([1.0, 2.0], [[1.0]], [0.0, 0.0], [1.0, 1.0]), "covariance has shape"),
        (([3.0, 3.0], [[1.0, 2.0], [2.0, 1.0]], [0.0, 0.0], [1.0, 1.0]), "positive definite"),
        (([[1.0], [np.inf]], [[[1.0]], [[1.0]]], [0.0], [1.0]), "sample 1: theta"),
        (([1.0], [[1.0]], [np.inf], [np.inf]), r"lower\[0\] = inf"),
    ],
)
def test_what_is_refused_is_named(arguments, words):
    with pytest.raises(fg.InvalidInput, match=words):
        fg.bounded(*arguments)


@pytest.mark.parametrize("prior", [None, 10.0])
@pytest.mark.parametrize("dtype", ["float64", "float32"])
def test_an_estimator_goes_on_from_another_theta(prior, dtype):
    rng = np.random.default_rng(9)
    phi = rng.normal(size=(40, 3)) * [1.0, 1e3, 1e-3]
    y = phi @ [1.0, 2e-3, 3e3] + 0.1 * rng.normal(size=40)
    estimator = fg.RLS(3, initial_covariance=prior, dtype=dtype, rule=fg.Exponential(0.9))
    estimator.run(phi, y)
    before = estimator.covariance
    estimator.theta = [5.0, -1e-3, 1e3]
    assert estimator.theta == pytest.approx([5.0, -1e-3, 1e3], rel=1e-6)
    assert np.array_equal(estimator.covariance, before)
    # the next update is the recursion from there
    phi_next, y_next = phi[0] + 1.0, 2.0
    forgotten = before.astype(float) / 0.9
    gain = forgotten @ phi_next / (1 + phi_next @ forgotten @ phi_next)
    expected = np.array([5.0, -1e-3, 1e3])
    expected = expected + gain * (y_next - phi_next @ expected)
    estimator.update(phi_next, y_next)
    assert estimator.theta == pytest.approx(expected, rel=2e-2 if dtype == "float32" else 1e-7)


def test_targets_have_thetas_of_their_own():
    estimator = fg.RLS(2, targets=3)
    estimator.theta = [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]
    assert estimator.theta.tolist() == [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]
    assert estimator.predict([1.0, 1.0]).tolist() == [5.0, 7.0, 9.0]
    with pytest.raises(fg.InvalidInput, match="theta has shape"):
        estimator.theta = [1.0, 2.0]
    with pytest.raises(fg.InvalidInput, match=r"theta\[.\] = NaN"):
        estimator.theta = [[1.0, 2.0, np.nan], [4.0, 5.0, 6.0]]


def test_a_forgetting_factor_is_changed_while_running():
    rng = np.random.default_rng(10)
    phi, y = rng.normal(size=(60, 2)), rng.normal(size=60)
    changed = fg.RLS(2, rule=fg.Exponential(0.99), initial_covariance=1.0)
    assert changed.forgetting_factor == 0.99
    changed.run(phi[:30], y[:30])
    changed.forgetting_factor = 0.9
    by_hand = fg.RLS(
        2, rule=fg.Exponential(fg.Schedule([0.99] * 30 + [0.9] * 30)), initial_covariance=1.0
    )
    changed.run(phi[30:], y[30:])
    by_hand.run(phi, y)
    assert changed.theta == pytest.approx(by_hand.theta, rel=1e-12)
    assert changed.rule.forgetting_factor == 0.9
    again = fg.RLS.from_bytes(changed.to_bytes())
    assert again.forgetting_factor == 0.9


def test_a_factor_that_is_not_there_is_not_set():
    with pytest.raises(fg.InvalidInput, match="none uses none"):
        fg.RLS(2, rule="none").forgetting_factor = 0.9
    rated = fg.RLS(2, rule=fg.Exponential(fg.Fortescue()))
    assert rated.forgetting_factor is None
    with pytest.raises(fg.InvalidInput, match="a rate chooses it"):
        rated.forgetting_factor = 0.9
    estimator = fg.RLS(2, rule=fg.Exponential(0.99))
    with pytest.raises(fg.InvalidInput, match="forgetting_factor = 0"):
        estimator.forgetting_factor = 0.0
    assert estimator.forgetting_factor == 0.99
