"""Persistent excitation of a record of regressors (Definition 1 of both papers).

Lai and Bernstein sum N samples, φ_k ... φ_{k+N-1}, and bound one φᵀφ from above by β.
Goel, Bruce and Bernstein sum N + 1 samples, φ_j ... φ_{j+N}, and bound the whole window
by β. A window of w samples is therefore N = w in the first and N = w - 1 in the second;
α is the same number in both.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from .direction import oriented
from .information import weighted, window_information
from .spectrum import Spectrum, spectrum
from .validation import Array, real, whole

#: A window informs about a direction above this share of the largest information found.
RELATIVE_THRESHOLD = 1e-10


class Persistency(NamedTuple):
    """Constants of Definition 1 in one paper's convention."""

    alpha: float
    beta: float
    window: int


@dataclass(frozen=True, eq=False)
class Excitation:
    """What the regressors excite. See `excitation`.

    Attributes
    ----------
    window : int
        Samples summed.
    smallest, largest : (T - window + 1,)
        Extreme eigenvalues of the information of each window, row k for the window
        that starts at sample k. Units 1/θ².
    rank : (T - window + 1,) int
        Directions above the threshold in each window.
    sample_bound : float
        Largest eigenvalue of one φᵀΓ⁻¹φ.
    threshold : float
        Information under which a direction counts as not excited.
    first_failure : int or None
        Start of the first window that leaves a direction unexcited.
    directions : (n, n)
        Orthonormal directions (columns), most informed first, of the whole record.
    total : (n,)
        Information of the whole record along each direction.
    content : (T, n)
        ‖φ̄_k u_i‖: content of sample k along each direction (the norm of col_i(ψ_k),
        Goel et al. eq. (55), here along fixed directions; `information_content` has
        the moving ones).
    phibar : (T, rows, n)
        The weighted regressors.
    """

    window: int
    samples: int
    smallest: Array = field(repr=False)
    largest: Array = field(repr=False)
    rank: np.ndarray[Any, np.dtype[np.int64]] = field(repr=False)
    sample_bound: float
    threshold: float
    first_failure: int | None
    directions: Array = field(repr=False)
    total: Array = field(repr=False)
    content: Array = field(repr=False)
    phibar: Array = field(repr=False)

    @cached_property
    def spectrum(self) -> Spectrum:
        """Power of each regressor over frequency; needs SciPy."""
        return spectrum(self.phibar)

    @property
    def alpha(self) -> float:
        """Smallest information of any window along any direction."""
        return float(self.smallest.min())

    @property
    def beta(self) -> float:
        """Largest information of any window along any direction."""
        return float(self.largest.max())

    @property
    def persistent(self) -> bool:
        """True when every window of the record excites every direction."""
        return self.first_failure is None

    @property
    def generalized(self) -> Persistency:
        """(α, β, N) of Lai and Bernstein: N terms, β for one sample."""
        return Persistency(self.alpha, self.sample_bound, self.window)

    @property
    def tutorial(self) -> Persistency:
        """(α, β, N) of Goel, Bruce and Bernstein: N + 1 terms, β for the window."""
        return Persistency(self.alpha, self.beta, self.window - 1)

    @property
    def rich(self) -> int:
        """Number of directions the whole record informs about (mean over its windows)."""
        mean = self.total * self.window / self.samples
        return int(np.count_nonzero(mean > self.threshold))

    @property
    def rich_subspace(self) -> Array:
        """Basis (n, r) of the directions the record informs about (eqs. (56)-(58))."""
        return self.directions[:, : self.rich]

    @property
    def silent_subspace(self) -> Array:
        """Basis (n, n - r) of the directions the record does not inform about."""
        return self.directions[:, self.rich :]

    def to_dict(self) -> dict[str, Any]:
        """Return the scalars, ready for JSON."""
        return {
            "window": self.window,
            "persistent": self.persistent,
            "first_failure": self.first_failure,
            "threshold": self.threshold,
            "generalized": self.generalized._asdict(),
            "tutorial": self.tutorial._asdict(),
            "rich_directions": self.rich,
            "silent_directions": self.silent_subspace.T.tolist(),
        }


