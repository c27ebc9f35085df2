"""Every registry line equals Theorem 1 with its F, its published form and the minimiser of (4).

The references are dense, in 77 digits, and share nothing with the package (tests/reference).
"""

from __future__ import annotations

import zlib

import numpy as np
import pytest

import forgetting as fg
from reference import rates, rules
from reference.signals import KINDS, record
from reference.weighting import CASES as WEIGHTING_CASES

from . import product
from .follow import Gap, Setting, follow

# Largest difference in units of eps cond(P), over theta, P, the one-step errors and the factor.
# Measured over four rules, n in {1, 2, 4, 8}, p in {1, 2, 3}, five kinds of input, 500 samples:
# 26 (f64) and 16 (f32), but 178 for `none` on nearly collinear input, where the rounding errors of
# 500 samples add up because nothing is forgotten.
AMPLIFICATION = 300.0
# ... and relative, where P is well conditioned (cond(P) < WELL at every checkpoint): measured
# 2e-12 (theta on nearly collinear input, cond(P) = 4e4; 6e-14 on the others) and 1e-5.
RELATIVE = {"float64": 1e-11, "float32": 1e-4}
WELL = 1e5

SAMPLES = 500
SHORT = 150


def lines(registry: object, table: dict[str, object], cases: object) -> list[object]:
    """(name, index of the parameter set), one for each registry line and reference set.

    A line without a reference keeps one entry, so that it fails instead of going untested.
    """
    found = []
    for name in table:
        count = len(cases(registry, name)) if name in registry.NAMES else 1
        found += [pytest.param(name, i, id=f"{name}-{i}") for i in range(count)]
    return found


RULE_LINES = lines(rules, product.RULES, lambda registry, name: registry.load(name).cases(8))
RATE_LINES = lines(rates, product.RATES, lambda registry, name: registry.load(name).CASES)


def shapes(index: int) -> list[tuple[str, int, int]]:
    """(kind, n, p): every n with every kind and every p for the first set, a few for the others."""
    kinds = list(KINDS)
    if index > 0:
        return [("exciting", 2, 2), ("silent", 4, 1), ("fixed", 4, 2), ("deficient", 4, 3),
                ("collinear", 2, 1), ("exciting", 8, 2)]  # fmt: skip
    small = [(kind, n, 1 + (i + n) % 3) for n in (1, 2, 4) for i, kind in enumerate(kinds)]
    return [*small, ("fixed", 8, 1), ("deficient", 8, 2), ("exciting", 8, 3)]


def assert_close(gap: Gap, dtype: str, what: object) -> None:
    assert max(gap.scaled.values()) < AMPLIFICATION, (what, gap)
    if gap.condition < WELL:
        assert max(gap.relative.values()) < RELATIVE[dtype], (what, gap)


def case_for(name: str, index: int, n: int) -> dict[str, object] | None:
    """The reference's parameter set, or None where this n has fewer sets."""
    cases = rules.load(name).cases(n)
    return cases[index] if index < len(cases) else None


@pytest.mark.parametrize(("name", "index"), RULE_LINES)
def test_rule_equals_its_references(name: str, index: int) -> None:
    """f64, also with a full Gamma for every sample (p > 1) and several targets."""
    for i, (kind, n, wanted) in enumerate(shapes(index)):
        case, p = case_for(name, index, n), product.rows(name, wanted)
        if case is None:
            continue
        samples = SAMPLES if index == 0 else SHORT
        data = record(kind, samples, p, n, targets=1 + i % 3, weighted=p > 1, seed=index)
        assert_close(follow(Setting(name, case), data), "float64", (kind, n, p, case))


@pytest.mark.parametrize("name", product.RULES)
def test_rule_in_single_precision(name: str) -> None:
    for i, kind in enumerate(("exciting", "silent", "fixed", "deficient")):
        n, p = (2, 4, 8, 4)[i], product.rows(name, (1, 2, 1, 3)[i])
        data = record(kind, SHORT, p, n, targets=1 + i % 2, weighted=p > 1, seed=7)
        setting = Setting(name, case_for(name, 0, n), dtype="float32")
        assert_close(follow(setting, data), "float32", (kind, n, p))


# rules that add to every variance, which among many parameters is done where a sample needs it
ADDING = ("component", "constant_trace", "random_walk", "stabilised")


