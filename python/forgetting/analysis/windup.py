"""Windup: P grows along directions that receive no information.

    A direction has wound up when its variance is more than ten times what it was when it
    last received information, it receives none now, and the rule sets it no bound.

"Receives information" is measured against what P claims: with S the information of the
last `window` samples and x a direction scaled to one standard deviation (P = Σ x xᵀ), the
share μ = xᵀ S x is the squared change of the predictions in the window, in noise variances, when
the parameters move by x. μ < `share` is no information. The pairs (μ, x) are the
eigenpairs of S in the metric of P, so none of this depends on the units of the parameters.

The reference B is, along each direction, the variance when it was last informed. With x_E
the informed directions, x_Z the silent ones, y their functionals (yᵢᵀxⱼ = 1 if i = j, else
0) and P' the covariance after the first sample of the window,

    G = y_Zᵀ B y_Z,   growth = 1/λ_min(G)
    B <- x_E min(y_Eᵀ P' y_E, I) x_Eᵀ + x_Z min(G, I) x_Zᵀ

where min(·, I) clips eigenvalues at 1: the reference never exceeds the present variance.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .ceiling import ceiling_of
from .direction import describe_direction
from .information import trailing_information
from .root import square_root
from .trajectory import Trajectory, trajectory_of
from .validation import Array, positive_matrix, real, refuse, whole

DEFINITION = (
    "A direction has wound up when its variance is more than {factor:g} times what it was when it "
    "last received information, it receives none now, and the rule sets it no bound."
)
#: At most about this many samples are examined, unless the window asks for more.
EXAMINED = 4000


@dataclass(frozen=True, eq=False)
class Windup:
    """Windup over a record. See `windup`.

    Attributes
    ----------
    occurred : bool
    sample : int or None
        First examined sample with windup.
    persists : bool
        True when it is there at the last sample.
    growth : float
        Largest growth of the variance of a silent direction (1: none).
    direction : (n,) or None
        Unit vector that has wound up most.
    informed : int or None
        Last sample that informed about that direction; None if none did.
    samples : (E,) int
        Samples examined.
    path : (E,)
        Largest growth of a silent direction at each (ceiling counted).
    window, factor, share
        As used.
    """

    occurred: bool
    sample: int | None
    persists: bool
    growth: float
    direction: Array | None
    informed: int | None
    samples: NDArray[np.int64] = field(repr=False)
    path: Array = field(repr=False)
    window: int
    factor: float
    share: float

    def describe(self, names: Sequence[str] | None = None) -> str:
        """Say what happened in a sentence."""
        if not self.occurred or self.direction is None:
            return f"No windup: no silent direction of P grew by more than {self.factor:g}."
        where = describe_direction(self.direction, names)
        since = "none ever came" if self.informed is None else f"sample {self.informed}"
        end = "it is there at the end" if self.persists else "it is gone at the end"
        return (
            f"Windup from sample {self.sample}: along {where} the variance is up to "
            f"{self.growth:.3g} times what it was at the last information ({since}); {end}."
        )

    def to_dict(self) -> dict[str, Any]:
        """Return the scalars and the direction, ready for JSON."""
        return {
            "occurred": self.occurred,
            "sample": self.sample,
            "persists": self.persists,
            "growth": self.growth if np.isfinite(self.growth) else None,
            "direction": None if self.direction is None else self.direction.tolist(),
            "last_informed": self.informed,
            "window": self.window,
            "factor": self.factor,
            "share": self.share,
            "definition": DEFINITION.format(factor=self.factor),
        }


def windup(
    run: Any,
    regressors: ArrayLike | None = None,
    *,
    gamma: ArrayLike | None = None,
    initial_covariance: ArrayLike | None = None,
    window: int | None = None,
    factor: float = 10.0,
    share: float = 0.01,
    ceiling: ArrayLike | None = None,
    rule: Any = None,
    stride: int | None = None,
) -> Windup:
    """Look for windup all along a record.

    Parameters
    ----------
    run : Run or Trajectory
        A Run needs ``outputs=(..., "covariance")``.
    regressors, gamma, initial_covariance : optional
        As given to the run.
    window : int >= 1, optional
        Samples over which information is summed. Default: the memory 1/(1-λ) of the run
        where it is known, at least 2 n, at most a quarter of the record.
    factor : float > 1
        Growth of the variance that is windup.
    share : float in (0, 1]
        A direction is informed where its μ in the window is at least this.
    ceiling : scalar, (n,) or (n, n), optional
        The bound that the rule sets, such as the covariance a resetting rule returns to;
        growth up to it is not windup.
    rule : Rule, optional
        The rule of the run, to take the ceiling from.
    stride : int >= 1, optional
        Examine every `stride`-th sample. Default: at most about 4000 samples, never more
        than half a window apart.

    Returns
    -------
    Windup

    Examples
    --------
    >>> import numpy as np
    >>> from forgetting.analysis import Trajectory
    >>> variance = np.concatenate([np.ones(60), 0.9 ** -np.arange(41.0)])
    >>> phi = np.repeat([[0.5], [0.0]], [60, 40], axis=0)
    >>> found = windup(Trajectory.from_arrays(phi, variance[:, None, None]), window=5)
    >>> found.occurred, found.sample, found.informed
    (True, 81, 59)
    """
    trajectory = trajectory_of(run, regressors, gamma, initial_covariance)
    window = _memory(trajectory) if window is None else whole("window", window, 1)
    factor = real("factor", factor, 1.0, float("inf"), open_low=True)
    share = real("share", share, 0.0, 1.0, open_low=True)
    top = None if rule is None else ceiling_of(rule, trajectory.parameters)
    if ceiling is not None:
        top = positive_matrix("ceiling", ceiling, trajectory.parameters)
    spacing = max(1, min(window // 2, trajectory.samples // EXAMINED))
    if stride is not None:
        spacing = whole("stride", stride, 1)
    chosen = np.arange(_finite(trajectory) - 1, -1, -spacing)[::-1]
    path, directions = _follow(trajectory, chosen, window, share, top)
    return _summary(trajectory, chosen, path, directions, window, factor, share)


def _memory(trajectory: Trajectory) -> int:
    """The memory of the run in samples, within reason."""
    longest = max(2 * trajectory.parameters, trajectory.samples // 4)
    rate = trajectory.forgetting_factor
    if rate is None or not np.isfinite(rate).any():
        return min(longest, 20 * trajectory.parameters)
    forgotten = 1.0 - float(np.nanmedian(rate))
    return int(np.clip(np.ceil(1 / max(forgotten, 1e-9)), 2 * trajectory.parameters, longest))


def _finite(trajectory: Trajectory) -> int:
    """Number of samples before the first covariance that is not finite."""
    fine = np.isfinite(trajectory.before) & np.isfinite(trajectory.after)
    lost = np.flatnonzero(~fine.all(axis=(1, 2)))
    if lost.size and lost[0] == 0:
        raise refuse("covariance", "not finite from the first sample", "finite numbers")
    return int(lost[0]) if lost.size else trajectory.samples


def _follow(
    trajectory: Trajectory, chosen: NDArray[np.int64], window: int, share: float, top: Array | None
) -> tuple[Array, Array]:
    """Carry the reference B along the record; return growth and its direction."""
    mu, moves, reads = _shares(trajectory, chosen, window)
    path = np.ones(len(chosen))
    directions = np.zeros((len(chosen), trajectory.parameters))
    reference = trajectory.before[0]
    for step, (shares, x, y) in enumerate(zip(mu, moves, reads, strict=True)):
        silent = shares < share
        start = int(chosen[step]) - window + 1
        recent = trajectory.after[start] if start >= 0 else trajectory.before[0]
        fresh, turn = _clipped(y[~silent] @ recent @ y[~silent].T)
        informed = x[:, ~silent] @ turn
        held, turn = _clipped(y[silent] @ reference @ y[silent].T)
        spread, readings = x[:, silent] @ turn, turn.T @ y[silent]
        for value, move, reading in zip(held, spread.T, readings, strict=True):
            if 1 / value > path[step] and _above(reading, top):
                path[step], directions[step] = 1 / value, move
        reference = (informed * fresh) @ informed.T + (spread * held) @ spread.T
    return path, directions


def _above(reading: Array, top: Array | None) -> bool:
    """True when the variance of a reading, 1 in the metric of P, is above the ceiling."""
    if top is None:
        return True
    return bool(np.isfinite(top).all() and reading @ top @ reading < 1 - 1e-6)


def _clipped(matrix: Array) -> tuple[Array, Array]:
    """Eigenvalues in (0, 1] and eigenvectors of a reference in the metric of P."""
    values, vectors = np.linalg.eigh(matrix)
    return np.clip(values, np.finfo(float).tiny, 1.0), vectors


def _shares(
    trajectory: Trajectory, chosen: NDArray[np.int64], window: int
) -> tuple[Array, Array, Array]:
    """Eigenpairs of the window's information in the metric of P: μ, x (columns), y (rows)."""
    parts = []
    for first, sums in trailing_information(trajectory.phibar, window):
        inside = chosen[(chosen >= first) & (chosen < first + len(sums))]
        parts.append(sums[inside - first])
    root, inverse = square_root(trajectory.after[chosen], trajectory.precision)
    mu, turn = np.linalg.eigh(np.swapaxes(root, 1, 2) @ np.concatenate(parts) @ root)
    return mu, root @ turn, np.swapaxes(turn, 1, 2) @ inverse


def _summary(
    trajectory: Trajectory,
    chosen: NDArray[np.int64],
    path: Array,
    directions: Array,
    window: int,
    factor: float,
    share: float,
) -> Windup:
    found = path > factor
    worst = int(path.argmax())
    samples = chosen + trajectory.first
    if not found.any():
        growth = float(path[worst])
        return Windup(False, None, False, growth, None, None, samples, path, window, factor, share)
    x = directions[worst]
    informative = np.linalg.norm(trajectory.phibar[: chosen[worst] + 1] @ x, axis=1) ** 2 >= share
    informed = (
        trajectory.first + int(np.flatnonzero(informative)[-1]) if informative.any() else None
    )
    return Windup(
        True,
        int(samples[found.argmax()]),
        bool(found[-1]),
        float(path[worst]),
        x / np.linalg.norm(x),
        informed,
        samples,
        path,
        window,
        factor,
        share,
    )
