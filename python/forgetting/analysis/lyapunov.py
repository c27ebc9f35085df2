"""The Lyapunov function V_k = θ̃_kᵀ P_k⁻¹ θ̃_k and its decrease.

Guaranteed over a persistently exciting window of N samples (Lai and Bernstein, eq. (125)):

    c_N = (α/N) (1 + bβ)⁻¹ [1 + (N-1)/2 (bβ)²]⁻¹,    V_k - V_{k+N} >= c_N ‖θ̃_k‖²

and seen in the record, the smallest eigenvalue of eq. (115):

    Δ^N V_k = P_k⁻¹ - M_kᵀ ... M_{k+N-1}ᵀ P_{k+N}⁻¹ M_{k+N-1} ... M_k,   M_k = P_{k+1} P̄_k⁻¹
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from .trajectory import Trajectory
from .validation import Array, numbers, real, refuse, stack, whole

PIECE = 4096
"""Samples whose decrease is found at a time."""


def lyapunov_decrease(alpha: float, beta: float, b: float, window: int) -> float:
    """Return c_N, the decrease of V per squared error that the theory guarantees.

    Parameters
    ----------
    alpha : float > 0
        Least information of any window of `window` samples, 1/θ².
    beta : float > 0
        Most information of one sample, 1/θ².
    b : float > 0
        Upper bound of P̄, θ².
    window : int >= 1
        N, the number of samples in a window.

    Returns
    -------
    float
        c_N, 1/θ²; 0 when `b` is infinite.

    Notes
    -----
    Source: Lai and Bernstein, Lemma 8, eq. (125).

    Examples
    --------
    >>> lyapunov_decrease(alpha=2.0, beta=1.0, b=1.0, window=2)
    0.3333333333333333
    """
    alpha = real("alpha", alpha, 0.0, math.inf, open_low=True)
    beta = real("beta", beta, 0.0, math.inf, open_low=True)
    b = real("b", b, 0.0, math.inf, open_low=True)
    window = whole("window", window, 1)
    gain = b * beta
    return alpha / window / (1 + gain) / (1 + (window - 1) / 2 * gain**2)


def observed_decrease(trajectory: Trajectory, window: int) -> Array:
    """Return the smallest eigenvalue of Δ^N V_k for each start k, (T - window + 1,), 1/θ².

    Never under c_N when the conditions hold; usually far above. O(T window n³).
    """
    window = whole("window", window, 1, trajectory.samples)
    starts = trajectory.samples - window + 1
    # some at a time: eight matrices of each are there at once
    parts = [range(first, min(first + PIECE, starts)) for first in range(0, starts, PIECE)]
    return np.concatenate([_decrease(trajectory, window, part) for part in parts])


def _decrease(trajectory: Trajectory, window: int, starts: range) -> Array:
    """The smallest eigenvalue of Δ^N V_k for some k, (len(starts),)."""
    root = np.linalg.cholesky(trajectory.before[starts.start : starts.stop])
    # In the coordinates x = C z with P_k = C Cᵀ every product stays of order one.
    moved = root
    for step in range(window):
        rows = slice(starts.start + step, starts.stop + step)
        phibar = trajectory.phibar[rows]
        gain = np.einsum("tij,tpj->tip", trajectory.after[rows], phibar)
        moved = moved - gain @ (phibar @ moved)
    last = np.linalg.cholesky(
        trajectory.after[starts.start + window - 1 : starts.stop + window - 1]
    )
    kept = np.linalg.solve(last, moved)
    share = np.eye(trajectory.parameters) - np.swapaxes(kept, 1, 2) @ kept
    back = np.linalg.solve(root, np.broadcast_to(np.eye(trajectory.parameters), root.shape))
    least: Array = np.linalg.eigvalsh(np.swapaxes(back, 1, 2) @ share @ back)[:, 0]
    return least


def lyapunov(error: ArrayLike, covariance: ArrayLike) -> Array:
    """Return V_k = θ̃ᵀP⁻¹θ̃ for each sample, (T,), without units.

    Parameters
    ----------
    error : (T, n)
        θ̃_k = θ_k - θ.
    covariance : (T, n, n)
        P_k at the same instants.

    Notes
    -----
    Without noise and with a proper rule V never rises (Lai and Bernstein, eq. (112)).

    Examples
    --------
    >>> lyapunov([[2.0]], [[[0.5]]])
    array([8.])
    """
    values = numbers("error", error)
    if values.ndim != 2:
        raise refuse("error", values.shape, "shape (T, n)")
    matrices = stack("covariance", covariance, *values.shape)
    solved = np.linalg.solve(matrices, values[:, :, np.newaxis])[:, :, 0]
    return np.asarray(np.einsum("ti,ti->t", values, solved), dtype=np.float64)
