"""Information in the regressors: weighting by Γ and sums over sliding windows.

Lai and Bernstein's weighted regressor and the sum of Definition 1:

    φ̄_k = Γ_k^{-1/2} φ_k                                     (Lai and Bernstein, eq. (18))
    S_k = Σ_{i=k}^{k+N-1} φ_iᵀ Γ_i⁻¹ φ_i                     (Definition 1, eq. (1))
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .validation import Array, numbers, real, refuse, regressors

#: Windows summed at once; bounds the memory at about this many n x n matrices.
CHUNK = 8192


def weighting(gamma: ArrayLike | None, samples: int, rows: int) -> Array:
    """Return Γ as (1, rows, rows) when constant, (T, rows, rows) when not.

    Accepted: None (identity), a positive scalar, (rows, rows), (T,) for one row a
    sample, (T, rows, rows).
    """
    if gamma is None:
        return np.eye(rows)[np.newaxis]
    array = numbers("gamma", gamma)
    if array.ndim == 0:
        array = float(array) * np.eye(rows)[np.newaxis]
    elif array.shape == (rows, rows):
        array = array[np.newaxis]
    elif array.shape == (samples,) and rows == 1:
        array = array[:, np.newaxis, np.newaxis]
    if array.shape not in {(1, rows, rows), (samples, rows, rows)}:
        allowed = f"a scalar, {(rows, rows)}, {(samples, rows, rows)}"
        raise refuse("gamma", array.shape, f"{allowed}, or {(samples,)} for one row")
    return array


def weighted(phi: ArrayLike, gamma: ArrayLike | None = None) -> Array:
    """Return Γ^{-1/2} φ, shape (T, rows, n); a sample with NaN carries no information: zeros.

    Any root of Γ serves: only φᵀΓ⁻¹φ is used further on. The lower Cholesky factor is taken.
    """
    array = regressors(phi)
    missing = np.isnan(array).any(axis=(1, 2), keepdims=True)
    if missing.any():  # else there is no need of a copy
        array = np.where(missing, 0.0, array)
    if gamma is None:
        return array
    weight = weighting(gamma, array.shape[0], array.shape[1])
    try:
        root = np.linalg.cholesky(weight)
    except np.linalg.LinAlgError as error:
        raise refuse("gamma", "not positive definite", "positive-definite matrices") from error
    return whiten(root, array)


def filtered_regressors(phi: ArrayLike, threshold: float, gamma: ArrayLike | None = None) -> Array:
    """Return regressors without the singular directions that the `subspace` rule leaves out.

    With more than one row a sample the rule can leave out a part of a sample; the analysis
    then needs the regressors it used. (A sample left out entirely is known from the run.)

    Parameters
    ----------
    phi : (T, n) or (T, rows, n)
    threshold : float >= 0
        As given to the rule: the smallest singular value of Γ^{-1/2} φ it uses.
    gamma : optional
        As given to the run.

    Returns
    -------
    (T, rows, n)

    Examples
    --------
    >>> filtered_regressors([[[2.0, 0.0], [0.0, 1e-4]]], threshold=1e-3)
    array([[[2., 0.],
            [0., 0.]]])
    """
    limit = real("threshold", threshold, 0.0, float("inf"))
    left, values, right = np.linalg.svd(weighted(phi, gamma), full_matrices=False)
    kept = (left * np.where(values >= limit, values, 0.0)[:, np.newaxis, :]) @ right
    if gamma is None:
        return np.asarray(kept, dtype=np.float64)
    root = np.linalg.cholesky(weighting(gamma, kept.shape[0], kept.shape[1]))
    return np.asarray(root @ kept, dtype=np.float64)


def whiten(root: NDArray[np.floating[Any]], values: Array) -> Array:
    """Return root⁻¹ values for each sample; one root serves all samples."""
    roots = np.broadcast_to(root, (len(values), *root.shape[1:]))
    return np.asarray(np.linalg.solve(roots, values), dtype=np.float64)


def window_information(phibar: Array, window: int) -> Iterator[tuple[int, Array]]:
    """Yield (k, S_k, S_{k+1}, ...) in chunks, for each full window of `window` samples.

    Suffix sums of one block of N samples plus prefix sums of the next give every
    window without a subtraction: a sliding sum that subtracts what leaves drifts
    away from zero where there is no information, which is where it matters.
    """
    total, _, n = phibar.shape
    blocks = max(1, CHUNK // window)
    for first in range(0, total - window + 1, blocks * window):
        part = phibar[first : first + (blocks + 1) * window]
        gram = np.zeros(((blocks + 1) * window, n, n))
        gram[: len(part)] = np.einsum("tpi,tpj->tij", part, part)
        block = gram.reshape(blocks + 1, window, n, n)
        sums = np.cumsum(block[:-1, ::-1], axis=1)[:, ::-1].copy()
        sums[:, 1:] += np.cumsum(block[1:], axis=1)[:, :-1]
        yield first, sums.reshape(-1, n, n)[: total - window + 1 - first]


def trailing_information(phibar: Array, window: int) -> Iterator[tuple[int, Array]]:
    """As `window_information` for windows that end at each sample, shorter at the start."""
    lead = np.zeros((window - 1, *phibar.shape[1:]))
    return window_information(np.concatenate([lead, phibar]), window)
