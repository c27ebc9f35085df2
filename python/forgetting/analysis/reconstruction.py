"""P̄ recomputed from P after the measurement, where a run did not record it.

By the inversion lemma, with c = P₊ φ̄ᵀ,

    P̄ = P₊ + c (I - φ̄ c)⁻¹ cᵀ

c and φ̄ c are sums that can cancel: in a covariance that has wound up no digit of them is right.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .validation import Array, refuse

#: Roundoff of one sum of products, in units of n · precision · the sum of magnitudes.
AMPLIFICATION = 64.0


def prior_covariance(
    phibar: Array, path: Array, precision: float
) -> tuple[Array, NDArray[np.bool_]]:
    """Return P̄_k (T, n, n), and where it is more than rounding (T,).

    Where it is not, P_k takes its place: with a proper rule P̄_k >= P_k.

    Parameters
    ----------
    phibar : (T, rows, n)
    path : (T + 1, n, n)
        P_0, ..., P_T.
    precision : float
        Unit roundoff of the numbers in `path`.
    """
    after = path[1:]
    cross = np.einsum("tij,tpj->tip", after, phibar)
    left = np.eye(phibar.shape[1]) - np.einsum("tpi,tiq->tpq", phibar, cross)
    fine = np.isfinite(left).all(axis=(1, 2))
    values, vectors = np.linalg.eigh(np.where(fine[:, None, None], left, np.eye(len(left[0]))))
    noise = AMPLIFICATION * path.shape[-1] * precision * (1 + _magnitude(phibar, after))
    short = np.flatnonzero(fine & (values[:, 0] < -noise - precision**0.5))
    if short.size:
        reason = "at most (φᵀΓ⁻¹φ)⁻¹ along φ (where a rule filters φ: see filtered_regressors)"
        raise refuse(f"covariance after sample {short[0]}", "too large", reason)
    resolved = fine & (values[:, 0] > 2 * noise)
    turned = cross @ vectors
    scaled = turned / np.where(resolved[:, None], values, 1.0)[:, np.newaxis, :]
    rebuilt = after + scaled @ np.swapaxes(turned, 1, 2)
    return np.where(resolved[:, None, None], rebuilt, path[:-1]), resolved


def roundoffs(phibar: Array, after: Array, scale: Array, spread: Array) -> Array:
    """Return the roundoffs that P̄ carries in the metric of P, (T,).

    Parameters
    ----------
    phibar : (T, rows, n)
    after : (T, n, n)
        P_{k+1}.
    scale : (T, n)
        Standard deviations of P_k.
    spread : (T,)
        Norm of the inverse root of P_k scaled to a unit diagonal.
    """
    size = np.einsum("tij,tpj->tpi", np.abs(after), np.abs(phibar))
    leverage = np.einsum("tpi,tij,tqj->tpq", phibar, after, phibar)
    left = np.linalg.eigvalsh(np.eye(phibar.shape[1]) - leverage)[:, 0]
    left = np.maximum(left, np.finfo(float).eps)
    inner = _magnitude(phibar, after) / left
    outer = np.linalg.norm(size / scale[:, np.newaxis, :], axis=(1, 2)) * spread / np.sqrt(left)
    return np.asarray(inner + 2 * outer, dtype=np.float64)


def _magnitude(phibar: Array, after: Array) -> Array:
    """Largest sum of magnitudes in φ̄ P₊ φ̄ᵀ, (T,)."""
    phi = np.abs(phibar)
    sums = np.einsum("tpi,tij,tpj->tp", phi, np.abs(after), phi)
    return np.asarray(np.nan_to_num(sums).max(axis=1), dtype=np.float64)
