"""What an identification found."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from forgetting.analysis import Excited, Guarantee, excited, guaranteed_bounds
from forgetting.files import check_outputs
from forgetting.record import estimates
from forgetting.record.counts import Counts
from forgetting.record.samples import Samples
from forgetting.record.scores import Scores
from forgetting.record.trace import USED
from forgetting.record.uncertainty import noise_variance, standard_errors

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Identification(Counts):
    """The result of `forgetting.record.identify`.

    `forgetting.report.save` writes it as a page, `forgetting.plot.save_overview` as a picture.

    Attributes
    ----------
    trace : Trace
        Estimates, errors and covariance over time.
    samples : Samples
        Regressors and outputs as they entered the estimator.
    rule : Rule
        The forgetting rule.
    scores : Scores
        One-step errors of the model and of two baselines, on the same samples.
    verdicts : list of str
        Plain sentences on what the record excited.
    initial_covariance : ndarray, shape (n, n)
        P before the first sample, for regressors in these units.
    units : ndarray, shape (n,)
        What regressors were measured in at the end; 1 where P before the first sample was given.
    """

    samples: Samples
    rule: Any
    scores: Scores
    verdicts: list[str]
    initial_covariance: Array
    units: Array

    @cached_property
    def noise_variance(self) -> Array:
        """Running noise variance, (T, m); see `forgetting.record.uncertainty`."""
        return noise_variance(self.trace)

    @cached_property
    def standard_error(self) -> Array:
        """Standard error of each parameter after each sample, (T, n, m)."""
        return standard_errors(self.trace)

    @property
    def theta(self) -> Array:
        """Estimate after each sample, (T, n, m)."""
        return self.trace.theta

    @property
    def prediction(self) -> Array:
        """One-step prediction of each output, (T, m); NaN where the sample was missing."""
        return self.samples.y - self.trace.error

    @property
    def parameters(self) -> pd.DataFrame:
        """Final values: one row per output and regressor, with value and standard_error."""
        return pd.DataFrame(
            self.final(), columns=["output", "parameter", "value", "standard_error"]
        )

    @property
    def rule_in_words(self) -> str:
        """The rule, or the bank: how many members, and over how many samples it remembers."""
        if self.trace.weights is None or self.trace.memory is None:
            return repr(self.rule)
        memory = self.trace.memory[-1]
        length = f"{memory:.3g} samples" if np.isfinite(memory) else "the whole record"
        return (
            f"bank of {self.trace.weights.shape[1]} members, at the end with a memory of {length}"
        )

    def final(self) -> list[tuple[str, str, float, float]]:
        """Output, regressor, final value and its standard error, output by output."""
        return [
            (output, name, float(self.theta[-1, i, j]), float(self.standard_error[-1, i, j]))
            for j, output in enumerate(self.samples.outputs)
            for i, name in enumerate(self.samples.regressors)
        ]

    @cached_property
    def guarantee(self) -> Guarantee:
        """Bounds of P that the rule guarantees, for regressors and rates as in this record."""
        if self.trace.weights is not None:
            return Guarantee(None, None, bounded=True)
        used = self.trace.skipped == USED
        factors = self.trace.forgetting_factor[used]
        squares = np.square(self.samples.phi[used] / self.units).sum(axis=1)
        return guaranteed_bounds(
            self.rule,
            self.initial_covariance,
            parameters=self.samples.phi.shape[1],
            forgetting_factors=(factors.min(initial=1.0), factors.max(initial=0.0) or 1.0),
            regressor_bound=float(squares.max(initial=0.0)),
        )

    @cached_property
    def excited(self) -> Excited:
        """What the samples within the rule's memory excite, all along the record."""
        used = self.trace.skipped == USED
        forgotten = 1.0 - float(np.median(self.trace.forgetting_factor[used])) if used.any() else 0
        total, n = self.samples.phi.shape
        longest = max(1, min(total, max(2 * n, total // 4)))
        remembered = 1 / max(forgotten, 1e-9)
        if self.trace.memory is not None and used.any():
            remembered = float(np.median(self.trace.memory[used]))
        window = int(np.clip(np.ceil(remembered), min(2 * n, longest), longest))
        return excited(self.samples.phi, window)

    @property
    def covariance_ratio(self) -> float:
        """Largest over smallest eigenvalue of P at the end; inf when rounding made it singular."""
        smallest, largest = self.trace.eigenvalues[-1][[0, -1]]
        return float(largest / smallest) if smallest > 0 else float("inf")

    def estimates(self) -> pd.DataFrame:
        """Every sample's estimate, error and prediction, as a table of T rows."""
        return estimates.table(self.samples, self.trace, self.prediction, self.standard_error)

    def save_estimates(self, path: str | Path) -> None:
        """Write `estimates` as Parquet or CSV, by suffix."""
        check_outputs({"estimates": Path(path)}, self.samples.found.path)
        estimates.save(self.estimates(), Path(path))

    def summary(self) -> dict[str, Any]:
        """What `forgetting identify` prints, for JSON: None where a number is not finite."""
        rows = self.parameters.to_dict("records")
        ends = self.trace.eigenvalues[-1]
        found = {
            "record": self.samples.source,
            "model": self.samples.model,
            "rule": self.rule_in_words,
            "parameters": rows,
            "rmse": self.scores.by_output(self.samples.outputs),
            "read_as": self.samples.found.to_dict(),
            "clock": self.samples.clock_as_data(),
            "samples": self.counts() | {"scored": self.scores.samples},
            "covariance": {
                "smallest_eigenvalue": float(ends[0]),
                "largest_eigenvalue": float(ends[-1]),
                "ratio": self.covariance_ratio,
            },
            "windup_samples": int(self.trace.windup.sum()),
            "verdicts": self.verdicts,
        }
        return dict(finite(found))


def finite(value: Any) -> Any:
    """The value, all it contains included, with None in place of NaN and infinity."""
    if isinstance(value, dict):
        return {key: finite(each) for key, each in value.items()}
    if isinstance(value, list):
        return [finite(each) for each in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value
