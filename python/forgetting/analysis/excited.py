"""What the last samples tell: how many directions, and which parameters, all along a record.

Information is counted in units of the record's own, so that units of the regressors do not matter:
with M the mean of φ̄ᵀφ̄ over the record and S_k that over the last N samples,

    M^{-1/2} S_k M^{-1/2} = Σ μ v vᵀ             μ = 1: as much as the record on the average

    v is excited where μ >= share; parameter i is told of where the directions that are not excited
    bring no more than a tenth of what the whole record leaves open, (M⁻¹)_ii = Σ (M^{-1/2} v)_i².
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .information import weighted
from .validation import Array, real, whole

#: Directions of the scaled regressors below this share of the largest are rounding.
NOTHING = 1e-12
#: Part of a parameter's (M⁻¹)_ii that directions may bring without its belonging to them.
PART = 0.1


@dataclass(frozen=True, eq=False)
class Excited:
    """What the last samples tell, all along a record. See `excited`.

    Attributes
    ----------
    samples : (K,) int
        Samples that were looked at.
    rank : (K,) int
        Directions that the N samples up to each excite.
    told : (K, n) bool
        Parameters that they tell of.
    window : int
        N.
    share : float
    """

    samples: NDArray[np.int64]
    rank: NDArray[np.int64]
    told: NDArray[np.bool_] = field(repr=False)
    window: int
    share: float

    @property
    def parameters(self) -> int:
        """n."""
        return int(self.told.shape[1])

    @property
    def everything(self) -> float:
        """Part of the record in which all directions are excited."""
        return float((self.rank == self.parameters).mean())

    def longest_silence(self) -> tuple[int, int]:
        """Return the first sample and the length of the longest stretch without full excitation."""
        lacking = np.concatenate([[0], self.rank < self.parameters, [0]]).astype(np.int8)
        starts, stops = np.flatnonzero(np.diff(lacking) > 0), np.flatnonzero(np.diff(lacking) < 0)
        if not starts.size:
            return 0, 0
        ends = np.append(self.samples, self.samples[-1] + 1)
        lengths = ends[stops] - self.samples[starts]
        worst = int(lengths.argmax())
        return int(self.samples[starts[worst]]), int(lengths[worst])

    def to_dict(self) -> dict[str, Any]:
        """Return the scalars, ready for JSON."""
        first, length = self.longest_silence()
        return {
            "window": self.window,
            "share": self.share,
            "everything": self.everything,
            "longest_silence": {"sample": first, "samples": length},
            "told": self.told.mean(axis=0).tolist(),
        }


def excited(
    regressors: ArrayLike,
    window: int,
    gamma: ArrayLike | None = None,
    share: float = 0.01,
    most: int = 1000,
) -> Excited:
    """Say along a record what the last N samples tell.

    Parameters
    ----------
    regressors : (T, n) or (T, rows, n)
        A sample with NaN counts as no information.
    window : int in [1, T]
        N; at the start of the record as many as there are.
    gamma : optional
        Measurement weighting Γ.
    share : float in (0, 1]
        Part of the record's mean information that a direction must receive to be excited.
    most : int >= 1
        Samples looked at, evenly spread; the last is one of them.

    Returns
    -------
    Excited
        O(K N n² rows + K n³) for K samples.

    Examples
    --------
    >>> import numpy as np
    >>> phi = np.ones((100, 2))
    >>> phi[::2, 1] *= -1
    >>> phi[50:, 1] = 0.0  # the second regressor falls silent
    >>> found = excited(phi, window=10)
    >>> found.rank[[40, 58, 59, 99]].tolist(), found.told[99].tolist()
    ([2, 2, 1, 1], [True, False])
    >>> found.everything, found.longest_silence()
    (0.58, (59, 41))
    """
    phibar = weighted(regressors, gamma)
    samples, _, n = phibar.shape
    window = whole("window", window, 1, samples)
    share = real("share", share, 0.0, 1.0, open_low=True)
    step = -(-samples // whole("most", most, 1))
    chosen = np.arange(samples - 1, -1, -step)[::-1]
    root, never = _root(phibar)
    whole_record = np.square(root).sum(axis=1)
    turned = phibar @ root
    rank = np.empty(len(chosen), dtype=np.int64)
    told = np.empty((len(chosen), n), dtype=bool)
    for place, k in enumerate(chosen):
        part = turned[max(0, k - window + 1) : k + 1]
        values, vectors = np.linalg.eigh(np.einsum("tpi,tpj->ij", part, part) / window)
        silent = values < share
        rank[place] = np.count_nonzero(~silent)
        told[place] = np.square(root @ vectors[:, silent]).sum(axis=1) <= PART * whole_record
    return Excited(chosen, rank, told & ~never, window, share)


def _root(phibar: Array) -> tuple[Array, NDArray[np.bool_]]:
    """M^{-1/2} (n, r) on the r directions that the record excites, and what is in the others."""
    size = np.sqrt(np.einsum("tpi,tpi->i", phibar, phibar) / len(phibar))
    scale = 1 / np.where(size > 0, size, 1.0)
    mean = np.einsum("tpi,tpj->ij", phibar, phibar) / len(phibar)
    values, vectors = np.linalg.eigh(mean * scale[:, np.newaxis] * scale)
    known = values > NOTHING * max(float(values[-1]), 1.0)
    never = np.square(vectors[:, ~known]).sum(axis=1) > PART
    return scale[:, np.newaxis] * vectors[:, known] / np.sqrt(values[known]), never
