"""Models for the tests, and their difference equations written out."""

from __future__ import annotations

import numpy as np

import forgetting as fg
from forgetting.polynomials import Structure

ARX = {"A": [1, -1.5, 0.7], "B": [1.0, 0.5], "delay": 1}
ARMAX = {**ARX, "C": [1, 0.4, 0.2], "offset": 0.3}
OE = {"B": [[0.5, 0.1], [1.0]], "F": [[1, -0.8], [1, -0.2, 0.5]], "delay": [2, 0]}
BJ = {**OE, "C": [1, 0.5], "D": [1, -0.9], "offset": -1.0}
ALL = {**BJ, "A": [1, -0.5, 0.3]}
STATIC = {"B": [2.0], "delay": 0}
NOISE_ONLY = {"A": [1, -0.6], "C": [1, 0.3]}
SYSTEMS = {
    "ARX": ARX,
    "ARMAX": ARMAX,
    "OE": OE,
    "BJ": BJ,
    "all": ALL,
    "static": STATIC,
    "ARMA": NOISE_ONLY,
}


def model(name: str, **settings) -> fg.PolynomialModel:
    return fg.PolynomialModel(**SYSTEMS[name], **settings)


def structure(name: str) -> Structure:
    return model(name).structure


def signals(found: fg.PolynomialModel, samples: int, seed: int = 0, noise: float = 0.3):
    """Inputs (T, m), white noise (T,) and the output (T,) of a system at rest before."""
    random = np.random.default_rng(seed)
    u = random.normal(size=(samples, found.structure.inputs))
    e = noise * random.normal(size=samples)
    return u, e, outputs(found, u, e)


def outputs(found, u, e, known=None):
    """y by the difference equations one after the other, of a system at rest before.

    `known` (T,) are outputs that are measured: there, e is what they say, and returned beside y.
    """
    y, errors = np.zeros(len(u)), np.array(e, dtype=float)
    w, v = np.zeros(u.shape), np.zeros(len(u))
    offset = found.offset or 0.0
    rest = offset / found.A.sum()
    past = lambda x, k, lag: x[k - lag] if k >= lag else 0.0  # noqa: E731
    for k in range(len(u)):
        for i in range(u.shape[1]):
            for lag, b in enumerate(found.B[i]):
                w[k, i] += b * past(u[:, i], k, lag)
            for lag, f in enumerate(found.F[i][1:], 1):
                w[k, i] -= f * past(w[:, i], k, lag)
        expected = w[k].sum() + offset
        for lag, a in enumerate(found.A[1:], 1):
            expected -= a * (y[k - lag] if k >= lag else rest)
        for lag, c in enumerate(found.C[1:], 1):
            expected += c * past(errors, k, lag)
        for lag, d in enumerate(found.D[1:], 1):
            expected -= d * past(v, k, lag)
        if known is not None and not np.isnan(known[k]):
            errors[k] = known[k] - expected
        y[k] = expected + errors[k]
        v[k] = y[k] - offset - w[k].sum()
        for lag, a in enumerate(found.A[1:], 1):
            v[k] += a * (y[k - lag] if k >= lag else rest)
    return y if known is None else (y, errors)


def random_covariance(size: int, scale: float, seed: int = 1):
    """A covariance with correlations."""
    root = scale * np.random.default_rng(seed).normal(size=(size, size)) / np.sqrt(size)
    return root @ root.T
