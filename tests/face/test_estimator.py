"""The class `RLS`: what a record, a sample and a saved state must have in common."""

import copy
import pickle

import numpy as np
import pytest

import forgetting as fg

RULES = [
    fg.NoForgetting(),
    fg.Exponential(0.97),
    fg.ExponentialResetting(0.97, information=[[2.0, 0.5, 0.0], [0.5, 1.0, 0.1], [0.0, 0.1, 0.5]]),
    fg.Subspace(0.97, threshold=1e-2),
]
SIZES = [(1, 1), (1, 3), (2, 1), (3, 2)]


def record(samples, rows, targets, seed=0):
    """Regressors that excite, then fall silent, then keep to one direction."""
    random = np.random.default_rng(seed)
    phi = random.normal(size=(samples, rows, 3))
    third = samples // 3
    phi[third : 2 * third] = 0.0
    phi[2 * third :] = [1.0, -0.5, 0.25]
    theta = random.normal(size=(3, targets))
    return phi, phi @ theta + 0.01 * random.normal(size=(samples, rows, targets))


@pytest.mark.parametrize("dtype", ["float64", "float32"])
@pytest.mark.parametrize(("rows", "targets"), SIZES)
@pytest.mark.parametrize("rule", RULES, ids=lambda rule: rule.name)
def test_one_run_is_as_many_updates_bit_for_bit(rule, rows, targets, dtype):
    phi, y = record(90, rows, targets)
    whole = fg.RLS(3, rule=rule, rows=rows, targets=targets, dtype=dtype)
    single = copy.copy(whole)
    run = whole.run(phi, y, outputs=["theta", "error", "leverage", "rank", "skipped", "covariance"])
    for k in range(len(phi)):
        update = single.update(phi[k], y[k])
        assert np.array_equal(run.theta[k], single.theta)
        assert np.array_equal(run.covariance[k], single.covariance)
        assert np.array_equal(np.ravel(run.error[k]), np.ravel(update.error))
        assert run.leverage[k] == update.leverage
        assert run.rank[k] == update.rank
        assert fg.SKIPPED[int(run.skipped[k])] == update.skipped
    assert single.to_bytes() == whole.to_bytes()


@pytest.mark.parametrize("dtype", ["float64", "float32"])
@pytest.mark.parametrize("rule", RULES, ids=lambda rule: rule.name)
def test_saving_in_the_middle_changes_no_bit(rule, dtype):
    phi, y = record(90, 1, 2)
    whole = fg.RLS(3, rule=rule, targets=2, dtype=dtype, initial_theta=np.full((3, 2), 0.5))
    first = copy.deepcopy(whole)
    whole.run(phi, y)
    first.run(phi[:41], y[:41])
    for restored in (
        fg.RLS.from_bytes(first.to_bytes()),
        pickle.loads(pickle.dumps(first)),
        copy.copy(first),
    ):
        restored.run(phi[41:], y[41:])
        assert restored.to_bytes() == whole.to_bytes()
    assert first.to_bytes() != whole.to_bytes()


@pytest.mark.parametrize("covariance", [3.0, [1.0, 2.0, 3.0], np.eye(3) + 0.5], ids=str)
def test_reset_returns_to_the_start(covariance):
    est = fg.RLS(3, rule=fg.Subspace(0.9), initial_covariance=covariance, initial_theta=[1, 2, 3])
    start = est.to_bytes()
    assert np.allclose(
        est.covariance, covariance * np.eye(3) if np.ndim(covariance) < 2 else covariance
    )
    phi, y = record(30, 1, 1)
    est.run(phi, y)
    assert est.to_bytes() != start
    restored = fg.RLS.from_bytes(est.to_bytes())
    est.reset()
    restored.reset()
    assert est.to_bytes() == start
    assert restored.to_bytes() == start


def test_shapes_in_and_out():
    est = fg.RLS(3, rows=2, targets=4)
    assert est.theta.shape == (3, 4)
    assert est.predict(np.ones(3)).shape == (4,)
    assert est.predict(np.ones((2, 3))).shape == (2, 4)
    assert est.update(np.ones((2, 3)), np.ones((2, 4))).error.shape == (2, 4)
    run = est.run(np.ones((5, 2, 3)), np.ones((5, 2, 4)))
    assert run.theta.shape == (5, 3, 4)
    assert run.error.shape == (5, 2, 4)
    assert run.covariance is None
    single = fg.RLS(3)
    assert isinstance(single.predict([1, 2, 3]), float)
    assert isinstance(single.update([1, 2, 3], 1).error, float)
    for shape in ((5,), (5, 1), (5, 1, 1)):
        assert single.run(np.ones((5, 3)), np.ones(shape)).error.shape == shape


