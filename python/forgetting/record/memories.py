"""How fast the parameters change: over how many samples the members of a bank that fitted remember.

A member i remembers n/h_i samples, h_i the part that a sample decides of its own fit (the mean of
s/(1 + s), s the leverage). The weights say which memory predicted best, and when.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

import forgetting as fg
from forgetting.record.moved import Moved, as_run
from forgetting.record.trace import USED, Trace
from forgetting.words.duration import spoken
from forgetting.words.rounding import brief

Array = NDArray[np.float64]

MOST = 200_000
"""Rows at the end of the record by which the memory of a member is measured."""
SETTLED = 0.1
"""Part of the record at its begin in which weights are not yet settled."""
WHOLE = 0.25
"""A memory of more than this part of the record is as good as one of all of it."""
VARIES = 4.0
"""Times that the memory must differ within a record to be said to change."""


@dataclass(frozen=True)
class Memories:
    """Which memory fitted when.

    Attributes
    ----------
    samples : ndarray, shape (members,)
        Memory of each member, in samples, the longest first.
    rows : ndarray, shape (K,)
        Rows at which the weights are known.
    weights : ndarray, shape (K, members)
        How far each member is believed, on average since the row before; a row adds up to 1.
    total : int
        Samples used.
    step : float or None
        Seconds from sample to sample, typically; None without a clock.
    """

    samples: Array
    rows: NDArray[np.int64]
    weights: Array
    total: int
    step: float | None

    @property
    def typical(self) -> Array:
        """The memory in the middle of the weights, in samples, (K,)."""
        return np.array([middle(self.samples, row, 0.5) for row in self.weights])

    def quartiles(self) -> tuple[float, float, float]:
        """Memories between which the middle half of the weight lies, and its middle."""
        settled = self.weights[int(SETTLED * len(self.weights)) :].mean(axis=0)
        first, second, third = (middle(self.samples, settled, part) for part in (0.25, 0.5, 0.75))
        return first, second, third

    def describe(self) -> str:
        """How fast the parameters change, in a sentence or two."""
        low, typical, high = self.quartiles()
        if typical > WHOLE * self.total:
            return (
                f"The parameters hardly change: the longest memories predict best, and all "
                f"{self.total} samples{self._in_time(self.total)} tell of them."
            )
        text = (
            f"The parameters change within about {self._span(typical)}: memories from "
            f"{brief(low, 2)} to {self._span(high)} predict best."
        )
        settled = self.typical[int(SETTLED * len(self.rows)) :]
        least, most = np.percentile(settled, (10, 90))
        if most > VARIES * least:
            text += f" In the course of the record from {self._span(least)} to {self._span(most)}."
        return text

    def to_dict(self) -> dict[str, Any]:
        """Ready for JSON."""
        found = dict(zip(("quarter", "half", "three_quarters"), self.quartiles(), strict=True))
        seconds = None
        if self.step is not None:
            seconds = {name: value * self.step for name, value in found.items()}
        return {"samples": found, "seconds": seconds, "in_words": self.describe()}

    def _span(self, samples: float) -> str:
        return f"{brief(samples, 2)} samples{self._in_time(samples)}"

    def _in_time(self, samples: float) -> str:
        return "" if self.step is None else f" ({spoken(samples * self.step)})"


def middle(memories: Array, weights: Array, part: float) -> float:
    """The memory below which a part of the weight lies, drawn straight on a logarithmic axis.

    Examples
    --------
    >>> round(middle(np.array([100.0, 10.0, 1.0]), np.array([0.25, 0.5, 0.25]), 0.5), 1)
    10.0
    """
    order = np.argsort(memories)
    held = weights[order] / weights.sum()
    centres = np.cumsum(held) - held / 2
    return float(np.exp(np.interp(part, centres, np.log(memories[order]))))


def memories(
    samples: Moved, trace: Trace, members: list[Any], settings: dict[str, Any]
) -> Memories | None:
    """What the weights of a bank say; None for the run of a rule.

    Parameters
    ----------
    samples, trace
        What was run, and how it went.
    members : list of Rule
        Of the bank.
    settings : dict
        Of the estimators: targets, initial_covariance and dtype.
    """
    if trace.weights_path is None:
        return None
    part = samples.last(MOST)
    lengths = np.array([length(part, rule, settings) for rule in members])
    used = int((trace.skipped == USED).sum())
    return Memories(lengths, trace.rows, trace.weights_path, used, samples.samples.usual_step)


def length(samples: Moved, rule: Any, settings: dict[str, Any]) -> float:
    """Over how many samples a rule remembers at the end."""
    estimator = fg.RLS(samples.parameters, rule=rule, **settings)
    phi, y = as_run(*samples.rows(slice(None)), settings["dtype"])
    try:
        found = estimator.run(phi, y, outputs=("leverage", "skipped"), missing="skip")
    except fg.NumericalRange:
        return 1.0
    leverage = np.asarray(found.leverage, dtype=np.float64)[found.skipped == USED]
    leverage = leverage[-max(len(leverage) // 4, 1) :]
    own = float(np.mean(leverage / (1 + leverage))) if len(leverage) else 1.0
    return samples.parameters / max(own, 1e-300)


def memory(trace: Trace) -> float:
    """Samples that the estimate stands on at the end; infinite if nothing is forgotten.

    Of a bank its own figure. Of a rule n over the part h = s/(1 + s) that a sample decides of its
    own fit, on average over the last quarter of the samples used, s being the leverage.
    """
    if trace.memory is not None:
        return float(trace.memory[-1])
    used = trace.skipped == USED
    if (trace.forgetting_factor[used] == 1).all() and not np.any(
        trace.variance[-1] > trace.variance.min(axis=0)
    ):
        return float("inf")
    leverage = trace.leverage[used]
    leverage = leverage[-max(len(leverage) // 4, 1) :]
    own = float(np.mean(leverage / (1 + leverage))) if len(leverage) else 0.0
    return trace.theta.shape[1] / own if own > 0 else float("inf")
