"""Standard errors and prediction intervals: right where P is right, known where it is not."""

import dense_gf_rls as dense
import numpy as np
import pytest

from forgetting import InvalidInput
from forgetting.analysis import Trajectory, confidence


def _runs(rule, *, runs, samples, n=3, rows=1, sigma=0.5, seed=0, gamma=None):
    """Fixed parameters drawn from the prior, Gaussian noise of variance σ² Γ."""
    rng = np.random.default_rng(seed)
    phi = rng.normal(size=(runs, samples, rows, n))
    prior = 4.0 * np.eye(n)
    truth = sigma * 2.0 * rng.normal(size=(runs, n))
    noise = sigma * rng.normal(size=(runs, samples, rows))
    if gamma is not None:
        root = np.linalg.cholesky(gamma)
        raw = phi
        phi, noise_raw = np.linalg.solve(root, raw), noise @ root.T
    y = np.einsum("btpn,bn->btp", phi, truth) + noise
    done = dense.simulate(rule, phi, y, prior)
    if gamma is None:
        return done, truth
    theta = done.theta[:, :-1]
    errors = np.einsum("btpn,btn->btp", raw, truth[:, None] - theta) + noise_raw
    return done, raw, errors


def test_coverage_without_forgetting_is_the_nominal_one_over_1e5_samples():
    done, _ = _runs(dense.none(), runs=100, samples=1100)
    for given in (0.25, None):  # σ² known, and estimated on the way
        inside = counted = 0
        for run in range(100):
            found = confidence(
                done.trajectory(run), errors=done.errors[run], noise_variance=given, warm_up=40
            )
            inside += found.coverage * found.counted.sum()
            counted += found.counted.sum()
        assert counted >= 100_000
        assert 0.94 < inside / counted < 0.96
        assert inside / counted == pytest.approx(0.95, abs=4 * (0.95 * 0.05 / counted) ** 0.5)


def test_standard_errors_are_the_spread_of_the_estimate():
    done, truth = _runs(dense.none(), runs=3000, samples=60)
    found = confidence(done.trajectory(), errors=done.errors[0], noise_variance=0.25, warm_up=1)
    # Each run has its own regressors; the mean of P over the runs is what the spread shows.
    spread = np.sqrt(np.mean((done.theta[:, -1] - truth) ** 2, axis=0))
    mean = np.sqrt(0.25 * np.mean(np.diagonal(done.after[:, -1], axis1=1, axis2=2), axis=0))
    np.testing.assert_allclose(spread, mean, rtol=4 / np.sqrt(2 * 3000))
    np.testing.assert_allclose(
        found.standard_error[-1, :, 0], np.sqrt(0.25 * np.diag(done.after[0, -1]))
    )
    np.testing.assert_allclose(found.fixed_standard_error, found.standard_error, rtol=1e-9)


@pytest.mark.parametrize(
    "rule",
    [
        dense.exponential(0.95),
        dense.subspace(0.95, 1e-3),
        dense.resetting(0.95, 0.25 * np.eye(3)),
        dense.variable_direction(0.95, 0.05),
        dense.random_walk(0.01 * np.eye(3)),
    ],
)
def test_for_fixed_parameters_p_is_conservative_and_the_other_reading_is_right(rule):
    done, truth = _runs(rule, runs=1500, samples=150, seed=3)
    found = confidence(done.trajectory(), errors=done.errors[0], noise_variance=0.25)
    assert (found.fixed_standard_error <= found.standard_error * (1 + 1e-9)).all()
    # C, averaged over runs with regressors of their own, is the spread of the estimates.
    total = np.zeros(3)
    for run in range(300):
        path = confidence(done.trajectory(run), errors=done.errors[run], noise_variance=0.25)
        total += path.fixed_standard_error[-1, :, 0] ** 2 / 300
    spread = np.mean((done.theta[:, -1] - truth) ** 2, axis=0)
    np.testing.assert_allclose(spread, total, rtol=0.2)


