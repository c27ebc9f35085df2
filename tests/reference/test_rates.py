"""Rates and weights against derivatives, known limits and known quantiles."""

from __future__ import annotations

import numpy as np
import pytest

from . import rates, rules
from .estimator import Estimator
from .linalg import Matrix, Real, difference, matrix, to_float
from .rates.f_test import quantile
from .rates.gradient import Model
from .signals import record
from .step import Step
from .weighting import Huber, StudentT

CASES = [
    pytest.param(name, case, id=f"{name}-{i}")
    for name in rates.NAMES
    for i, case in enumerate(rates.load(name).CASES)
]


def factors(rate: object, scale: float = 1.0, root: np.ndarray | None = None) -> list[float]:
    """lambda_k over a record; optionally with the output scaled, or turned by ``root``."""
    data = record("exciting", 150, 2, 3, seed=20)
    dense = Estimator(3, rules.load("exponential").Dense(3), rate)
    turn = np.eye(2) if root is None else root
    gamma = None if scale == 1.0 and root is None else scale**2 * turn @ turn.T
    found = []
    for phi, y in zip(data.phi, data.y, strict=True):
        dense.update(scale * turn @ phi, scale * turn @ y, gamma)
        found.append(float(dense.factor))
    return found


@pytest.mark.parametrize(("name", "case"), CASES)
def test_rates_stay_in_their_range_and_move(name: str, case: dict[str, float]) -> None:
    found = factors(rates.load(name).Rate(**case))
    if name == "constant":
        assert set(found) == {case["forgetting_factor"]}
        return
    if name in ("schedule", "function"):  # the user's own factors, not a clipped design
        step, start = case.get("step", 0.0), case.get("start", 0.0)
        own = case.get("factors", [min(1.0, start + step * k) for k in range(len(found))])
        assert set(found) == set(own)
        return
    assert min(found) >= case["smallest"]
    assert max(found) <= case["largest"]
    assert len(set(found)) > 3


@pytest.mark.parametrize(("name", "case"), CASES)
def test_whitening_makes_rates_invariant(name: str, case: dict[str, float]) -> None:
    """Other units (a power of two, so exact) and another basis of the outputs."""
    module = rates.load(name)
    plain = factors(module.Rate(**case))
    assert factors(module.Rate(**case), scale=256.0) == pytest.approx(plain, abs=1e-14)
    mixed = factors(module.Rate(**case), root=np.array([[2.0, 0.5], [-1.0, 1.5]]))
    assert mixed == pytest.approx(plain, abs=1e-12)


def test_exact_gradient_is_the_derivative_of_theta() -> None:
    data = record("exciting", 12, 2, 3, seed=21)
    module = rates.load("exact_gradient")
    step = 2.0**-60

    def final(rate: object) -> Estimator:
        dense = Estimator(3, rules.load("exponential").Dense(3), rate)
        for phi, y in zip(data.phi, data.y, strict=True):
            dense.update(phi, y)
        return dense

    class Fixed:
        def __init__(self, value: Real) -> None:
            self.value = value

        def factor(self, step: Step) -> Real:
            return self.value

        def after(self, step: Step, covariance: Matrix) -> None:
            pass

    base = Real(0.95)
    rate = module.Rate(step_size=0.0, smallest=0.95, largest=0.95)
    final(rate)
    up, down = final(Fixed(base + step)), final(Fixed(base - step))
    slope = (up.theta - down.theta) / (2 * step)
    assert difference(rate.theta_slope, slope) < 1e-30
    slope = (up.covariance - down.covariance) / (2 * step)
    assert difference(rate.covariance_slope, slope) < 1e-30


@pytest.mark.parametrize("n", [1, 5, 12])
def test_gradient_model_has_the_known_excess_error(n: int) -> None:
    """J_k -> V (1 + n/k) without forgetting; the printed sign of 2/D in h gives n + 4."""
    model, cost = Model(n), Real(0)
    for _ in range(4000):
        zeta, h, _, _ = model.advance(Real(1))
        cost = zeta * cost + h
    assert float((cost - 1) * 4000) == pytest.approx(n, rel=2e-2)


def test_gradient_model_derivatives() -> None:
    """zeta' and h' with respect to the lambda of the last sample."""
    step = Real(2) ** -80
    ends = []
    for offset in (-step, Real(0), step):
        model = Model(3)
        for _ in range(20):
            model.advance(Real(0.9))
        ends.append(model.advance(Real(0.9) + offset))
    for value, slope in ((0, 2), (1, 3)):
        measured = (ends[2][value] - ends[0][value]) / (2 * step)
        assert float(abs(measured / ends[1][slope] - 1)) < 1e-40


# Tables of the F law (upper 5 % and 1 % points, four digits).
QUANTILES = [(0.95, 5, 40, 2.449), (0.95, 2, 10, 4.103), (0.99, 10, 100, 2.503), (0.99, 1, 1, 4052)]


@pytest.mark.parametrize(("probability", "a", "b", "expected"), QUANTILES)
def test_f_quantiles(probability: float, a: int, b: int, expected: float) -> None:
    assert float(quantile(Real(probability), Real(a), Real(b))) == pytest.approx(expected, rel=5e-4)


def test_fortescue_by_hand() -> None:
    """One row: 1 - e^2 / (N_0 sigma^2 (1 + s)), used from the next sample on."""
    rate = rates.load("fortescue").Rate(100.0, 0.02, 0.5, 0.99)
    dense = Estimator(1, rules.load("exponential").Dense(1), rate, initial_covariance=3.0)
    dense.update(np.array([[1.0]]), np.array([[1.0]]))  # s = 3 (before forgetting), e = 1
    assert float(dense.factor) == pytest.approx(0.99)
    dense.update(np.array([[1.0]]), np.array([[1.0]]))
    assert float(dense.factor) == pytest.approx(1 - 1 / (2.0 * 4.0))


@pytest.mark.parametrize("weighting", [Huber(1.345), StudentT(4.0)])
def test_one_outlier_has_bounded_influence(weighting: object) -> None:
    data = record("exciting", 30, 1, 3, seed=23)
    dense = Estimator(3, rules.load("subspace").Dense(3, threshold=1e-3), None, weighting)
    for phi, y in zip(data.phi, data.y, strict=True):
        dense.update(phi, y)
    before, p = to_float(dense.theta), to_float(dense.covariance)
    phi = data.phi[0]
    dense.update(phi, phi @ before + 1e6)
    limit = 1.345 if isinstance(weighting, Huber) else 5 / (2 * np.sqrt(4.0))
    # lambda = 1, so P-bar = P; without the weight the move is about 1e6 times larger
    assert (np.abs(to_float(dense.theta) - before) <= limit * np.abs(p @ phi.T) * (1 + 1e-9)).all()


def test_weights() -> None:
    r = matrix(np.array([[3.0, 0.0], [0.0, 4.0]]))  # two targets, lengths 3 and 4
    assert float(Huber(2.0).weight(r)) == 0.5
    assert float(Huber(5.0).weight(r)) == 1.0
    assert float(StudentT(4.0).weight(r)) == pytest.approx(6 / 20)