@pytest.mark.parametrize("dtype", ["float64", "float32"])
@pytest.mark.parametrize("name", ADDING)
def test_what_is_added_to_many_parameters(name: str, dtype: str) -> None:
    # nearly collinear input costs more digits than single precision has to spare
    for i, kind in enumerate(list(KINDS)[: 4 if dtype == "float32" else 5]):
        n, p = 11 + i, 1 + i % 3
        data = record(kind, SHORT, p, n, targets=1 + i % 2, weighted=p > 1, seed=i)
        for case in rules.load(name).cases(n):
            assert_close(follow(Setting(name, case, dtype=dtype), data), dtype, (kind, n, p, case))


@pytest.mark.parametrize("name", ADDING)
def test_what_is_added_to_many_parameters_as_rates_and_weightings_see_it(name: str) -> None:
    data, case = record("exciting", 60, 2, 11, 2, weighted=True, seed=3), case_for(name, 0, 11)
    data.y[40:44] += 30.0
    for rate in set(product.RATES) & {"fortescue", "noise_power", "exact_gradient", "gradient"}:
        setting = Setting(name, case, rate=(rate, rates.load(rate).CASES[0]))
        assert_close(follow(setting, data), "float64", rate)
    for weighting, (first, *_) in WEIGHTING_CASES.items():
        setting = Setting(name, case, weighting=(weighting, first))
        assert_close(follow(setting, data), "float64", weighting)


@pytest.mark.parametrize(("name", "index"), RATE_LINES)
def test_rate_equals_its_reference(name: str, index: int) -> None:
    """The factors themselves, and the estimates of two rules that use them."""
    case = rates.load(name).CASES[index]
    for rule in ("exponential", "subspace"):
        values = case_for(rule, 0, 3)
        for kind, p, targets in (("exciting", 2, 2), ("silent", 1, 1), ("deficient", 3, 1)):
            data = record(kind, SHORT, p, 3, targets, weighted=p > 1, seed=index)
            gap = follow(Setting(rule, values, rate=(name, case)), data)
            assert_close(gap, "float64", (rule, kind, case))


@pytest.mark.parametrize("name", product.WEIGHTINGS)
def test_weighting_equals_its_reference(name: str) -> None:
    """Alone, and with a rate, which must see the clipped error."""
    for case in WEIGHTING_CASES[name]:
        for rate in ("constant", "prediction_error"):
            if rate not in product.RATES:
                continue
            data = record("exciting", SHORT, 2, 3, 2, weighted=True, seed=5)
            data.y[100:105] += 30.0
            used = (rate, rates.load(rate).CASES[0])
            setting = Setting("subspace", {"threshold": 1e-3}, rate=used, weighting=(name, case))
            assert_close(follow(setting, data), "float64", (case, rate))


def test_every_line_has_a_reference() -> None:
    assert set(product.RULES) <= set(rules.NAMES)
    assert set(product.RATES) <= set(rates.NAMES)
    assert set(product.WEIGHTINGS) <= set(WEIGHTING_CASES)


def test_gamma_in_every_form_is_the_same_gamma() -> None:
    """One number or one matrix for all samples, or one of either for each."""
    data = record("exciting", 30, 2, 3, seed=8)
    matrix = np.array([[2.0, 0.5], [0.5, 1.0]])
    one, phi, y = 0.37, data.phi, data.y[..., 0]

    def final(rows: int, gamma: object) -> np.ndarray:
        est = fg.RLS(3, rule=fg.rule("subspace", forgetting_factor=0.9), rows=rows)
        est.run(phi if rows > 1 else phi[:, 0], y if rows > 1 else y[:, 0], gamma=gamma)
        return np.append(est.theta, est.covariance)

    assert (final(2, matrix) == final(2, np.tile(matrix, (30, 1, 1)))).all()
    assert (final(1, one) == final(1, np.full(30, one))).all()
    assert final(2, one) == pytest.approx(final(2, one * np.eye(2)), rel=1e-12)


@pytest.mark.parametrize("name", product.RULES)
def test_targets_are_separate_estimates(name: str) -> None:
    """theta's columns are the estimates of one target each (for rules that ignore the error)."""
    case = case_for(name, 0, 3)
    if name == "data_dependent" or case.get("criterion") == "change":
        pytest.skip("its weight or its criterion looks at the errors of all targets")
    p = product.rows(name, 2)
    data = record("fixed", 60, p, 3, targets=3, weighted=True, seed=zlib.crc32(name.encode()))

    def final(y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        est = fg.RLS(3, rule=product.rule(name, case, 0.98), rows=p, targets=y.shape[2])
        product.feed(est, data.phi, y, data.gamma)
        return np.reshape(est.theta, (3, -1)), est.covariance

    together, covariance = final(data.y)
    for target in range(3):
        alone, same = final(data.y[:, :, target : target + 1])
        assert (together[:, target] == alone[:, 0]).all()
        assert (covariance == same).all()
