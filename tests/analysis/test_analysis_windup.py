"""Windup: the definition, what it does not depend on, and the cheap live alarm."""

import json
from functools import lru_cache

import dense_gf_rls as dense
import numpy as np
import pytest
from live_windup import factor_ud, live_alarms

from forgetting.analysis import Trajectory, certify, windup

SAMPLES, DAY = 2000, 500


def _inputs():
    """Regressors of four parameters that stop exciting in different ways after `DAY`."""
    rng = np.random.default_rng(0)
    day = rng.normal(size=(DAY, 4))
    rest = SAMPLES - DAY
    return {
        "night": np.concatenate([day, np.zeros((1000, 4)), rng.normal(size=(500, 4))]),
        "constant": np.concatenate([day, np.tile(rng.normal(size=4), (rest, 1))]),
        "noise only": np.concatenate([day, 1e-3 * rng.normal(size=(rest, 4))]),
        "a third": np.concatenate([day, 0.3 * rng.normal(size=(rest, 4))]),
        "always": rng.normal(size=(SAMPLES, 4)),
        "two directions": rng.normal(size=(SAMPLES, 2)) @ rng.normal(size=(2, 4)),
    }


def _rates():
    rates = np.full(SAMPLES, 0.99)
    rates[800:830] = 0.8
    return rates


INPUTS = _inputs()
SILENT = {"night", "constant", "noise only", "two directions"}
#: Rules by the inputs under which they wind up.
RULES = {
    "none": (dense.none(), set()),
    "exponential": (dense.exponential(0.99), SILENT),
    "variable_rate": (dense.variable_rate(_rates()), SILENT),
    "subspace": (dense.subspace(0.99, 1e-4), set()),
    "variable_direction": (dense.variable_direction(0.99, 1e-2), set()),
    # Without a threshold noise alone is forgotten for: the caveat of both rules.
    "oblique_projection": (dense.oblique_projection(0.99), {"noise only"}),
    "restricted": (dense.restricted(0.99), {"noise only"}),
    "random_walk": (dense.random_walk(1e-3 * np.eye(4)), SILENT - {"two directions"}),
    "component_discount": (dense.component_discount(np.array([0.99, 0.98, 0.97, 0.99])), SILENT),
}
CASES = [(rule, given) for rule in RULES for given in INPUTS]


def _record(rule, given):
    phi = INPUTS[given][None, :, None, :]
    return dense.simulate(rule, phi, None, np.eye(4)).trajectory()


@lru_cache(maxsize=1)
def _records(rule):
    """Trajectories of a rule by input; all inputs run side by side."""
    phi = np.stack(list(INPUTS.values()))[:, :, None, :]
    runs = dense.simulate(RULES[rule][0], phi, None, np.eye(4))
    return {name: runs.trajectory(k) for k, name in enumerate(INPUTS)}


@pytest.mark.parametrize(("rule", "given"), CASES)
def test_windup_is_where_it_should_be_and_the_live_alarm_agrees(rule, given):
    trajectory = _records(rule)[given]
    found = windup(trajectory)
    assert found.occurred is (given in RULES[rule][1])
    assert live_alarms(trajectory, found.window).any() == found.occurred


def test_the_first_alarm_is_when_the_variance_has_grown_tenfold():
    trajectory = _record(dense.exponential(0.99), "night")
    found = windup(trajectory)
    needed = int(np.ceil(np.log(10) / -np.log(0.99)))
    # The direction that was informed least in the last samples of the day leads by a few.
    assert DAY - 10 <= found.sample - needed <= DAY
    assert found.growth == pytest.approx(0.99**-1000, rel=0.1)
    assert not found.persists and DAY - 10 <= found.informed < DAY


def test_the_direction_is_the_one_nothing_is_said_about():
    trajectory = _record(dense.exponential(0.99), "constant")
    found = windup(trajectory)
    assert found.persists
    assert np.abs(INPUTS["constant"][-1] @ found.direction) < 1e-6
    largest = np.linalg.eigh(trajectory.after[-1])[1][:, 1:]  # the silent three of four
    assert np.linalg.norm(largest.T @ found.direction) == pytest.approx(1.0, abs=1e-6)


def test_a_ceiling_excuses_growth_that_the_rule_means():
    rule = dense.resetting(0.99, np.eye(4))
    trajectory = _record(rule, "night")
    assert windup(trajectory).occurred
    assert not windup(trajectory, ceiling=1.0).occurred
    assert windup(trajectory, ceiling=0.1).occurred
    assert windup(_record(dense.exponential(0.99), "night"), ceiling=1.0).occurred


def test_units_of_the_parameters_do_not_matter():
    trajectory = _record(dense.exponential(0.99), "constant")
    units = np.diag([1.0, 1e-3, 1e3, 10.0]) @ np.linalg.qr(np.ones((4, 4)) + np.eye(4))[0]
    back = np.linalg.inv(units)
    path = np.concatenate([trajectory.before, trajectory.after[-1:]])
    prior = units @ trajectory.prior @ units.T
    turned = Trajectory.from_arrays(
        trajectory.phibar @ back, units @ path @ units.T, prior_covariance=prior
    )
    first, second = windup(trajectory, stride=7), windup(turned, stride=7)
    assert first.sample == second.sample
    # Up to where P has lost half of the digits to windup.
    fine = first.path < 1e4
    np.testing.assert_allclose(second.path[fine], first.path[fine], rtol=1e-4)


def test_growth_while_informed_is_not_windup():
    # Forgetting jumps from 0.9999 to 0.97: P grows manyfold, with all the data it needs.
    rates = np.where(np.arange(SAMPLES) < 1500, 0.9999, 0.97)
    trajectory = _record(dense.variable_rate(rates), "always")
    grown = (
        np.linalg.eigvalsh(trajectory.after[-1])[0] / np.linalg.eigvalsh(trajectory.after[1490])[-1]
    )
    assert grown > 10
    assert not windup(trajectory, window=50).occurred


def test_factors_of_the_live_alarm():
    rng = np.random.default_rng(1)
    A = rng.normal(size=(5, 4, 4))
    P = A @ np.swapaxes(A, 1, 2) + np.eye(4)
    U, d = factor_ud(P)
    np.testing.assert_allclose((U * d[:, None, :]) @ np.swapaxes(U, 1, 2), P, rtol=1e-12)
    np.testing.assert_array_equal(np.tril(U, -1), 0.0)
    np.testing.assert_allclose(np.diagonal(U, axis1=1, axis2=2), 1.0, rtol=1e-15)


def test_certificate_says_it_in_words_and_json():
    names = ["a1", "a2", "b0", "b1"]
    bad = certify(_record(dense.exponential(0.99), "night"), names=names)
    good = certify(_record(dense.exponential(0.99), "always"), names=names)
    held = certify(_record(dense.subspace(0.99, 1e-4), "two directions"), names=names)
    assert (bad.windup_occurred, good.windup_occurred, held.windup_occurred) == (True, False, False)
    assert bad.verdict.startswith("Windup occurred: do not trust the estimate along")
    assert good.verdict == "No windup: every direction is excited and the estimate is stable."
    assert "informs about 2 of 4 directions" in held.verdict and "a1" in held.verdict
    for found in (bad, good, held):
        text = json.dumps(found.to_dict(), allow_nan=False)
        assert json.loads(text)["windup_occurred"] is found.windup_occurred
        assert found.verdict in str(found)
        assert "more than 10 times" in found.to_dict()["windup"]["definition"]
