"""One-step scores: the model beside two baselines, on the same samples."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from forgetting.record.samples import Samples
from forgetting.tuning.baseline import last_measured, rms

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Scores:
    """Root mean square one-step errors per output, in the unit of the output.

    Attributes
    ----------
    model : tuple of float
        The identified model, predicting before it learns.
    last_value : tuple of float
        Predicting that the output stays at its last measured value.
    no_forgetting : tuple of float
        The same model with the rule that never forgets.
    samples : int
        Samples scored, the same for all three.
    """

    model: tuple[float, ...]
    last_value: tuple[float, ...]
    no_forgetting: tuple[float, ...]
    samples: int

    def by_output(self, outputs: Sequence[str]) -> dict[str, dict[str, float]]:
        """The three errors of each output, by name."""
        return {
            output: {
                "model": self.model[j],
                "last_value": self.last_value[j],
                "no_forgetting": self.no_forgetting[j],
            }
            for j, output in enumerate(outputs)
        }


def score(samples: Samples, error: Array, error_without_forgetting: Array) -> Scores:
    """Score on every complete sample but the start.

    The start is the first n complete samples, n the number of regressors: before them n parameters
    do not follow from any data, and every estimator shows only its initial guess. A sample also
    needs an earlier measured output, which the last-value baseline repeats.
    """
    previous = last_measured(samples.y)
    scored = started(samples) & ~np.isnan(previous).any(axis=1)
    return Scores(
        model=rms(error[scored]),
        last_value=rms((samples.y - previous)[scored]),
        no_forgetting=rms(error_without_forgetting[scored]),
        samples=int(scored.sum()),
    )


def started(samples: Samples) -> NDArray[np.bool_]:
    """Complete samples after the first n complete ones, (T,)."""
    complete = samples.complete
    return np.asarray(complete & (np.cumsum(complete) > samples.phi.shape[1]))
