"""The three algorithms of section VI over many noise realisations."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

import forgetting as fg

from ..path import Path, follow
from .system import FITTED, Array, Settings, parameters, simulate

ALGORITHMS = ("EF", "VDF-ED", "VDF-OPD")


def rule(algorithm: str, settings: Settings) -> fg.Rule:
    """The rule, with the adaptive factor (21), which may reach 1."""
    rate = fg.PredictionError(
        sensitivity=settings.sensitivity,
        smallest=settings.smallest,
        largest=1.0,
    )
    if algorithm == "EF":
        return fg.rule("exponential", forgetting_factor=rate)
    if algorithm == "VDF-ED":
        return fg.rule("variable_direction", forgetting_factor=rate, threshold=settings.threshold)
    return fg.rule("oblique_projection", forgetting_factor=rate, threshold=settings.dead_zone)


def one(algorithm: str, settings: Settings, seed: int, every: int) -> Path:
    """One noise realisation from θ̂_0 = 0.5."""
    phi, y = simulate(settings, seed)
    return follow(
        rule(algorithm, settings),
        phi,
        y,
        initial_covariance=1 / settings.information,
        initial_theta=np.full(6, 0.5),
        every=every,
    )


@lru_cache(maxsize=8)
def first(algorithm: str, settings: Settings = FITTED) -> Path:
    """The realisation that is drawn."""
    return one(algorithm, settings, seed=0, every=5)


@dataclass(frozen=True, eq=False)
class Outcome:
    """What one algorithm did over the noise realisations.

    Attributes
    ----------
    rmse : (seeds, 6)
        Root mean square error of each parameter over the record.
    smallest, condition : (seeds,)
        λ_min(R) and condition number of R at the end.
    """

    rmse: Array
    smallest: Array
    condition: Array


@lru_cache(maxsize=16)
def outcome(algorithm: str, seeds: int, settings: Settings = FITTED) -> Outcome:
    """All realisations."""
    truth = parameters(settings.samples)
    paths = [one(algorithm, settings, seed, settings.samples) for seed in range(seeds)]
    rmse = [np.sqrt(np.mean((path.theta[1:] - truth) ** 2, axis=0)) for path in paths]
    smallest = np.array([1 / path.values[-1, 0] for path in paths])
    condition = np.array([path.condition[-1] for path in paths])
    return Outcome(np.stack(rmse), smallest, condition)
