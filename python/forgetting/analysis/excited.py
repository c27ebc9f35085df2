"""How many directions the last samples excite, and which parameters, all along a record.

Information is counted in units of the record's own, so that units of the regressors do not matter:
with M the mean of φ̄ᵀφ̄ over the record and S_k that over the last N samples,

    M^{-1/2} S_k M^{-1/2} = Σ μ v vᵀ             μ = 1: as much as the record on the average

    v is excited where μ >= share; parameter i is informed where the directions that are not excited
    make up no more than a tenth of its variance over the record, (M⁻¹)_ii = Σ (M^{-1/2} v)_i².
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .information import weighted
from .validation import Array, real, whole

#: Sums of φ̄ᵀφ̄ over samples, (n, n), by the first sample and the one behind the last.
Information = Callable[[int, int], Array]
#: Directions of the scaled regressors below this share of the largest are rounding.
ROUNDING = 1e-12
#: A parameter counts as informed while the unexcited directions make up no more than this share
#: of its (M⁻¹)_ii.
UNEXCITED_SHARE = 0.1
#: Numbers of sums whose eigenvectors are computed by one call.
TOGETHER = 20_000


@dataclass(frozen=True, eq=False)
class Excited:
    """What the last samples excite, all along a record. See `excited`.

    Attributes
    ----------
    samples : (K,) int
        Samples that were looked at.
    rank : (K,) int
        Directions that the N samples up to each excite.
    informed : (K, n) bool
        Parameters that they inform about.
    window : int
        N.
    share : float
        Part of the record's mean information from which on a direction counts as excited.
    """

    samples: NDArray[np.int64]
    rank: NDArray[np.int64]
    informed: NDArray[np.bool_] = field(repr=False)
    window: int
    share: float

    @property
    def parameters(self) -> int:
        """Number n of parameters."""
        return int(self.informed.shape[1])

    @property
    def fully_excited(self) -> float:
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
            "fully_excited": self.fully_excited,
            "longest_silence": {"sample": first, "samples": length},
            "informed": self.informed.mean(axis=0).tolist(),
        }


def excited(
    regressors: ArrayLike,
    window: int,
    gamma: ArrayLike | None = None,
    share: float = 0.01,
    most: int = 1000,
) -> Excited:
    """Find along a record what the last N samples excite.

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
        O(T n² rows + K n³) for K samples of T, N of which are at most T/4.

    Examples
    --------
    >>> import numpy as np
    >>> phi = np.ones((100, 2))
    >>> phi[::2, 1] *= -1
    >>> phi[50:, 1] = 0.0  # the second regressor falls silent
    >>> found = excited(phi, window=10)
    >>> found.rank[[40, 58, 59, 99]].tolist(), found.informed[99].tolist()
    ([2, 2, 1, 1], [True, False])
    >>> found.fully_excited, found.longest_silence()
    (0.58, (59, 41))
    """
    phibar = weighted(regressors, gamma)
    return excited_by(
        lambda start, stop: _gram(phibar[start:stop]), len(phibar), window, share, most
    )


def excited_by(
    information: Information, samples: int, window: int, share: float = 0.01, most: int = 1000
) -> Excited:
    """As `excited`, for a record that is only known by its information.

    Parameters
    ----------
    information : callable
        Σ φ̄ᵀφ̄, (n, n), of the samples from its first argument up to, without, its second.
    samples : int
        T.
    window, share, most
        See `excited`.
    """
    window = whole("window", window, 1, samples)
    share = real("share", share, 0.0, 1.0, open_low=True)
    step = -(-samples // whole("most", most, 1))
    chosen = np.arange(samples - 1, -1, -step)[::-1]
    root, never = _root(information(0, samples) / samples)
    whole_record = np.square(root).sum(axis=1)
    trailing = _Trailing(information, chosen, window)
    rank = np.empty(len(chosen), dtype=np.int64)
    informed = np.ones((len(chosen), len(root)), dtype=bool)
    many = max(1, TOGETHER // len(root) ** 2)
    for start in range(0, len(chosen), many):
        places = range(start, min(start + many, len(chosen)))
        parts = np.array([trailing.sum(place, chosen[place]) for place in places])
        values, vectors = np.linalg.eigh(root.T @ parts @ root / window)
        silent = values < share
        rank[start : places.stop] = np.count_nonzero(~silent, axis=1)
        for i in np.flatnonzero(silent.any(axis=1)):
            unexcited = np.square(root @ vectors[i][:, silent[i]]).sum(axis=1)
            informed[start + i] = unexcited <= UNEXCITED_SHARE * whole_record
    return Excited(chosen, rank, informed & ~never, window, share)


class _Trailing:
    """Sums of φᵀφ over the last N samples up to those chosen, which are evenly spaced.

    Stretches between the chosen samples are summed once; a window is whole stretches and a rest.
    """

    def __init__(self, information: Information, chosen: NDArray[np.int64], window: int) -> None:
        self.information, self.window = information, window
        edges = np.concatenate([[0], chosen + 1])
        short = window <= (edges[-1] - edges[-2])
        pairs = [] if short else pairwise(edges)
        self.stretches = np.array([information(start, stop) for start, stop in pairs])
        self.starts = edges[:-1]

    def sum(self, place: int, sample: int) -> Array:
        """Over the window that ends with `sample`, the chosen one at `place`."""
        first = max(0, sample - self.window + 1)
        if not len(self.stretches):
            return self.information(first, sample + 1)
        whole = int(np.searchsorted(self.starts, first))
        if whole > place:  # the window begins within the last stretch
            return self.information(first, sample + 1)
        rest = self.information(first, self.starts[whole])
        return np.asarray(rest + self.stretches[whole : place + 1].sum(axis=0))


def _gram(part: Array) -> Array:
    """Σ φᵀφ."""
    rows = part.reshape(-1, part.shape[2])
    return np.asarray(rows.T @ rows)


def _root(mean: Array) -> tuple[Array, NDArray[np.bool_]]:
    """M^{-1/2} (n, r) on the r directions ever excited, and the parameters outside them (n,)."""
    size = np.sqrt(np.diagonal(mean))
    scale = 1 / np.where(size > 0, size, 1.0)
    values, vectors = np.linalg.eigh(mean * scale[:, np.newaxis] * scale)
    known = values > ROUNDING * max(float(values[-1]), 1.0)
    never = np.square(vectors[:, ~known]).sum(axis=1) > UNEXCITED_SHARE
    return scale[:, np.newaxis] * vectors[:, known] / np.sqrt(values[known]), never
