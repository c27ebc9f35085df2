"""A fleet and as many single estimators, fed the same samples."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

import forgetting as fg

CODES = {word: code for code, word in fg.SKIPPED.items()}


@dataclass
class Samples:
    """phi (T, count, n), y and mask (T, count)."""

    phi: np.ndarray
    y: np.ndarray
    mask: np.ndarray


def samples(length: int, count: int, n: int, dtype: str = "float64", seed: int = 0) -> Samples:
    """Streams that are excited, silent and excited along one direction in turn, each with
    samples that are masked, missing, infinite and too large here and there."""
    random = np.random.default_rng(seed)
    phi = random.normal(size=(length, count, n))
    third = length // 3
    phi[third : 2 * third, ::2] = 0.0
    phi[2 * third :, 1::2] = np.linspace(1.0, -0.5, n)
    theta = random.normal(size=(count, n))
    y = np.einsum("tcn,cn->tc", phi, theta) + 0.1 * random.normal(size=(length, count))
    chance = random.uniform(size=(length, count))
    y[chance < 0.02] = np.nan
    y[(chance > 0.02) & (chance < 0.03)] = np.inf
    phi[(chance > 0.03) & (chance < 0.04), -1] = np.nan
    phi[(chance > 0.04) & (chance < 0.05), 0] = -np.inf
    phi[(chance > 0.05) & (chance < 0.06), 0] = 1e200 if dtype == "float64" else 1e30
    return Samples(phi.astype(dtype), y.astype(dtype), random.uniform(size=(length, count)) < 0.9)


def take(est: fg.RLS, phi: np.ndarray, y: float, there: bool) -> tuple[float, float, int]:
    """What a fleet is to tell of the sample: error, leverage and code."""
    if not there or np.isnan(phi).any() or np.isnan(y):
        return np.nan, np.nan, CODES["missing"]
    try:
        update = est.update(phi, y)
    except (fg.InvalidInput, fg.NumericalRange):
        return np.nan, np.nan, CODES["refused"]
    return update.error, update.leverage, CODES[update.skipped]


def assert_follows(fleet: fg.Fleet, singles: list[fg.RLS], given: Samples) -> set[int]:
    """That the fleet does what the singles do, bit for bit; returns the codes that came up."""
    seen: set[int] = set()
    for phi, y, mask in zip(given.phi, given.y, given.mask, strict=True):
        update = fleet.update(phi, y, mask=mask, outputs=["error", "leverage", "skipped"])
        told = [take(*each) for each in zip(singles, phi, y, mask, strict=True)]
        error, leverage, code = (np.array(part) for part in zip(*told, strict=True))
        np.testing.assert_array_equal(update.skipped, code)
        np.testing.assert_array_equal(update.error, error)
        np.testing.assert_array_equal(update.leverage, leverage)
        assert update.used == (code == 0).sum()
        seen |= set(code.tolist())
    assert_same(fleet, singles)
    return seen


def assert_same(fleet: fg.Fleet, singles: list[fg.RLS]) -> None:
    """That every stream is the single, configuration and state, bit for bit."""
    assert len(fleet) == len(singles)
    for i, single in enumerate(singles):
        assert fleet[i].to_bytes() == single.to_bytes(), i
    np.testing.assert_array_equal(fleet.theta, [single.theta for single in singles])
    np.testing.assert_array_equal(fleet.samples, [single.samples for single in singles])
    variance = np.array([np.diag(single.covariance) for single in singles])
    np.testing.assert_array_equal(fleet.variance, variance)
