"""What the definitions promise: limits, equivalences, properness, and the corrected errata."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from . import rates, rules
from .eigen import eigen_symmetric
from .estimator import Estimator
from .linalg import (
    Matrix,
    Real,
    difference,
    identity,
    inverse,
    matrix,
    symmetric,
    symmetric_parameter,
    to_float,
    transpose,
)
from .rules.covariance_resetting import Dense as Resetting
from .signals import KINDS, Record, record

# Two computations of one thing in 77 digits; measured 1e-66 at worst, see test_reference.AGREE.
SAME = 1e-45
FACTOR = 0.9


def estimator(name: str, n: int, factor: float = FACTOR, p0: object = 100.0, **parameters: object):
    module = rules.load(name)
    rate = rates.load("constant").Rate(factor)
    return Estimator(n, module.Dense(n, **parameters), rate, None, 1, p0)


def run(dense: Estimator, data: Record) -> list[Matrix]:
    """Feeds a record; returns the F of every used sample."""
    forgotten = []
    for phi, y in zip(data.phi, data.y, strict=True):
        dense.update(phi, y)
        if not dense.skipped:
            forgotten.append(dense.forgotten)
    return forgotten


def assert_same(a: Estimator, b: Estimator, data: Record) -> None:
    run(a, data)
    run(b, data)
    assert difference(a.theta, b.theta) < SAME
    assert difference(a.covariance, b.covariance) < SAME


EQUAL = [
    ("exponential_resetting", {"information": 0.02}, "matrix_forgetting", {"information": 0.02}, 1),
    ("component", {"blocks": [3]}, "exponential", {}, 2),
    ("multiple", {"blocks": [3]}, "exponential", {}, 2),
    ("subspace", {"threshold": 1e-3}, "directional", {"threshold": 1e-3}, 1),
    ("subspace", {"threshold": 1e-9}, "oblique_projection", {"threshold": 1e-9}, 2),
    ("exponential_resetting", {"information": 0.0}, "exponential", {}, 2),
    ("cyclic_resetting", {"information": 0.0}, "exponential", {}, 2),
    (
        "matrix_forgetting",
        {"information": 0.02, "power": 3},
        "matrix_forgetting",
        {"information": 0.02, "power": 3, "choice": 2, "shift": 0.0},
        2,
    ),
]


@pytest.mark.parametrize(("first", "one", "second", "other", "p"), EQUAL)
def test_rules_that_coincide(first: str, one: dict, second: str, other: dict, p: int) -> None:
    data = record("exciting", 40, p, 3, seed=10)
    assert_same(estimator(first, 3, **one), estimator(second, 3, **other), data)


def test_factor_one_forgets_nothing() -> None:
    """...for every rated rule but `multiple` (drops cross-information) and `efra` (resets)."""
    data = record("exciting", 20, 1, 3, seed=11)
    for name in rules.NAMES:
        module = rules.load(name)
        if not module.RATED or name in ("multiple", "efra", "covariance_resetting"):
            continue
        case = {k: v for k, v in module.cases(3)[0].items() if k != "forgetting_factor"}
        dense = estimator(name, 3, factor=1.0, **case)
        assert all(max(abs(x) for x in f.entries()) < Real(10) ** -70 for f in run(dense, data))


PROPER = {  # rule: parameters for which F >= 0 always
    "exponential": {},
    "exponential_resetting": {"information": 0.009},  # P_0 = 100
    "data_dependent": {"noise_bound": 0.1, "largest_weight": 0.3, "initial_radius": 1.0},
    "directional": {"threshold": 0.5},
    "variable_direction": {"threshold": 0.5},
    "restricted": {},
    "component": {"forgetting_factor": [0.8, 0.9, 0.99]},
    "oblique_projection": {"threshold": 0.5},
    "subspace": {"threshold": 0.5},
    "matrix_forgetting": {"information": 0.009, "power": 3},
    "random_walk": {"process_noise": 1e-3},
    "efra": {"gain": 0.5, "increase": 5e-3, "saturation": 1e-4},
}
IMPROPER = {  # rule: parameters for which F < 0 happens
    "exponential_resetting": {"information": 2.0},
    "cyclic_resetting": {"information": 0.01},
    "multiple": {},
    "constant_trace": {"level": 1.0, "floor": 0.01},
    "matrix_forgetting": {"information": 0.5},
    "covariance_resetting": {"criterion": "period", "period": 5, "covariance": 1e-3},
}


def smallest(name: str, parameters: dict[str, object]) -> float:
    """Smallest eigenvalue of F relative to the size of R, over several inputs."""
    found = []
    for kind in KINDS:
        dense = estimator(name, 3, **parameters)
        data = record(kind, 30, 1, 3, seed=12)
        for forgotten in run(dense, data):
            size = float(max(abs(x) for x in dense.information.entries()))
            found.append(float(eigen_symmetric(symmetric(forgotten))[0][-1]) / size)
    return min(found)


@pytest.mark.parametrize("name", PROPER)
def test_proper_rules(name: str) -> None:
    assert smallest(name, PROPER[name]) > -1e-60


@pytest.mark.parametrize("name", IMPROPER)
def test_counterexamples_of_improper_rules(name: str) -> None:
    assert smallest(name, IMPROPER[name]) < -1e-6


def test_one_cycle_without_data_resets_exactly() -> None:
    full = rules.load("cyclic_resetting").cases(4)[1]["information"]
    dense = estimator("cyclic_resetting", 4, information=full)
    before = dense.information
    for _ in range(4):
        dense.update(np.zeros((1, 4)), np.zeros((1, 1)))
    kept = Real(FACTOR) ** 4
    expected = kept * before + (1 - kept) * symmetric_parameter(full, 4)
    assert difference(dense.information, expected) < SAME


def test_variable_direction_ignores_the_choice_of_eigenvectors() -> None:
    """P_0 = c I leaves them free: rotated coordinates must give the rotated estimates."""
    rng = np.random.default_rng(13)
    turn = np.linalg.qr(rng.standard_normal((4, 4)))[0]
    data = record("exciting", 12, 1, 4, seed=13)
    plain = estimator("variable_direction", 4, threshold=0.3)
    turned = estimator("variable_direction", 4, threshold=0.3)
    run(plain, data)
    run(turned, data._replace(phi=data.phi @ turn))
    back = turn @ to_float(turned.theta)
    # the rotation itself is orthogonal to double precision only
    assert np.abs(back - to_float(plain.theta)).max() < 1e-12


def test_variable_direction_forgets_at_most_rank_directions_of_a_cluster() -> None:
    dense = estimator("variable_direction", 5, threshold=1e-6)
    dense.update(np.ones((1, 5)), np.ones((1, 1)))
    values = [float(x) for x in eigen_symmetric(dense.forgotten)[0]]
    assert values[0] == pytest.approx((1 - FACTOR) / 100)
    assert max(abs(x) for x in values[1:]) < 1e-70


def test_data_dependent_weight_minimises_the_radius() -> None:
    module = rules.load("data_dependent")
    data = record("exciting", 30, 2, 3, seed=14)
    rule = module.Dense(3, noise_bound=0.2, largest_weight=0.4, initial_radius=1.0)
    dense = Estimator(3, rule)
    for phi, y in zip(data.phi, data.y, strict=True):
        error = matrix(y) - matrix(phi) * dense.theta
        spread = matrix(phi) * dense.covariance * transpose(matrix(phi))
        before = rule.radius
        dense.update(phi, y)
        for mu in np.linspace(0.0, 0.4, 41):
            m = (1 - mu) * identity(2) + mu * spread
            gained = (transpose(error) * inverse(m) * error)[0, 0]
            radius = (1 - mu) * before + mu * rule.bound - mu * (1 - mu) * gained
            assert rule.after_radius <= radius + Real(10) ** -60


def test_data_dependent_ellipsoid_holds_the_truth() -> None:
    rng = np.random.default_rng(15)
    truth = np.array([[0.3], [-0.5]])
    rule = rules.load("data_dependent").Dense(2, 0.1, 0.5, 1.0)
    dense = Estimator(2, rule, initial_covariance=1.0)
    for _ in range(60):
        phi = rng.standard_normal((1, 2))
        dense.update(phi, phi @ truth + rng.uniform(-0.1, 0.1, (1, 1)))
        off = matrix(truth) - dense.theta
        assert (transpose(off) * dense.information * off)[0, 0] <= rule.radius


def test_printed_factor_of_data_dependent_updating_is_improper() -> None:
    """GF-RLS (50), lambda_k = (1 - mu_k) mu_{k-1} / mu_k, exceeds 1 on an ordinary run."""
    data = record("exciting", 40, 1, 2, seed=16)
    rule = rules.load("data_dependent").Dense(2, 0.2, 0.5, 1.0)
    dense, used = Estimator(2, rule), []
    for phi, y in zip(data.phi, data.y, strict=True):
        dense.update(phi, y)
        if not dense.skipped:
            used.append(float(rule.weight))
    assert len(used) < 40  # some mu_k = 0, where (50) is not even defined
    assert max((1 - b) * a / b for a, b in pairwise(used)) > 1


def test_restricted_may_lose_information_and_stays_positive() -> None:
    dense = estimator("restricted", 2, factor=0.5, p0=0.01)
    before = inverse(dense.covariance)
    dense.update(np.array([[1.0, 0.5]]), np.array([[1.0]]))
    change = to_float(inverse(dense.covariance) - before)
    assert change[0, 0] < 0
    assert float(eigen_symmetric(dense.covariance)[0][-1]) > 0


def test_efra_grows_to_its_bound_in_silence() -> None:
    gain, increase, saturation = 0.5, 5e-3, 1e-4
    dense = estimator("efra", 2, gain=gain, increase=increase, saturation=saturation)
    for _ in range(300):
        dense.update(np.zeros((1, 2)), np.zeros((1, 1)))
    g = 1 / FACTOR - 1
    bound = g / (2 * saturation) * (1 + np.sqrt(1 + 4 * increase * saturation / g**2))
    assert to_float(dense.covariance) == pytest.approx(bound * np.eye(2), rel=1e-12)


def test_constant_trace_is_constant() -> None:
    dense = estimator("constant_trace", 3, level=10.0, floor=0.1)
    for phi, y in zip(*record("silent", 20, 2, 3, seed=17)[1:3], strict=True):
        dense.update(phi, y)
        assert float(dense.covariance.trace()) == pytest.approx(30.0, rel=1e-14)


@pytest.mark.parametrize("index", range(6))
def test_every_reset_criterion_fires(index: int) -> None:
    """The agreement tests of `covariance_resetting` are not vacuous."""
    fired = 0

    class Counting(Resetting):
        def measurement(self, step: object, y: Matrix) -> object:
            nonlocal fired
            result = super().measurement(step, y)
            fired += self.reset
            return result

    case = rules.load("covariance_resetting").cases(4)[index]
    dense = Estimator(4, Counting(4, **case), rates.load("constant").Rate(0.97))
    run(dense, record("exciting", 120, 1, 4, seed=1))
    assert 0 < fired < 120
