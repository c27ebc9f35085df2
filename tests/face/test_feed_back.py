"""`RLS.run(bounds=...)`: the recursion goes on from estimates that were moved within bounds."""

from __future__ import annotations

import numpy as np
import pytest

import forgetting as fg

TRUTH = np.array([0.05, 1.0, -0.3])
LOWER, UPPER = np.array([0.0, -np.inf, -1.0]), np.array([0.1, np.inf, 0.0])
RULES = ["none", "exponential", "subspace", "random_walk", "efra", "covariance_resetting"]


@pytest.fixture(scope="module")
def record():
    """Regressors of sizes that differ, and so much noise that estimates leave the box."""
    rng = np.random.default_rng(2)
    phi = rng.normal(size=(400, 3)) * [1.0, 20.0, 0.3]
    phi[:, 1] += 15.0 * phi[:, 0]
    return phi, phi @ TRUTH + 0.5 * rng.normal(size=400)


@pytest.mark.parametrize("dtype", ["float64", "float32"])
@pytest.mark.parametrize("rule", RULES)
def test_a_run_is_its_updates(record, rule, dtype):
    phi, y = (each.astype(dtype) for each in record)
    phi[7, 1] = np.nan
    whole, single = (fg.RLS(3, rule=rule, dtype=dtype) for _ in range(2))
    run = whole.run(phi, y, bounds=(LOWER, UPPER), missing="skip")
    lower, upper = LOWER.astype(dtype), UPPER.astype(dtype)
    moved = 0
    for k in range(len(y)):
        single.update(phi[k], y[k], missing="skip")
        theta = single.theta
        if ((theta < lower) | (theta > upper)).any():
            single.theta = fg.bounded(theta, single.covariance, lower, upper)
            moved += 1
        assert np.array_equal(run.theta[k], single.theta)
    assert moved > 20
    assert np.array_equal(whole.covariance, single.covariance)
    assert ((run.theta >= lower) & (run.theta <= upper)).all()


@pytest.mark.parametrize("rule", RULES)
def test_a_run_in_pieces_is_the_run(record, rule):
    phi, y = record
    whole, parts = fg.RLS(3, rule=rule), fg.RLS(3, rule=rule)
    expected = whole.run(phi, y, bounds=(LOWER, UPPER)).theta
    first = parts.run(phi[:123], y[:123], bounds=(LOWER, UPPER)).theta
    parts = fg.RLS.from_bytes(parts.to_bytes())
    second = parts.run(phi[123:], y[123:], bounds=(LOWER, UPPER)).theta
    assert np.array_equal(np.vstack([first, second]), expected)


@pytest.mark.parametrize("rule", ["none", fg.Exponential(0.95), fg.RandomWalk(0.01)])
def test_what_is_fed_back_brings_no_estimate_farther_from_the_truth(record, rule):
    """V = θ̃ᵀ P⁻¹ θ̃ at the step does not rise; the next error is that of the θ that was moved."""
    phi, y = record
    est = fg.RLS(3, rule=rule, initial_covariance=[1.0, 1.0, 1.0])
    shown = fg.RLS(3, rule=rule, initial_covariance=[1.0, 1.0, 1.0])
    run = shown.run(phi, y, bounds=(LOWER, UPPER), outputs=("theta", "error"))
    fell = 0
    for k in range(len(y)):
        error = est.update(phi[k], y[k]).error
        assert float(np.ravel(error)[0]) == run.error[k]
        information = np.linalg.inv(est.covariance)
        before = (est.theta - TRUTH) @ information @ (est.theta - TRUTH)
        after = (run.theta[k] - TRUTH) @ information @ (run.theta[k] - TRUTH)
        assert after <= before * (1 + 1e-9)
        fell += after < 0.99 * before
        est.theta = run.theta[k]
    assert fell > 20


def test_units_do_not_matter(record):
    phi, y = record
    scale = np.array([1e3, 1e-4, 7.0])
    bounds = LOWER, UPPER
    one = fg.RLS(3, rule="exponential").run(phi, y, bounds=bounds).theta
    moved = tuple(1e6 * each / scale for each in bounds)
    two = fg.RLS(3, rule="exponential").run(phi * scale, 1e6 * y, bounds=moved).theta
    # the first parameters are told apart by differences of numbers 1e5 times as large
    assert two * scale / 1e6 == pytest.approx(one, rel=1e-8, abs=1e-9)


def test_bounds_that_are_never_met_change_nothing(record):
    phi, y = record
    wide = np.full(3, -1e6), np.full(3, 1e6)
    one, two = fg.RLS(3, rule="exponential"), fg.RLS(3, rule="exponential")
    assert np.array_equal(one.run(phi, y, bounds=wide).theta, two.run(phi, y).theta)


@pytest.mark.parametrize(
    ("bounds", "words"),
    [
        (([0, 0], [1, 1, 1]), r"lower has shape \(2,\)"),
        (([0, 0, 0], [1, 1]), r"upper has shape \(2,\)"),
        (([0, 2, 0], [1, 1, 1]), r"lower\[1\] = 2, allowed: at most the upper bound"),
        (([0, np.nan, 0], [1, 1, 1]), r"lower\[1\] = NaN"),
        (([np.inf] * 3, [np.inf] * 3), "bounds between which there is a number"),
    ],
)
def test_what_is_no_bound_is_refused_and_nothing_changes(record, bounds, words):
    est = fg.RLS(3, rule="exponential")
    est.run(record[0][:20], record[1][:20])
    before = est.to_bytes()
    with pytest.raises(fg.InvalidInput, match=words):
        est.run(*record, bounds=bounds)
    assert est.to_bytes() == before
    with pytest.raises(fg.InvalidInput, match="one target"):
        several = fg.RLS(3, targets=2)
        several.run(record[0], np.column_stack([record[1]] * 2), bounds=(LOWER, UPPER))
