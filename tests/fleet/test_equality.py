"""A stream of a fleet is the single estimator, whatever the rule, the rate and the weighting."""

import numpy as np
import pytest
from company import CODES, assert_follows, assert_same, samples

import forgetting as fg

RULES = [about["name"] for about in fg.rules() if about["name"] != "custom"]
RATES = [about["name"] for about in fg.rates() if about["name"] != "function"]
DTYPES = ["float64", "float32"]
# a whole block of lanes, more than one, and some streams over
COUNT = 37


def follow(rule, n, dtype, length=60, **more):
    fleet = fg.Fleet(COUNT, n, rule=rule, dtype=dtype, **more)
    singles = [fg.RLS(n, rule=rule, dtype=dtype, **more) for _ in range(COUNT)]
    return assert_follows(fleet, singles, samples(length, COUNT, n, dtype))


@pytest.mark.parametrize("dtype", DTYPES)
@pytest.mark.parametrize("name", RULES)
def test_every_rule(name, dtype):
    seen = follow(name, 3, dtype)
    assert {0, CODES["missing"], CODES["refused"]} <= seen


@pytest.mark.parametrize("name", RATES)
def test_every_rate(name):
    follow(fg.Exponential(fg.rate(name)), 3, "float64")


@pytest.mark.parametrize("about", fg.weightings(), ids=lambda about: about["name"])
def test_every_weighting(about):
    follow(fg.Subspace(0.9), 3, "float64", weighting=about["name"])


@pytest.mark.parametrize("about", fg.gates(), ids=lambda about: about["name"])
def test_every_gate(about):
    if about["name"] != "gate_function":
        follow(fg.Subspace(0.9), 3, "float64", gate=about["name"])


def test_values_of_its_own_for_each_stream():
    random = np.random.default_rng(1)
    factor = random.uniform(0.8, 1.0, size=COUNT)
    theta = random.normal(size=(COUNT, 3))
    variance = random.uniform(1.0, 100.0, size=(COUNT, 3))
    full = np.einsum("cij,ckj->cik", *[random.normal(size=(COUNT, 3, 3))] * 2) + np.eye(3)
    for covariance in (variance, full):
        given = {"initial_covariance": covariance, "initial_theta": theta}
        fleet = fg.Fleet(COUNT, 3, rule="exponential", forgetting_factor=factor, **given)
        singles = [
            fg.RLS(3, rule=fg.Exponential(factor[i]), initial_covariance=covariance[i],
                   initial_theta=theta[i])
            for i in range(COUNT)
        ]  # fmt: skip
        assert_same(fleet, singles)
        assert_follows(fleet, singles, samples(40, COUNT, 3))
        np.testing.assert_array_equal(fleet.forgetting_factor, factor)
        assert fleet[5].rule == fg.Exponential(factor[5])


@pytest.mark.parametrize("covariance", [7.0, [1.0, 2.0, 3.0], np.eye(3) + 0.5])
def test_values_for_all_streams(covariance):
    given = {"initial_covariance": covariance, "initial_theta": [1.0, -2.0, 3.0]}
    fleet = fg.Fleet(3, 3, **given, forgetting_factor=0.9)
    assert_same(fleet, [fg.RLS(3, rule=fg.Subspace(0.9), **given)] * 3)


def test_a_fleet_predicts_and_tells_each_covariance():
    fleet, given = fg.Fleet(COUNT, 4, rule="exponential"), samples(20, COUNT, 4)
    for phi, y in zip(given.phi, given.y, strict=True):
        fleet.update(phi, y)
    phi = np.nan_to_num(given.phi[-1], posinf=1.0, neginf=1.0)
    single = [fleet[i].predict(phi[i]) for i in range(COUNT)]
    np.testing.assert_array_equal(fleet.predict(phi), single)
    np.testing.assert_array_equal(fleet.covariance(-1), fleet[-1].covariance)


@pytest.mark.parametrize("rule", [fg.Exponential(0.9), fg.Subspace(0.9), fg.RandomWalk()])
def test_health_is_that_of_each_stream(rule):
    fleet = fg.Fleet(COUNT, 3, rule=rule)
    phi = np.ones((COUNT, 3))
    phi[::2] = np.random.default_rng(0).normal(size=phi[::2].shape)
    windup = np.zeros(COUNT, bool)
    for _ in range(30):
        before = [fleet[i] for i in range(COUNT)]
        fleet.update(phi, np.ones(COUNT))
        windup = np.array([b.update(f, 1.0).windup for b, f in zip(before, phi, strict=True)])
    health = fleet.health()
    for i in range(COUNT):
        single = fleet[i].health()
        assert health.largest_eigenvalue[i] == single.largest_eigenvalue
        assert health.smallest_eigenvalue[i] == single.smallest_eigenvalue
        assert health.condition[i] == single.condition
        assert health.status[i] == ("windup" if windup[i] else "ok")
    np.testing.assert_array_equal(health.windup, windup)
    assert windup.any() == (rule.name == "exponential")


def test_only_what_is_asked_for_is_told():
    fleet = fg.Fleet(3, 2)
    update = fleet.update(np.ones((3, 2)), np.ones(3))
    assert update.leverage is None
    assert update.error.tolist() == [1.0, 1.0, 1.0]
    assert update.skipped.tolist() == [0, 0, 0]
    update = fleet.update(np.ones((3, 2)), np.ones(3), outputs=[])
    assert (update.error, update.leverage, update.skipped, update.used) == (None, None, None, 3)
