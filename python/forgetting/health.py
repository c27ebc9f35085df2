"""How far an estimate can be trusted now: what `RLS.health` returns."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from ._core import RLS
from .judgement import Judgement
from .judgement.covariance import LASTING, involved, strong
from .judgement.live import live

Status = Literal["ok", "unexcited", "recovering", "windup", "saturated"]

#: Beyond these bounds on D the covariance is at the edge of its number type.
EDGE = {"float64": 2.0**490, "float32": 2.0**55}


@dataclass(frozen=True, eq=False)
class Health:
    """What is known of P, of the excitation and of the noise.

    Without a monitor (``RLS(..., monitor=True)``) all but the eigenvalues is None.

    Attributes
    ----------
    status : {"ok", "unexcited", "recovering", "windup", "saturated"}
        "saturated": P is at the edge of its number type. "windup": the weakest direction has
        grown to more than ten times its variance when it was last informed, and is not informed
        now. "unexcited": it is not informed now, or some parameter was not excited in the last
        two blocks. "recovering": it is informed again, but its variance is still more than a
        thousand times what it was.
    largest_eigenvalue, smallest_eigenvalue : float
        Of P. Exact if `exact`; else the largest and smallest element of D: the largest
        eigenvalue is at least that, the smallest at most that.
    condition : float
        Their ratio: the condition number of P if `exact`, else a lower bound of it.
    exact : bool
    windup, informed : bool or None
        Of the weakest direction: the one with the largest variance, in units of the smallest
        variance that each parameter has had so far.
    direction : (n,) ndarray or None
        The weakest direction, a unit vector.
    parts : (n,) ndarray or None
        The same in those units: how far each parameter belongs to it.
    variance, growth : float or None
        Its variance in P, and how many times that is what it was when it was last informed: 1
        while it is informed, unless the variance is still more than a thousand times that.
    since_informed : int or None
        Samples since then, to within one block of max(10, 2n, half the memory) samples.
    since_excited : (n,) ndarray of int or None
        Samples since each parameter's regressor was last large enough to inform about it.
    noise_variance : float or None
        Running estimate of the variance of the whitened noise, weighted as the rule forgets.
    correlation : float or None
        Lag-one correlation of the normalized innovations; near 0 if the model is right.
    white : bool or None
        Whether it is within two standard deviations of 0.
    samples : int or None
        Samples watched.
    weight : float or None
        Samples behind `noise_variance` and `correlation`, weighted as the rule forgets.
    """

    status: Status
    largest_eigenvalue: float
    smallest_eigenvalue: float
    condition: float
    exact: bool
    windup: bool | None = None
    informed: bool | None = None
    direction: NDArray[np.floating[Any]] | None = None
    parts: NDArray[np.floating[Any]] | None = None
    variance: float | None = None
    growth: float | None = None
    since_informed: int | None = None
    since_excited: NDArray[np.int64] | None = None
    noise_variance: float | None = None
    correlation: float | None = None
    white: bool | None = None
    samples: int | None = None
    weight: float | None = None

    def judgement(self, names: Sequence[str] | None = None) -> Judgement:
        """What speaks for and against the estimate now, and what to do first.

        Examples
        --------
        >>> import forgetting as fg
        >>> est = fg.RLS(1, rule=fg.Exponential(0.9), monitor=True)
        >>> for k in range(200):
        ...     u = est.update([0.0], 3.0)
        >>> est.health().judgement()["windup"].severity
        'wrong'
        """
        return live(self.status, self.describe(names), self.correlation, self.weight or 0.0)

    def describe(self, names: Sequence[str] | None = None) -> str:
        """Say it in a sentence, with the parameters' names if they are given.

        Examples
        --------
        >>> import forgetting as fg
        >>> est = fg.RLS(2, rule=fg.Exponential(0.9), monitor=True)
        >>> for k in range(200):
        ...     u = est.update([1.0, 0.0], 3.0)
        >>> print(est.health().describe(["offset", "slope"]))
        windup: nothing has informed slope for 200 samples
        """
        if self.parts is None or self.status in ("ok", "saturated"):
            return self.status
        label = names or [f"parameter {i}" for i in range(len(self.parts))]
        if self.status == "recovering":
            along = involved(self.parts, label)
            return (
                f"recovering: {along} is informed again, but its variance is still "
                f"{self.growth:.3g} times what it was before"
            )
        silence = self.since_excited if self.since_excited is not None else np.zeros(0)
        if self.informed:  # so it is a parameter that is silent
            along, samples = label[int(silence.argmax())], int(silence.max())
        else:
            along = involved(self.parts, label)
            samples = max(self.since_informed or 0, int(silence[strong(self.parts)].min()))
        return f"{self.status}: nothing has informed {along} for {samples} samples"


def health_of(estimator: RLS, exact: bool = False) -> Health:
    """The health of `estimator`; see `RLS.health`."""
    largest, smallest = estimator._extremes()
    edge = EDGE[estimator.dtype]
    saturated = largest > edge or smallest < 1 / edge
    if exact:
        unit, diagonal = (np.asarray(part, dtype=float) for part in estimator.factor())
        values = np.linalg.svd(unit * np.sqrt(diagonal), compute_uv=False) ** 2
        largest, smallest = float(values[0]), float(values[-1])
    eigenvalues = (largest, smallest, largest / smallest)
    watched = estimator.watched()
    if watched is None:
        return Health("saturated" if saturated else "ok", *eigenvalues, exact)
    weight, block = watched["weight"], watched.pop("block")
    parts = watched["direction"] / np.sqrt(watched.pop("least_variances"))
    watched["parts"] = parts / np.linalg.norm(parts)
    # the correlation of independent innovations has the variance 1/weight
    white = bool(abs(watched["correlation"]) <= 2 / math.sqrt(weight)) if weight > 1 else None
    return Health(_status(watched, saturated, block), *eigenvalues, exact, white=white, **watched)


def _status(watched: dict[str, Any], saturated: bool, block: float) -> Status:
    if saturated:
        return "saturated"
    if watched["windup"]:
        return "windup"
    silent = watched["since_excited"].max() >= 2 * block
    if silent or not watched["informed"]:
        return "unexcited"
    return "recovering" if watched["growth"] > LASTING else "ok"