def excitation(
    regressors: ArrayLike,
    window: int,
    gamma: ArrayLike | None = None,
    threshold: float | None = None,
) -> Excitation:
    """Find α, β and the excited directions over every window of a record.

    Parameters
    ----------
    regressors : (T, n) or (T, rows, n)
        A sample with NaN counts as no information.
    window : int in [1, T]
        Samples in a window. Fewer than n / rows never excite every direction.
    gamma : scalar, (rows, rows), (T,) or (T, rows, rows), optional
        Measurement weighting Γ; the information is then φᵀΓ⁻¹φ.
    threshold : float > 0, optional
        Information (units 1/θ²) a window must hold along a direction to excite it.
        Default: 1e-10 of the largest found, which only excludes rounding; pass the
        noise floor of the regressors, squared and times `window`, where it is known.

    Returns
    -------
    Excitation

    Raises
    ------
    InvalidInput
        A wrong shape, an infinite regressor, Γ not positive definite.

    Notes
    -----
    Source: Definition 1 of Lai and Bernstein (arXiv 2308.04259, eqs. (1), (2)) and of Goel,
    Bruce and Bernstein (arXiv 2003.03523, eqs. (18), (19)). O(T n³).

    Examples
    --------
    >>> import numpy as np
    >>> found = excitation(np.tile(np.eye(2), (5, 1)), window=4)
    >>> found.generalized, found.tutorial
    (Persistency(alpha=2.0, beta=1.0, window=4), Persistency(alpha=2.0, beta=2.0, window=3))
    >>> excitation([[1.0, 1.0]] * 5, window=4).silent_subspace.round(3).T.tolist()
    [[0.707, -0.707]]
    """
    phibar = weighted(regressors, gamma)
    samples = phibar.shape[0]
    window = whole("window", window, 1, samples)
    values = window_eigenvalues(phibar, window)
    threshold = _threshold(threshold, float(values.max()))
    total, directions = np.linalg.eigh(np.einsum("tpi,tpj->ij", phibar, phibar))
    directions = oriented(directions[:, ::-1])
    return Excitation(
        window=window,
        samples=samples,
        smallest=values[:, 0],
        largest=values[:, -1],
        rank=np.count_nonzero(values > threshold, axis=1),
        sample_bound=sample_bound(phibar),
        threshold=threshold,
        first_failure=first_failure(values[:, 0], threshold),
        directions=directions,
        total=np.maximum(total[::-1], 0.0),
        content=np.linalg.norm(phibar @ directions, axis=1),
        phibar=phibar,
    )


def window_eigenvalues(phibar: Array, window: int) -> Array:
    """Return the eigenvalues (T - window + 1, n), ascending, of each window's information."""
    parts = [np.linalg.eigvalsh(sums) for _, sums in window_information(phibar, window)]
    return np.maximum(np.concatenate(parts), 0.0)


def sample_bound(phibar: Array) -> float:
    """Return β of eq. (2): the largest squared singular value of one regressor."""
    return float(np.linalg.norm(phibar, ord=2, axis=(1, 2)).max() ** 2)


def first_failure(smallest: Array, threshold: float) -> int | None:
    """Return the first window whose smallest eigenvalue is not above the threshold."""
    failing = np.flatnonzero(~(smallest > threshold))
    return int(failing[0]) if failing.size else None


def persistency_window(
    regressors: ArrayLike, gamma: ArrayLike | None = None, threshold: float | None = None
) -> int | None:
    """Return the shortest window that excites every direction wherever it stands, or None.

    Searched up to half the record, so that the record holds two windows that share no
    sample. α never falls as the window grows (a longer window contains a shorter one), so
    bisection finds it. Parameters as in `excitation`.

    Examples
    --------
    >>> import numpy as np
    >>> persistency_window(np.tile(np.eye(3), (4, 1)))
    3
    >>> persistency_window([[1.0, 1.0]] * 8) is None
    True
    """
    phibar = weighted(regressors, gamma)
    samples, rows, n = phibar.shape
    low: int = math.ceil(n / rows)
    high: int = samples // 2
    if threshold is None and high > 0:
        threshold = RELATIVE_THRESHOLD * float(window_eigenvalues(phibar, high).max())
    limit = _threshold(threshold, 0.0)

    def exciting(window: int) -> bool:
        chunks = (np.linalg.eigvalsh(sums) for _, sums in window_information(phibar, window))
        return all(bool((values[:, 0] > limit).all()) for values in chunks)

    if high < low or not exciting(high):
        return None
    step = low
    while step < high and not exciting(step):  # double from below: short windows fail at once
        low, step = step + 1, 2 * step
    high = min(step, high)
    while low < high:
        middle = (low + high) // 2
        low, high = (low, middle) if exciting(middle) else (middle + 1, high)
    return low


def _threshold(threshold: float | None, largest: float) -> float:
    if threshold is None:
        return RELATIVE_THRESHOLD * largest
    return real("threshold", threshold, 0.0, float("inf"))
