"""The record on which every rule, rate, weighting, gate and mixer is shown.

Two parameters that drift, and two inputs: for a while the second is silent, then both are, then
both return. All numbers are in units of the noise, which has variance 1.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

SAMPLES = 1000
ONE_SILENT, BOTH_SILENT = slice(300, 500), slice(500, 700)
"""Samples in which the second input is 0, and in which both are."""
GROSS, SIZE = 0.04, 20.0
"""Share of gross errors, where there are any, and their size in standard deviations."""


@dataclass(frozen=True)
class Record:
    """A record with its truth.

    Attributes
    ----------
    phi : ndarray, shape (T, 2)
        The inputs.
    y : ndarray, shape (T,)
        What was measured: phi @ theta and noise of variance 1.
    theta : ndarray, shape (T, 2)
        The parameters that made it.
    """

    phi: Array
    y: Array
    theta: Array


def record(gross: bool = False) -> Record:
    """Make the record, the same every time; with gross errors in some samples if asked for."""
    random = np.random.default_rng(12)
    k = np.arange(SAMPLES)
    phi = random.normal(size=(SAMPLES, 2))
    phi[ONE_SILENT, 1] = 0.0
    phi[BOTH_SILENT] = 0.0
    theta = np.column_stack([20 + 3 * np.sin(k / 100), 5 + 5 * k / SAMPLES])
    noise = random.normal(size=SAMPLES)
    hit = random.random(SAMPLES) < (GROSS if gross else 0.0)
    noise += np.where(hit, SIZE * random.choice([-1.0, 1.0], SAMPLES), 0.0)
    return Record(phi, (phi * theta).sum(axis=1) + noise, theta)
