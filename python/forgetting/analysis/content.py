"""Information content along the moving eigen-directions of P (Goel et al., eqs. (54)-(63)).

    P_k⁻¹ = U_k Σ_k U_kᵀ,   ψ_k = φ_k U_k,   content_i = ‖col_i(ψ_k)‖

The information-rich subspace at step k is spanned by the columns u_i of U_k with content;
along the others P_{k+1}⁻¹ is what forgetting leaves of P_k⁻¹, nothing more (eq. (63)).
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .information import weighted
from .validation import Array, real, stack


@dataclass(frozen=True, eq=False)
class Content:
    """Information content of each sample. See `information_content`.

    Attributes
    ----------
    directions : (T, n, n)
        U_k, columns ordered from most to least informed.
    information : (T, n)
        Eigenvalues of P_k⁻¹ in that order.
    content : (T, n)
        ‖col_i(ψ_k)‖.
    rich : (T, n) bool
        Columns in the information-rich subspace.
    threshold : float
    """

    directions: Array = field(repr=False)
    information: Array = field(repr=False)
    content: Array = field(repr=False)
    rich: NDArray[np.bool_] = field(repr=False)
    threshold: float

    @property
    def rank(self) -> NDArray[np.int64]:
        """Dimension (T,) of the information-rich subspace at each sample."""
        return np.asarray(self.rich.sum(axis=1), dtype=np.int64)

    def subspace(self, sample: int) -> Array:
        """Return a basis (n, r) of the information-rich subspace at `sample`."""
        basis: Array = self.directions[sample][:, self.rich[sample]]
        return basis

    def to_dict(self) -> dict[str, Any]:
        """Return the scalars, ready for JSON."""
        counts = np.bincount(self.rank, minlength=self.content.shape[1] + 1)
        return {"threshold": self.threshold, "samples_with_rank": counts.tolist()}


def information_content(
    regressors: ArrayLike,
    covariance: ArrayLike,
    gamma: ArrayLike | None = None,
    threshold: float | None = None,
) -> Content:
    """Project each regressor on the eigen-directions of the covariance at that sample.

    Parameters
    ----------
    regressors : (T, n) or (T, rows, n)
    covariance : (T, n, n)
        P_k before each sample.
    gamma : optional
        Measurement weighting Γ.
    threshold : float >= 0, optional
        Content (units 1/θ) above which a direction is in the information-rich subspace;
        ε of eq. (67). Default: 1e-5 of the largest content in the record.

    Returns
    -------
    Content

    Notes
    -----
    Where eigenvalues of P_k coincide (P_0 = c I) the directions are not unique and neither
    is the subspace; it is defined as the smallest spanned by the columns of the U_k at hand.

    Examples
    --------
    >>> import numpy as np
    >>> P = np.tile(np.diag([1.0, 4.0]), (3, 1, 1))
    >>> information_content([[2.0, 0.0], [0.0, 3.0], [1.0, 1.0]], P).rank.tolist()
    [1, 1, 2]
    """
    phibar = weighted(regressors, gamma)
    samples, _, n = phibar.shape
    variance, directions = np.linalg.eigh(stack("covariance", covariance, samples, n))
    content = np.linalg.norm(phibar @ directions, axis=1)
    if threshold is None:
        threshold = 1e-5 * float(content.max())
    threshold = real("threshold", threshold, 0.0, float("inf"))
    with np.errstate(divide="ignore"):
        information = 1.0 / np.maximum(variance, 0.0)
    return Content(directions, information, content, content > threshold, threshold)