def test_exponential_forgetting_doubles_the_variance():
    done, _ = _runs(dense.exponential(0.98), runs=1, samples=3000)
    found = confidence(done.trajectory(), errors=done.errors[0])
    ratio = (found.standard_error[1000:] / found.fixed_standard_error[1000:]) ** 2
    assert ratio.mean() == pytest.approx(2.0, rel=0.1)
    # Fixed parameters: the interval from P covers too much, the other one what it says.
    assert found.coverage > 0.95
    assert found.fixed_coverage == pytest.approx(0.95, abs=3 * found.uncertainty)


def test_p_is_the_covariance_of_the_walk_the_rule_supposes():
    """θ moves at random with covariance σ² Q_k, Q_k = P̄_k - P_k: then P is right."""
    rng = np.random.default_rng(5)
    runs, samples, n, sigma = 400, 300, 2, 0.5
    phi = np.broadcast_to(rng.normal(size=(1, samples, 1, n)), (runs, samples, 1, n))
    rule = dense.oblique_projection(0.9)
    plain = dense.simulate(rule, phi[:1], None, np.eye(n))
    steps = plain.prior[0] - plain.before[0]
    theta = sigma * rng.normal(size=(runs, n))
    truth = np.empty((runs, samples, n))
    for k in range(samples):
        values, vectors = np.linalg.eigh(steps[k])
        root = vectors * np.sqrt(np.maximum(values, 0))
        theta = theta + sigma * rng.normal(size=(runs, n)) @ root.T
        truth[:, k] = theta
    y = np.einsum("btpn,btn->btp", phi, truth) + sigma * rng.normal(size=(runs, samples, 1))
    done = dense.simulate(rule, phi, y, np.eye(n))
    inside = [
        confidence(done.trajectory(r), errors=done.errors[r], noise_variance=sigma**2).coverage
        for r in range(100)
    ]
    assert np.mean(inside) == pytest.approx(0.95, abs=0.01)
    spread = np.mean((done.theta[:, 1:] - truth) ** 2, axis=0)[50:]
    model = sigma**2 * np.diagonal(plain.after[0], axis1=1, axis2=2)[50:]
    assert np.mean(spread / model) == pytest.approx(1.0, abs=0.05)


def test_two_rows_with_a_full_weighting():
    gamma = np.array([[2.0, 0.8], [0.8, 1.0]])
    done, raw, errors = _runs(dense.none(), runs=60, samples=400, rows=2, gamma=gamma)
    inside = []
    for run in range(60):
        path = np.concatenate([done.before[run], done.after[run][-1:]])
        trajectory = Trajectory.from_arrays(
            raw[run], path, prior_covariance=done.prior[run], gamma=gamma
        )
        found = confidence(trajectory, errors=errors[run])
        inside.append(found.coverage)
        assert found.half_width.shape == (400, 2, 1)
    assert np.mean(inside) == pytest.approx(0.95, abs=0.005)
    assert found.noise_variance[-1, 0] == pytest.approx(0.25, rel=0.2)


def test_an_interval_is_known_before_its_output():
    done, _ = _runs(dense.none(), runs=1, samples=200)
    changed = done.errors[0].copy()
    changed[150:] *= 100.0
    plain, other = (confidence(done.trajectory(), errors=e) for e in (done.errors[0], changed))
    np.testing.assert_array_equal(plain.half_width[:151], other.half_width[:151])
    assert (plain.half_width[151:] < other.half_width[151:]).all()


def test_missing_errors_do_not_count_and_short_records_say_so():
    done, _ = _runs(dense.none(), runs=1, samples=200)
    errors = done.errors[0].copy()
    errors[::2] = np.nan
    found = confidence(done.trajectory(), errors=errors)
    assert not found.counted[::2].any() and found.counted[101::2].all()
    short = confidence(
        Trajectory.from_arrays(done.phi[0, :20], done.before[0, :21]), errors=done.errors[0, :20]
    )
    assert np.isnan(short.coverage) and "too short" in str(short)
    assert short.to_dict()["coverage"] is None


def test_misuse_is_refused_by_name():
    done, _ = _runs(dense.none(), runs=1, samples=30)
    for change, word in (
        ({"level": 1.5}, "level"),
        ({"noise_variance": 0.0}, "noise_variance"),
        ({"errors": np.ones(7)}, "errors"),
        ({"errors": None}, "error"),
    ):
        with pytest.raises(InvalidInput, match=word):
            confidence(done.trajectory(), **{"errors": done.errors[0], **change})
