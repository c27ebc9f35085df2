"""What an identification found."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from forgetting.analysis import Excited, Guarantee, excited, guaranteed_bounds
from forgetting.record import estimates
from forgetting.record.samples import Samples
from forgetting.record.scores import Scores
from forgetting.record.trace import (
    DEAD_ZONE,
    FROZEN,
    HELD,
    MISSING,
    USED,
    WITHIN_BOUND,
    Trace,
)
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
    initial_covariance : ndarray, shape (n, n)
        P before the first sample.
    """

    samples: Samples
    trace: Trace
    rule: Any
    scores: Scores
    verdicts: list[str]
    initial_covariance: Array

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
    def within_bound(self) -> int:
        """Samples skipped because their error was within the rule's bound on the noise."""
        return int((self.trace.skipped == WITHIN_BOUND).sum())

    @property
    def held(self) -> int:
        """Samples that the gate held: neither forgotten nor learned from."""
        return int((self.trace.skipped == HELD).sum())

    @property
    def frozen(self) -> int:
        """Samples that the gate froze: learned from, while nothing was forgotten."""
        return int((self.trace.gate == FROZEN).sum())

    def left_out(self) -> str:
        """Samples that were not used, in words, and those that were frozen."""
        counts = [
            (self.missing, "missing"),
            (self.dead_zone, "in the dead zone"),
            (self.within_bound, "within the bound on the noise"),
            (self.held, "held by the gate"),
            (self.frozen, "frozen by the gate"),
        ]
        always = counts[:2]
        return ", ".join(f"{n} {words}" for n, words in counts if n or (n, words) in always)

    @cached_property
    def guarantee(self) -> Guarantee:
        """Bounds of P that the rule guarantees, for regressors and rates as in this record."""
        used = self.trace.skipped == USED
        factors = self.trace.forgetting_factor[used]
        squares = np.square(self.samples.phi[used]).sum(axis=1)
        return guaranteed_bounds(
            self.rule,
            self.initial_covariance,
            parameters=self.samples.phi.shape[1],
            forgetting_factors=(factors.min(initial=1.0), factors.max(initial=0.0) or 1.0),
            regressor_bound=float(squares.max(initial=0.0)),
        )

    @cached_property
    def excited(self) -> Excited:
        """What the samples within the rule's memory tell, all along the record."""
        used = self.trace.skipped == USED
        forgotten = 1.0 - float(np.median(self.trace.forgetting_factor[used])) if used.any() else 0
        total, n = self.samples.phi.shape
        longest = max(1, min(total, max(2 * n, total // 4)))
        window = int(np.clip(np.ceil(1 / max(forgotten, 1e-9)), min(2 * n, longest), longest))
        return excited(self.samples.phi, window)

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
