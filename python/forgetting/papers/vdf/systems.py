"""Signals, systems and regressors of the tutorial's examples.

Every system starts at rest: u and y are zero for k < 0.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]

NUMERATOR = (0.68, -0.16, -0.12, -0.18, 0.09)
"""Coefficients of u(k-1) ... u(k-5) in the 5th-order system (34)."""
DENOMINATOR = (1.0, -0.41, 0.17, 0.03, -0.01)
"""Coefficients of y(k-1) ... y(k-5) in (34), moved to the right-hand side."""


def three_sinusoids(samples: int) -> Array:
    """The periodic signal (27), (samples,)."""
    k = np.arange(samples)
    periods = (17, 23, 53)
    return np.asarray(sum(np.sin(2 * np.pi * k / period) for period in periods))


def delayed(signal: Array, delays: Sequence[int]) -> Array:
    """Columns signal(k - d), one a delay; zero before the start."""
    padded = np.concatenate([np.zeros(max(delays)), signal])
    start = max(delays)
    return np.stack([padded[start - d : start - d + len(signal)] for d in delays], axis=1)


def response(numerator: Sequence[float], denominator: Sequence[float], u: Array) -> Array:
    """Output y(k) = Σ b_i u(k-i) + Σ a_i y(k-i), i from 1, of a strictly proper system."""
    b, a = np.asarray(numerator), np.asarray(denominator)
    drive = delayed(u, range(1, len(b) + 1)) @ b
    y = np.zeros(len(u) + len(a))
    for k, value in enumerate(drive):
        y[k + len(a)] = value + a @ y[k : k + len(a)][::-1]
    return y[len(a) :]


def two_lags(u: Array) -> Array:
    """φ_k = [u_k, u_{k-1}] of Examples 2 and 3."""
    return delayed(u, (0, 1))


def first_order(u: Array) -> tuple[Array, Array, Array]:
    """φ, y and θ of Example 4, y = 0.8/(q - 0.4) u."""
    y = response([0.8], [0.4], u)
    phi = np.hstack([delayed(y, [1]), delayed(u, [1])])
    return phi, y, np.array([0.4, 0.8])


def fifth_order(samples: int) -> tuple[Array, Array, Array]:
    """φ (35), y and θ of the system (34) driven by (27): Examples 5 and 9 to 12."""
    u = three_sinusoids(samples)
    y = response(NUMERATOR, DENOMINATOR, u)
    lags = range(1, 6)
    phi = np.hstack([delayed(u, lags), delayed(y, lags)])
    return phi, y, np.array([*NUMERATOR, *DENOMINATOR])


def finite_response(samples: int, seed: int = 0) -> tuple[Array, Array, Array]:
    """φ, y and θ of Example 6, a 3rd-order FIR system driven by white noise."""
    u = np.random.default_rng(seed).standard_normal(samples)
    phi, theta = delayed(u, (1, 2, 3)), np.array([1.0, 0.8, 0.5])
    return phi, phi @ theta, theta


def constrained(samples: int) -> tuple[Array, Array, Array]:
    """φ, y and θ of Example 8: every regressor along [1, 1]."""
    wave = np.sin(2 * np.pi * np.arange(samples) / 100)
    phi, theta = wave[:, np.newaxis] * np.ones(2), np.array([0.4, 1.4])
    return phi, phi @ theta, theta
