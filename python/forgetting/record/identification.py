"""What an identification found."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from forgetting.record import estimates
from forgetting.record.samples import Samples
from forgetting.record.scores import Scores
from forgetting.record.trace import DEAD_ZONE, MISSING, USED, Trace
from forgetting.record.uncertainty import noise_variance, standard_errors

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Identification:
    """The result of `forgetting.record.identify`.

    Attributes
    ----------
    samples : Samples
        Regressors and outputs as they entered the estimator.
    trace : Trace
        Estimates, errors and covariance over time.
    rule : Rule
        The forgetting rule.
    scores : Scores
        One-step errors of the model and of two baselines, on the same samples.
    verdicts : list of str
        Plain sentences on what the record excited.
    """

    samples: Samples
    trace: Trace
    rule: Any
    scores: Scores
    verdicts: list[str]

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

    def final(self) -> list[tuple[str, str, float, float]]:
        """Output, regressor, final value and its standard error, output by output."""
        return [
            (output, name, float(self.theta[-1, i, j]), float(self.standard_error[-1, i, j]))
            for j, output in enumerate(self.samples.outputs)
            for i, name in enumerate(self.samples.regressors)
        ]

    @property
    def used(self) -> int:
        """Samples the estimate learned from."""
        return int((self.trace.skipped == USED).sum())

    @property
    def missing(self) -> int:
        """Samples skipped because a value was missing or a lag crossed a gap."""
        return int((self.trace.skipped == MISSING).sum())

    @property
    def dead_zone(self) -> int:
        """Samples skipped because they carried too little information."""
        return int((self.trace.skipped == DEAD_ZONE).sum())

    @property
    def covariance_ratio(self) -> float:
        """Largest over smallest eigenvalue of P at the end; inf when rounding made it singular."""
        smallest, largest = self.trace.eigenvalues[-1][[0, -1]]
        return float(largest / smallest) if smallest > 0 else float("inf")

    def summary(self) -> dict[str, Any]:
        """Everything `forgetting identify` prints, as plain numbers and text for JSON."""
        return estimates.summary(self)

    def estimates(self) -> pd.DataFrame:
        """Every sample's estimate, error and prediction, as a table of T rows."""
        return estimates.table(self)

    def save_estimates(self, path: str | Path) -> None:
        """Write `estimates` as Parquet or CSV, by suffix."""
        estimates.save(self, Path(path))

    def save_report(self, path: str | Path) -> None:
        """Write one self-contained HTML page; needs jinja2 and matplotlib."""
        from forgetting.report import save

        save(self, path)

    def save_plot(self, path: str | Path) -> None:
        """Write the overview picture, PNG, SVG or PDF by suffix; needs matplotlib."""
        from forgetting.plot import save_overview

        save_overview(self, path)
