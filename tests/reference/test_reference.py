"""The references check themselves: dense Theorem 1 = published form = minimiser of the cost (4)."""

from __future__ import annotations

import numpy as np
import pytest

from . import rates, rules
from .agreement import compare
from .eigen import eigen_symmetric, svd
from .estimator import Estimator
from .linalg import Matrix, cholesky, diagonal, difference, identity, matrix, transpose
from .signals import KINDS, record

# Measured: 4e-54 at worst (`component` on nearly collinear input, where P reaches condition 1e20;
# 1e-68 elsewhere), of 77 digits carried. A wrong term shows up at 1e-3 and above.
AGREE = 1e-45
SAMPLES = 80
SHAPES = [(1, 1, 1), (2, 2, 1), (4, 1, 2), (4, 3, 1), (8, 2, 1)]
WIDE_KINDS = {"exciting", "deficient"}  # n = 8 takes half of the time
FACTOR = 0.97

CASES = [
    pytest.param(name, index, id=f"{name}-{index}")
    for name in rules.NAMES
    for index in range(len(rules.load(name).cases(8)))
]


@pytest.mark.parametrize(("name", "index"), CASES)
def test_dense_equals_published_equals_minimiser(name: str, index: int) -> None:
    module = rules.load(name)
    for n, p, targets in SHAPES:
        cases = module.cases(n)
        if index >= len(cases) or (p > 1 and module.Dense(n, **cases[index]).single_row):
            continue
        for kind in KINDS if n < 8 else WIDE_KINDS:
            data = record(kind, SAMPLES, p, n, targets, weighted=kind != "silent", seed=1)
            rate = rates.load("constant").Rate(FACTOR)
            found = compare(module, cases[index], data, rate)
            assert found.worst() < AGREE, (n, p, targets, kind, found)


@pytest.mark.parametrize("name", rates.NAMES)
def test_rates_drive_rules_without_losing_agreement(name: str) -> None:
    """A varying lambda: the published forms get the dense run's sequence."""
    module = rates.load(name)
    for rule in ("exponential", "subspace", "restricted", "cyclic_resetting"):
        form = rules.load(rule)
        for case in module.CASES:
            data = record("exciting", SAMPLES, 2, 3, 2, weighted=True, seed=2)
            found = compare(form, form.cases(3)[0], data, module.Rate(**case))
            assert found.worst() < AGREE, (rule, case, found)


def test_minimiser_beats_its_neighbours() -> None:
    """The cost evaluated from its definition rises in every direction from the minimiser."""
    module = rules.load("exponential_resetting")
    data = record("exciting", 40, 2, 3, seed=3)
    dense = Estimator(3, module.Dense(3, information=0.5), rates.load("constant").Rate(0.9))
    for phi, y in zip(data.phi, data.y, strict=True):
        dense.update(phi, y)
    best = dense.cost.value(dense.theta)
    for i in range(3):
        for sign in (-1, 1):
            step = Matrix([[sign * 1e-20 * (i == j)] for j in range(3)])
            assert dense.cost.value(dense.theta + step) > best


def test_exponential_minimises_the_discounted_cost() -> None:
    """GF-RLS (41) for a varying lambda, minimised as one batch problem."""
    data = record("exciting", 50, 2, 3, seed=4)
    module = rates.load("rms_ratio")
    dense = Estimator(3, rules.load("exponential").Dense(3), module.Rate(**module.CASES[1]))
    for phi, y in zip(data.phi, data.y, strict=True):
        dense.update(phi, y)
    hessian, right = identity(3) / 100, Matrix(3, 1)
    for phi, y, factor in dense.whitened:
        hessian = factor * hessian + transpose(phi) * phi
        right = factor * right + transpose(phi) * y
    assert difference(hessian.solve(right), dense.theta) < AGREE


@pytest.mark.parametrize("n", [1, 3, 8])
def test_decompositions(n: int) -> None:
    rng = np.random.default_rng(n)
    a = rng.standard_normal((n, n))
    graded = matrix(a @ np.diag(10.0 ** -np.arange(n)) @ a.T)
    for square in (graded, identity(n), matrix(np.diag(np.arange(n) // 2 + 1.0))):
        square = (square + transpose(square)) / 2
        values, vectors = eigen_symmetric(square)
        assert difference(vectors * diagonal(values) * transpose(vectors), square) < 1e-70
        assert difference(transpose(vectors) * vectors, identity(n)) < 1e-70
        assert values == sorted(values, reverse=True)
    low = cholesky((graded + transpose(graded)) / 2)
    assert difference(low * transpose(low), (graded + transpose(graded)) / 2) < 1e-70
    wide = rng.standard_normal((3, n))
    wide[2] = 2.0 * wide[0]
    u, s, v = svd(matrix(wide))
    assert len(s) == min(2, n)
    assert difference(u * diagonal(s) * transpose(v), matrix(wide)) < 1e-70


def test_unknown_names_are_refused() -> None:
    for registry in (rules, rates):
        with pytest.raises(KeyError, match="no reference"):
            registry.load("no_such_thing")