def test_arrays_of_any_layout_give_the_same_estimate():
    phi, y = record(60, 1, 1)
    phi, y = phi[:, 0], y[:, 0, 0]
    plain = fg.RLS(3).run(phi, y).theta
    assert np.array_equal(fg.RLS(3).run(np.asfortranarray(phi), y).theta, plain)
    doubled = np.repeat(phi, 2, axis=0)[::2]
    assert np.array_equal(fg.RLS(3).run(doubled, list(y)).theta, plain)
    assert np.array_equal(fg.RLS(3).run(phi.astype(">f8"), y.astype("<f8")).theta, plain)
    crooked = np.frombuffer(b"\0" + phi.tobytes(), np.uint8)[1:].view(float).reshape(phi.shape)
    assert not crooked.flags.aligned
    assert np.array_equal(fg.RLS(3).run(crooked, y).theta, plain)


@pytest.mark.parametrize("kind", [np.float64, np.float32, float, np.array, lambda x: np.array([x])])
def test_numbers_of_any_kind_give_the_same_estimate(kind):
    phi, y = record(60, 1, 1)
    phi, y = phi[:, 0], y[:, 0, 0].astype(np.float32).astype(float)
    plain, est = fg.RLS(3), fg.RLS(3)
    for row, number in zip(phi, y, strict=True):
        plain.update(row, float(number))
        est.update(row.view(np.recarray), kind(number))
    assert est.to_bytes() == plain.to_bytes()


def test_noise_covariance_weighs_rows():
    phi, y = record(50, 2, 1)
    gamma = np.array([[2.0, 0.3], [0.3, 0.5]])
    root = np.linalg.inv(np.linalg.cholesky(gamma))
    weighted = fg.RLS(3, rule=fg.Exponential(0.9), rows=2, initial_covariance=100.0)
    white = copy.copy(weighted)
    weighted.run(phi, y, gamma=gamma)
    white.run(root @ phi, root @ y)
    assert np.allclose(weighted.theta, white.theta, rtol=1e-12)
    each = copy.copy(white)
    each.reset()
    each.run(phi, y, gamma=np.tile(gamma, (50, 1, 1)))
    assert each.to_bytes() == weighted.to_bytes()


def test_missing_samples_are_left_out_and_counted():
    phi, y = record(30, 1, 1)
    phi, y = phi[:, 0], y[:, 0, 0]
    holes = [3, 4, 20]
    y[3] = np.nan
    phi[4, 1] = np.nan
    y[20] = np.nan
    est = fg.RLS(3, rule=fg.Exponential(0.95))
    with pytest.raises(fg.InvalidInput, match=r"sample 3: y\[0\] = NaN"):
        est.run(phi, y)
    run = est.run(phi, y, missing="skip", outputs=["theta", "skipped", "error"])
    assert [k for k in range(30) if fg.SKIPPED[int(run.skipped[k])] == "missing"] == holes
    assert (run.samples, run.used, run.skipped_count) == (30, 27, 3)
    assert np.isnan(run.error[holes]).all()
    assert np.array_equal(run.theta[4], run.theta[2])
    without = fg.RLS(3, rule=fg.Exponential(0.95))
    kept = np.setdiff1d(np.arange(30), holes)
    without.run(phi[kept], y[kept])
    assert without.to_bytes() == est.to_bytes()


def test_targets_are_independent_estimators_that_share_one_covariance():
    phi, y = record(80, 1, 3)
    together = fg.RLS(3, rule=fg.Subspace(0.95), targets=3)
    together.run(phi, y)
    for target in range(3):
        alone = fg.RLS(3, rule=fg.Subspace(0.95))
        alone.run(phi, y[:, :, target])
        assert np.array_equal(alone.theta, together.theta[:, target])
        assert np.array_equal(alone.covariance, together.covariance)


def test_a_rule_survives_the_way_into_the_core_and_back():
    for rule in RULES:
        assert repr(fg.RLS(3, rule=rule).rule) == repr(rule)
        assert fg.RLS(3, rule=rule).rule == rule
    assert fg.RLS(2, rule="exponential").rule == fg.Exponential()
    assert fg.RLS(2, initial_covariance=1.0).rule.name == "subspace"
    assert fg.RLS(2).rule == fg.RandomWalk(0.003, bound=1e5)
