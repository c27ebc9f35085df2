"""One-step scores: the model beside baselines, on the same samples."""

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
    mean : tuple of float
        Predicting the mean over the samples scored.
    without_inputs : tuple of float or None
        The same model and rule on past outputs alone; None for a model without past outputs, or
        with nothing else.
    samples : int
        Samples scored, the same for all.
    """

    model: tuple[float, ...]
    last_value: tuple[float, ...]
    no_forgetting: tuple[float, ...]
    mean: tuple[float, ...]
    without_inputs: tuple[float, ...] | None
    samples: int

    @property
    def fit(self) -> tuple[float, ...]:
        """100 (1 - ‖error‖/‖y - mean‖) of each output, in percent; NaN for a constant one."""
        pairs = zip(self.model, self.mean, strict=True)
        return tuple(100 * (1 - e / m) if m > 0 else float("nan") for e, m in pairs)

    def by_output(self, outputs: Sequence[str]) -> dict[str, dict[str, float | None]]:
        """The errors of each output, and the fit in percent, by name."""
        return {
            output: {
                "model": self.model[j],
                "last_value": self.last_value[j],
                "no_forgetting": self.no_forgetting[j],
                "mean": self.mean[j],
                "without_inputs": None if self.without_inputs is None else self.without_inputs[j],
                "fit_percent": self.fit[j],
            }
            for j, output in enumerate(outputs)
        }


def score(
    samples: Samples,
    error: Array,
    error_without_forgetting: Array,
    error_without_inputs: Array | None = None,
    among: NDArray[np.bool_] | None = None,
) -> Scores:
    """Score on every complete sample but the start.

    The start is the first n complete samples, n the number of regressors: before them n parameters
    do not follow from any data, and every estimator shows only its initial guess. A sample also
    needs an earlier measured output, which the last-value baseline repeats. `among` (T,) leaves
    out more samples.
    """
    y = samples.as_measured
    previous = last_measured(y)
    scored = scored_samples(samples, previous)
    scored &= True if among is None else among
    level = y[scored].mean(axis=0) if scored.any() else 0.0
    alone = error_without_inputs
    return Scores(
        model=rms(error[scored]),
        last_value=rms((y - previous)[scored]),
        no_forgetting=rms(error_without_forgetting[scored]),
        mean=rms((y - level)[scored]),
        without_inputs=None if alone is None else rms(alone[scored]),
        samples=int(scored.sum()),
    )


def scored_samples(samples: Samples, previous: Array | None = None) -> NDArray[np.bool_]:
    """Samples that count, (T,); `previous` (T, m) are the outputs measured last, if known."""
    previous = last_measured(samples.as_measured) if previous is None else previous
    return np.asarray(started(samples) & ~np.isnan(previous).any(axis=1))


def started(samples: Samples) -> NDArray[np.bool_]:
    """Complete samples after the first n complete ones, (T,)."""
    complete = samples.complete
    return np.asarray(complete & (np.cumsum(complete) > samples.phi.shape[1]))
