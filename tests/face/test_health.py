"""The monitor: what it says of excitation, windup and noise, and that it changes nothing."""

import numpy as np
import pytest

import forgetting as fg

THETA = np.array([1.0, -2.0, 0.5, 3.0])
NOISE = 0.01
STUCK = np.array([1.0, 0.5, -0.3, 0.8])
BOUNDED = [fg.Subspace(0.98), fg.ExponentialResetting(0.98), fg.NoForgetting()]


def watched(rule, dtype="float64"):
    """An estimator after 2000 exciting samples, and a source of noise."""
    random = np.random.default_rng(3)
    est = fg.RLS(4, rule=rule, monitor=True, dtype=dtype)
    phi = random.normal(size=(2000, 4))
    run = est.run(phi, phi @ THETA + NOISE * random.normal(size=2000), outputs=["windup"])
    assert not run.windup.any()
    return est, random


def feed(est, random, phi, samples):
    phi = np.tile(phi, (samples, 1))
    y = phi @ THETA + NOISE * random.normal(size=samples)
    return est.run(phi, y, outputs=["windup"]).windup


@pytest.mark.parametrize("dtype", ["float64", "float32"])
@pytest.mark.parametrize("rule", [*BOUNDED, fg.Exponential(0.98)], ids=lambda rule: rule.name)
def test_excitation_is_ok_and_the_noise_is_found(rule, dtype):
    est, _ = watched(rule, dtype)
    health = est.health(exact=True)
    assert health.status == "ok"
    assert health.growth == 1.0
    assert health.noise_variance == pytest.approx(NOISE**2, rel=0.4)
    assert health.white
    values = np.linalg.eigvalsh(est.covariance.astype(float))
    assert health.largest_eigenvalue == pytest.approx(values[-1], rel=1e-4)
    assert health.smallest_eigenvalue == pytest.approx(values[0], rel=1e-4)
    bounds = est.health()
    assert bounds.largest_eigenvalue <= health.largest_eigenvalue * (1 + 1e-4)
    assert bounds.smallest_eigenvalue >= health.smallest_eigenvalue * (1 - 1e-4)


@pytest.mark.parametrize("dtype", ["float64", "float32"])
def test_exponential_winds_up_in_the_directions_without_excitation(dtype):
    est, random = watched(fg.Exponential(0.98), dtype)
    alarm = feed(est, random, STUCK, 400)
    growth_of_ten = np.log(10) / -np.log(0.98)
    assert growth_of_ten < alarm.argmax() < growth_of_ten + 80
    assert alarm[alarm.argmax() :].all()
    health = est.health()
    assert health.status == "windup"
    assert abs(health.direction @ STUCK) < 1e-3
    assert health.growth > 100
    assert 300 < health.since_informed <= 400


@pytest.mark.parametrize("rule", BOUNDED, ids=lambda rule: rule.name)
def test_bounded_rules_never_wind_up(rule):
    est, random = watched(rule)
    assert not feed(est, random, STUCK, 3000).any()
    assert not feed(est, random, np.zeros(4), 3000).any()
    if rule.name != "none":  # its memory is the whole record, 6000 silent samples are not most
        assert est.health().status == "unexcited"


def test_the_alarm_ends_when_excitation_returns():
    est, random = watched(fg.Exponential(0.98))
    assert feed(est, random, np.zeros(4), 400)[-1]
    phi = random.normal(size=(60, 4))
    run = est.run(phi, phi @ THETA, outputs=["windup"])
    assert not run.windup[-1]
    assert est.health().status == "ok"


def test_it_names_the_parameter():
    est, random = watched(fg.Exponential(0.98))
    feed(est, random, [1.0, 1.0, 1.0, 0.0], 50)
    random_but_last = random.normal(size=(400, 4)) * [1, 1, 1, 0]
    est.run(random_but_last, random_but_last @ THETA + NOISE * random.normal(size=400))
    health = est.health()
    assert health.describe(["a", "b", "c", "d"]).startswith("windup: nothing has informed d for 4")
    assert health.since_excited[3] >= 450
    assert health.since_excited[:3].max() < 20


def test_correlated_innovations_are_not_white():
    random = np.random.default_rng(0)
    est = fg.RLS(1, rule=fg.Exponential(0.99), monitor=True)
    noise = np.zeros(3000)
    for k in range(1, 3000):
        noise[k] = 0.8 * noise[k - 1] + random.normal()
    phi = random.normal(size=(3000, 1))
    est.run(phi, phi[:, 0] + noise)
    health = est.health()
    assert health.white is False
    assert health.correlation == pytest.approx(0.8, abs=0.15)


def test_the_watch_changes_no_estimate_and_is_saved_with_it():
    random = np.random.default_rng(1)
    phi, y = random.normal(size=(100, 4)), random.normal(size=100)
    plain, seen = fg.RLS(4), fg.RLS(4, monitor=True)
    assert np.array_equal(plain.run(phi, y).theta, seen.run(phi, y).theta)
    assert fg.RLS.from_bytes(seen.to_bytes()).watched().keys() == seen.watched().keys()
    assert fg.RLS.from_bytes(seen.to_bytes()).to_bytes() == seen.to_bytes()
    assert plain.watched() is None
    assert plain.health().direction is None
    assert plain.health().status == "ok"
    seen.reset()
    assert seen.watched()["samples"] == 0


