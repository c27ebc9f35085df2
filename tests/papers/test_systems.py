"""The systems against an independent formulation, and the eigenvalues against exact ones."""

from decimal import Decimal, getcontext

import numpy as np
import pytest

from forgetting.papers.eigenvalues import eigenpairs
from forgetting.papers.opd import system as opd
from forgetting.papers.vdf import systems


def state_space(numerator, denominator, u):
    """Observer form of Σ b q^(n-i) / (qⁿ - Σ a q^(n-i))."""
    n = len(denominator)
    a = np.eye(n, k=1)
    a[:, 0] = denominator
    x, y = np.zeros(n), []
    for value in u:
        y.append(x[0])
        x = a @ x + np.asarray(numerator) * value
    return np.array(y)


def test_fifth_order_system_is_its_transfer_function():
    phi, y, theta = systems.fifth_order(300)
    wanted = state_space(systems.NUMERATOR, systems.DENOMINATOR, systems.three_sinusoids(300))
    np.testing.assert_allclose(y, wanted, atol=1e-12)
    np.testing.assert_allclose(phi @ theta, y, atol=1e-12)


def test_first_order_system_is_its_transfer_function():
    phi, y, theta = systems.first_order(np.ones(50))
    np.testing.assert_allclose(y, state_space([0.8], [0.4], np.ones(50)), atol=1e-14)
    np.testing.assert_allclose(phi @ theta, y, atol=1e-14)


def test_regressors_are_delayed_signals():
    found = systems.delayed(np.array([1.0, 2.0, 3.0]), (0, 1, 2))
    assert found.tolist() == [[1, 0, 0], [2, 1, 0], [3, 2, 1]]


@pytest.mark.parametrize("inside", [True, False])
def test_opd_system_is_the_printed_one(inside):
    """y_1 and y_2 by the two printed equations, with the noise where it is said to be."""
    settings = opd.Settings(samples=80, inside=inside)
    _, y = opd.simulate(settings, seed=3)
    noise = 0.1 * np.random.default_rng(3).standard_normal((80, 2))
    y1 = y2 = 0.0
    for k in range(1, 81):
        u1 = 10 * np.sin(k * np.pi / 140) + 10 * np.cos(k * np.pi / 187)
        u2 = 10 * np.cos(k * np.pi / 123)
        a1, a3 = -0.3 - 0.1 * np.sin(k * np.pi / 515), -0.2 - 0.1 * np.cos(k / 159)
        clean1 = a1 * y1 + 0.8 * u1 + a3 * u2
        clean2 = 0.23 * y1 - 0.67 * y2 + (0.43 - 0.1 * np.sin(k / 235)) * u2
        v = noise[k - 1]
        np.testing.assert_allclose(y[k - 1], [clean1 + v[0], clean2 + v[1]], atol=1e-12)
        y1, y2 = (clean1 + v[0], clean2 + v[1]) if inside else (clean1, clean2)


@pytest.mark.parametrize("exponent", [0, 8, 30, 90])
def test_eigenvalues_keep_their_digits_whatever_the_condition(exponent):
    """U D Uᵀ for 2 x 2 in 250 digits: the smaller eigenvalue is the determinant over the larger."""
    getcontext().prec = 250
    u, d1, d2 = 0.75, 3.0, 7.0 * 10.0**exponent
    a, b, c = (Decimal(d1) + Decimal(u) ** 2 * Decimal(d2), Decimal(u) * Decimal(d2), Decimal(d2))
    mean, half = (a + c) / 2, (((a - c) / 2) ** 2 + b * b).sqrt()
    large = mean + half
    wanted = [float(large), float(Decimal(d1) * Decimal(d2) / large)]
    values, vectors = eigenpairs(np.array([[[1.0, u], [0.0, 1.0]]]), np.array([[d1, d2]]))
    np.testing.assert_allclose(values[0], wanted, rtol=1e-14)
    np.testing.assert_allclose(vectors[0].T @ vectors[0], np.eye(2), atol=1e-14)
