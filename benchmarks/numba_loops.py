"""The covariance form in plain loops, compiled by Numba, with one scalar for the division by λ."""

from __future__ import annotations

import numpy as np
from numba import njit


@njit(fastmath=True)
def full(phi, y, factor, p0):
    """All of Q, P = s Q."""
    samples, n = phi.shape
    q, theta, h, s = p0 * np.eye(n), np.zeros(n), np.empty(n), 1.0
    for k in range(samples):
        x, leverage, error = phi[k], 0.0, y[k]
        for i in range(n):
            dot = 0.0
            for j in range(n):
                dot += q[i, j] * x[j]
            h[i] = dot
            leverage += dot * x[i]
            error -= x[i] * theta[i]
        g = s / (factor + s * leverage)
        for i in range(n):
            theta[i] += g * error * h[i]
            scaled = g * h[i]
            for j in range(n):
                q[i, j] -= scaled * h[j]
        s /= factor
    return theta


@njit(fastmath=True)
def triangle(phi, y, factor, p0):
    """The lower half of Q."""
    samples, n = phi.shape
    q, theta, h, s = p0 * np.eye(n), np.zeros(n), np.empty(n), 1.0
    for k in range(samples):
        x, leverage, error = phi[k], 0.0, y[k]
        h[:] = 0.0
        for i in range(n):
            dot = q[i, i] * x[i]
            for j in range(i):
                dot += q[i, j] * x[j]
                h[j] += q[i, j] * x[i]
            h[i] += dot
        for i in range(n):
            leverage += h[i] * x[i]
            error -= x[i] * theta[i]
        g = s / (factor + s * leverage)
        for i in range(n):
            theta[i] += g * error * h[i]
            scaled = g * h[i]
            for j in range(i + 1):
                q[i, j] -= scaled * h[j]
        s /= factor
    return theta