@pytest.mark.parametrize("n", [1, 3])
def test_a_rate_that_forgets_much_at_once_is_no_windup(n):
    """P grows many times over, with all the data it needs."""
    rates = [
        lambda evidence: 0.999 if evidence.samples < 1500 else 0.7,
        fg.UnityZone(),
        fg.Fortescue(memory=50.0, noise_variance=0.01, smallest=0.3),
    ]
    random = np.random.default_rng(n)
    for rate in rates:
        phi = random.normal(size=(2500, n))
        theta = np.where(np.arange(2500) < 1000, 1.0, 6.0)
        y = phi.sum(axis=1) * theta + 0.1 * random.normal(size=2500)
        est = fg.RLS(n, rule=fg.Exponential(rate), monitor=True)
        run = est.run(phi, y, outputs=["windup", "variance"])
        assert run.variance[1000:].max() > 10 * run.variance[999].min()
        assert not run.windup.any(), rate


def test_a_trickle_does_not_end_the_alarm_at_once():
    """Noise of the regressor tells something beside a variance that has grown by far."""
    random = np.random.default_rng(0)
    est = fg.RLS(1, rule=fg.Exponential(0.9), monitor=True)
    est.run(random.normal(size=(300, 1)), random.normal(size=300))
    run = est.run(np.zeros((100, 1)), np.zeros(100), outputs=["windup"])
    assert run.windup[-1] and est.health().growth > 1e3
    share = 0.05  # of its own variance, in each block of ten samples
    trickle = np.sqrt(share / 10 / est.covariance[0, 0])
    assert est.run(np.full((9, 1), trickle), np.zeros(9), outputs=["windup"]).windup.all()


def test_units_do_not_hide_a_direction_that_winds_up():
    """The variance of b stays far below that of the others, for its regressor is large."""
    random = np.random.default_rng(2)
    units = np.array([1.0, 1e3, 1e-3])
    est = fg.RLS(3, rule=fg.Exponential(0.98), initial_covariance=100 / units**2, monitor=True)
    phi = random.normal(size=(2000, 3)) * units
    phi[1000:, 1] = 0.0
    run = est.run(phi, phi.sum(axis=1) + random.normal(size=2000), outputs=["windup", "variance"])
    assert run.variance[1400].argmax() == 2
    growth_of_ten = np.log(10) / -np.log(0.98)
    assert growth_of_ten < run.windup.argmax() - 1000 < growth_of_ten + 150
    health = est.health()
    assert health.describe(["a", "b", "c"]).startswith("windup: nothing has informed b for")
    assert np.abs(health.parts).round(3).tolist() == [0.0, 1.0, 0.0]


def test_a_direction_that_is_always_weak_does_not_hide_another():
    random = np.random.default_rng(6)
    phi = random.normal(size=(4000, 4))
    phi[:, 3] = phi[:, 2] + 0.01 * phi[:, 3]  # the difference is hard to tell, always
    phi[2000:, 0] = 0.0
    est = fg.RLS(4, rule=fg.Exponential(0.99), monitor=True)
    run = est.run(phi, phi.sum(axis=1) + random.normal(size=4000), outputs=["windup", "variance"])
    first = int(run.windup.argmax())
    assert first > 2000 and run.variance[first, 0] < run.variance[first, 3]
    assert est.health().describe(list("abcd")).startswith("windup: nothing has informed a for")


def test_a_trickle_is_no_recovery():
    """P stays thousands of times what it was: the alarm ends, the doubt does not."""
    random = np.random.default_rng(0)
    est = fg.RLS(2, rule=fg.Exponential(0.95), monitor=True)
    phi = random.normal(size=(500, 2))
    est.run(phi, phi.sum(axis=1))
    known = est.covariance[0, 0]
    est.run(np.zeros((250, 2)), np.zeros(250))
    assert est.health().status == "windup"
    small = 1e-2 * random.normal(size=(2000, 2))
    est.run(small, small.sum(axis=1))
    health = est.health()
    assert est.covariance[0, 0] > 5e3 * known and health.informed
    assert health.status == "recovering" and health.growth > 1e3
    assert "times what it was before" in health.describe(["a", "b"])
    assert health.judgement()["windup"].severity == "warning"
    est.run(phi, phi.sum(axis=1))
    assert est.health().status == "ok"


def test_a_prior_that_is_far_too_sure_is_no_doubt_for_ever():
    """What was never informed has nothing to compare with."""
    random = np.random.default_rng(0)
    est = fg.RLS(2, rule=fg.Exponential(0.95), initial_covariance=1e-8, monitor=True)
    phi = random.normal(size=(2000, 2))
    est.run(phi, phi.sum(axis=1) + random.normal(size=2000))
    assert est.health().status == "ok" and est.health().growth == 1.0


def test_health_speaks_the_words_of_the_judge():
    est, random = watched(fg.Exponential(0.98))
    assert est.health().judgement().severity == "good"
    feed(est, random, STUCK, 400)
    found = est.health().judgement(["a", "b", "c", "d"])
    assert found["windup"].severity == "wrong" and found["windup"].text.startswith("windup: ")
    noise = np.zeros(3000)
    for k in range(1, 3000):
        noise[k] = 0.995 * noise[k - 1] + random.normal()
    est = fg.RLS(1, rule=fg.NoForgetting(), monitor=True)
    phi = random.normal(size=(3000, 1))
    est.run(phi, phi[:, 0] + noise)
    assert est.health().judgement()["residuals"].severity == "wrong"
