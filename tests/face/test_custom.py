"""A forgetting matrix from Python: what it is given, what it may return, and what failing does."""

from __future__ import annotations

import copy
import pickle

import numpy as np
import pytest

import forgetting as fg

RNG = np.random.default_rng(5)
PHI = RNG.standard_normal((100, 3))
Y = PHI @ [1.0, -2.0, 0.5] + 0.1 * RNG.standard_normal(100)


class Failed(Exception):
    pass


def leak(information: np.ndarray, phi: np.ndarray, error: np.ndarray) -> np.ndarray:
    return 0.02 * information


def fails_later(information: np.ndarray, phi: np.ndarray, error: np.ndarray) -> np.ndarray:
    if phi[0, 0] > 1:
        raise Failed("no more")
    return 0.02 * information


def state(est: fg.RLS) -> tuple[bytes, bytes, int]:
    return est.theta.tobytes(), est.covariance.tobytes(), est.samples


@pytest.mark.parametrize("dtype", ["float64", "float32"])
def test_equals_the_rule_with_that_matrix(dtype: str) -> None:
    ours = fg.RLS(3, rule=fg.Custom(leak), dtype=dtype)
    rule = fg.RLS(3, rule=fg.Exponential(0.98), dtype=dtype)
    ours.run(PHI, Y)
    rule.run(PHI, Y)
    tolerance = 1e-11 if dtype == "float64" else 1e-3
    np.testing.assert_allclose(ours.covariance, rule.covariance, rtol=tolerance, atol=0)
    np.testing.assert_allclose(ours.theta, rule.theta, rtol=tolerance)


def test_is_given_whitened_matrices() -> None:
    seen = []

    def look(*given: np.ndarray) -> np.ndarray:
        seen.append(given)
        return np.zeros((3, 3))

    est = fg.RLS(3, rule=fg.Custom(look), rows=2, targets=4, initial_covariance=0.5)
    phi, y = RNG.standard_normal((2, 3)), RNG.standard_normal((2, 4))
    est.update(phi, y, gamma=4.0)
    information, whitened, error = seen[0]
    np.testing.assert_allclose(information, 2 * np.eye(3), rtol=1e-15)
    np.testing.assert_allclose(whitened, phi / 2, rtol=1e-15)
    np.testing.assert_allclose(error, y / 2, rtol=1e-15)


def test_an_exception_reaches_the_caller_and_changes_nothing() -> None:
    est = fg.RLS(3, rule=fg.Custom(fails_later))
    est.update([0.5, 1.0, 2.0], 1.0)
    before = state(est)
    with pytest.raises(Failed, match="no more"):
        est.update([2.0, 1.0, 2.0], 1.0)
    assert state(est) == before
    with pytest.raises(Failed, match="no more"):
        est.run(PHI, Y)
    assert state(est) == before
    est.update([0.5, 1.0, 2.0], 1.0)
    assert est.samples == 2


@pytest.mark.parametrize(
    ("result", "words"),
    [
        (lambda r, phi, e: r, "not positive definite"),
        (lambda r, phi, e: np.zeros((2, 2)), r"shape \[2, 2\]"),
        (lambda r, phi, e: 1.0, "shape"),
        (lambda r, phi, e: "a word", "forgetting_matrix"),
        (lambda r, phi, e: np.full((3, 3), np.nan), "finite"),
        (lambda r, phi, e: np.triu(np.ones((3, 3))), "symmetric"),
    ],
)
def test_what_is_not_admissible_is_refused(result: object, words: str) -> None:
    est = fg.RLS(3, rule=fg.Custom(result))
    before = state(est)
    with pytest.raises(fg.InvalidInput, match=words):
        est.update([1.0, 2.0, 3.0], 1.0)
    assert state(est) == before


def test_must_be_a_function() -> None:
    with pytest.raises(fg.InvalidInput, match="forgetting_matrix"):
        fg.RLS(3, rule=fg.Custom(5.0))
    with pytest.raises(fg.InvalidInput, match="forgetting_matrix is required"):
        fg.RLS(3, rule="custom")


def test_cannot_be_saved_but_copied() -> None:
    est = fg.RLS(3, rule=fg.Custom(leak))
    est.update([1.0, 2.0, 3.0], 1.0)
    for save in (pickle.dumps, fg.RLS.to_bytes):
        with pytest.raises(fg.InvalidInput, match="function"):
            save(est)
    other = copy.copy(est)
    assert state(other) == state(est)
    other.update([1.0, 0.0, 0.0], 1.0)
    assert state(other) != state(est)
    assert est.rule.parameters["forgetting_matrix"] is leak


def test_works_between_resets() -> None:
    rule = fg.CovarianceResetting(rule=fg.Custom(leak), period=1_000)
    est = fg.RLS(3, rule=rule)
    est.run(PHI, Y)
    alone = fg.RLS(3, rule=fg.Custom(leak))
    alone.run(PHI, Y)
    np.testing.assert_allclose(est.covariance, alone.covariance, rtol=1e-12)
