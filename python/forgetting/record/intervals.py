"""Intervals about the one-step predictions of a record, in two readings, and what they held.

Mean square: normal quantiles times the root of the noise variance so far and, of a rule, of
1 + leverage. Conformal: `forgetting.Intervals`, which suppose nothing of the errors.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

import forgetting as fg
from forgetting.prediction import quantile
from forgetting.record.judge import settled
from forgetting.record.trace import Trace
from forgetting.record.uncertainty import noise_variance

Array = NDArray[np.float64]


@dataclass(frozen=True)
class OneStep:
    """The intervals of a run at one level.

    Parameters
    ----------
    trace : Trace
    level : float
        Between 0 and 1.
    """

    trace: Trace
    level: float

    @cached_property
    def mean_square(self) -> Array:
        """Half-widths by the noise variance, known before each sample, (T, m)."""
        trace = without_swollen(self.trace)
        noise = np.full_like(trace.error, np.nan)
        noise[1:] = noise_variance(trace)[:-1]
        return np.asarray(quantile(self.level) * np.sqrt(noise * (1.0 + trace.leverage[:, None])))

    @cached_property
    def conformal(self) -> Array:
        """Half-widths that follow the errors, known before each sample, (T, m)."""
        errors, skip = self.trace.error, 3 * self.trace.theta.shape[1]
        made = [fg.Intervals(self.level, skip=skip).run(each) for each in errors.T]
        return np.column_stack(made)

    def coverage(self, half_width: Array) -> list[float]:
        """Share of the errors of each output inside, of samples used after the start."""
        error = self.trace.error
        known = settled(self.trace)[:, None] & np.isfinite(half_width) & np.isfinite(error)
        inside = known & (np.abs(error) <= half_width)
        with np.errstate(invalid="ignore"):
            return list(map(float, inside.sum(axis=0) / known.sum(axis=0)))

    def by_output(self, outputs: tuple[str, ...]) -> dict[str, dict[str, float]]:
        """What both held of each output, and their last half-widths."""
        held = zip(self.coverage(self.mean_square), self.coverage(self.conformal), strict=True)
        return {
            output: {
                "mean_square": mean_square,
                "conformal": conformal,
                "mean_square_half_width": float(self.mean_square[-1, j]),
                "conformal_half_width": float(self.conformal[-1, j]),
            }
            for j, (output, (mean_square, conformal)) in enumerate(zip(outputs, held, strict=True))
        }

    def describe(self, outputs: tuple[str, ...]) -> list[str]:
        """A sentence for each output."""
        return [
            f"Of the one-step errors of {output} {held['conformal']:.1%} are within the "
            f"{self.level:.4g} interval that follows them, {held['mean_square']:.1%} within that "
            "of the noise variance."
            for output, held in self.by_output(outputs).items()
        ]

    def to_dict(self, outputs: tuple[str, ...]) -> dict[str, Any]:
        """Ready for JSON."""
        return {"level": self.level, "coverage": self.by_output(outputs)}

    def columns(self, prediction: Array, output: int, rows: slice) -> dict[str, Any]:
        """The conformal interval about the predictions of some rows, (K,)."""
        half_width = self.conformal[rows, output]
        return {"lower": prediction - half_width, "upper": prediction + half_width}


def without_swollen(trace: Trace) -> Trace:
    """The trace, of a bank without its leverage: P of members that do not count swells it."""
    if trace.weights is None:
        return trace
    return replace(trace, leverage=np.zeros_like(trace.leverage))
