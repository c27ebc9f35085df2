"""What an identification found."""

from __future__ import annotations

from dataclasses import asdict, dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from forgetting.analysis import Excited, Guarantee, guaranteed_bounds
from forgetting.files import check_outputs
from forgetting.judgement import Judgement
from forgetting.record import estimates
from forgetting.record.ahead import Ahead
from forgetting.record.changes import Change, changes
from forgetting.record.counts import Counts
from forgetting.record.drift import Drift, claim, drift
from forgetting.record.intervals import OneStep
from forgetting.record.known import Known
from forgetting.record.memories import Memories, memories, memory
from forgetting.record.origin import origin
from forgetting.record.parameters import final
from forgetting.record.samples import Samples, pieces
from forgetting.record.scores import Scores
from forgetting.record.trace import USED
from forgetting.record.uncertainty import noise_variance, standard_errors
from forgetting.record.units import parameter_unit
from forgetting.words.duration import spoken
from forgetting.words.finite import finite

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
        The forgetting rule; of a bank that of the member most believed at the end.
    members : list of Rule
        Of a bank; empty for a rule.
    scores : Scores
        One-step errors of the model and of baselines, on the same samples.
    judgement : Judgement
        What speaks for and against the result, and what to do first.
    excited : Excited
        What the samples within the rule's memory excite, all along the record.
    initial_covariance : ndarray, shape (n, n)
        P before the first sample, for regressors in these units.
    units : ndarray, shape (n,)
        What regressors were measured in at the end; 1 where P before the first sample was given.
    settings : dict
        Of estimators on this record: targets, initial_covariance and dtype.
    known : Known
        What was known of parameters before. Those that are fixed are not among the regressors.
    level : float or None
        Of the intervals about one-step predictions, where they were asked for.
    ahead : Ahead or None
        Forecasts many steps ahead, where they were asked for.
    """

    samples: Samples
    rule: Any
    scores: Scores
    judgement: Judgement
    excited: Excited
    initial_covariance: Array
    units: Array
    settings: dict[str, Any]
    members: list[Any]
    known: Known = field(default_factory=Known)
    level: float | None = None
    ahead: Ahead | None = None

    @cached_property
    def noise_variance(self) -> Array:
        """Running noise variance, (T, m); see `forgetting.record.uncertainty`."""
        return noise_variance(self.trace)

    @cached_property
    def drift(self) -> Drift | None:
        """How parameters drift and noise remembers, most likely; None for too short a record."""
        return drift(self.samples, self.settings, self.known)

    @property
    def standard_error(self) -> Array:
        """± of each parameter after each sample, (T, n, m); see `standard_error_of`."""
        found = np.empty_like(self.theta)
        for i, j in np.ndindex(found.shape[1:]):
            found[:, i, j] = self.standard_error_of(i, j)
        return found

    def standard_error_of(self, i: int, j: int = 0, rows: slice = slice(None)) -> Array:
        """± of parameter i of output j after each sample, or after some, (T,).

        Of a bank, which supposes nothing, that of `drift`: two of them hold about 95 % of what the
        parameter may be. Of a rule what its P says; `uncertainty` says how right that is here.
        """
        claimed = standard_errors(self.trace.variance[rows, i], self.noise_variance[rows, j])
        if self.trace.weights is None or self.drift is None:
            return claimed
        at = np.arange(*rows.indices(len(self.theta)))
        found = self.drift.standard_error(self.theta[rows, i, j], i, j, at)
        return np.where(np.isnan(claimed), np.nan, found)

    @cached_property
    def final_standard_error(self) -> Array:
        """The last of `standard_error`, (n, m)."""
        claimed = np.sqrt(self.trace.variance[-1][:, None] * self.noise_variance[-1])
        if self.trace.weights is None or self.drift is None:
            return np.asarray(claimed)
        found = self.drift.final_standard_error(self.theta[-1])
        return np.where(np.isnan(claimed), np.nan, found)

    @property
    def claimed_standard_error(self) -> Array:
        """What P says of each parameter after each sample, (T, n, m): √(σ² P_ii).

        It is right if the parameters drift as the rule supposes and the noise is white.
        """
        variance, noise = self.trace.variance[:, :, None], self.noise_variance[:, None, :]
        return standard_errors(variance, noise)

    @property
    def verdicts(self) -> list[str]:
        """The findings of the judgement in plain sentences, the worst first."""
        return self.judgement.sentences()

    @cached_property
    def noise(self) -> Array:
        """Standard deviation of the noise of each output, (m,), over the last quarter of samples.

        The root mean square of e/√(1 + s), s the leverage; of a bank, whose members that do not
        count swell the leverage, of the errors themselves.
        """
        used = np.flatnonzero(self.trace.skipped == USED)
        last = used[-max(len(used) // 4, 1) :]
        if not len(last):
            return np.full(self.theta.shape[2], np.nan)
        spread = 1 + self.trace.leverage[last] * (self.trace.weights is None)
        return np.asarray(np.sqrt(np.mean(self.trace.error[last] ** 2 / spread[:, None], axis=0)))

    @cached_property
    def memories(self) -> Memories | None:
        """Which memories fitted when: how fast the parameters change; None for a single rule."""
        if self.trace.weights is None:
            return None
        moved = origin(self.samples, self.settings["initial_covariance"] is None)
        return memories(moved.moved(self.samples), self.trace, self.members, self.settings)

    @cached_property
    def intervals(self) -> OneStep | None:
        """Intervals about one-step predictions, and their coverage; None without a level."""
        return None if self.level is None else OneStep(self.trace, self.level)

    @cached_property
    def changes(self) -> list[Change]:
        """When errors became larger than those before allow; see `forgetting.record.changes`."""
        moves = self.settings["initial_covariance"] is None
        return changes(origin(self.samples, moves).moved(self.samples))

    @property
    def theta(self) -> Array:
        """Estimate after each sample, (T, n, m)."""
        return self.trace.theta

    @property
    def prediction(self) -> Array:
        """One-step prediction of each output, (T, m); NaN where the sample was missing."""
        return self.samples.as_measured - self.trace.error

    @property
    def parameters(self) -> pd.DataFrame:
        """Final values: output, parameter, value, standard_error and unit (None if not known).

        Where something was known of them before, `known` says what.
        """
        rows = [(*row, self.unit(*row[:2])) for row in final(self)]
        columns = ["output", "parameter", "value", "standard_error", "unit"]
        found = pd.DataFrame(rows, columns=columns).astype({"unit": object})
        if self.known:
            found["known"] = [self.known.words(name) for name in found["parameter"]]
        return found

    def unit(self, output: str, regressor: str | None = None) -> str | None:
        """Unit of an output, or of its parameter of a regressor; None if the record names none."""
        units = self.samples.found.units
        return units.get(output) if regressor is None else parameter_unit(output, regressor, units)

    @property
    def uncertainty(self) -> str:
        """What ± counts with, and for a rule by how much it is off where it counts wrongly."""
        if self.drift is None:
            return "± is what P says: the record is too short to tell how parameters drift."
        if self.trace.weights is not None:
            return self.drift.describe()
        right = self.drift.final_standard_error(self.theta[-1])
        return claim(self.final_standard_error, right, self.drift)

    @property
    def memory(self) -> float:
        """Samples that the estimate stands on at the end; infinite if nothing is forgotten."""
        return memory(self.trace)

    @property
    def rule_in_words(self) -> str:
        """The rule, or the bank: how many members, and over how many samples it remembers."""
        if self.trace.weights is None or self.trace.memory is None:
            return repr(self.rule)
        memory = self.trace.memory[-1]
        length = "the whole record"
        if np.isfinite(memory):
            step = self.samples.usual_step
            time = "" if step is None else f" ({spoken(float(memory) * step)})"
            length = f"{memory:.3g} samples{time}"
        return f"bank of {len(self.trace.weights)} members, at the end with a memory of {length}"

    @cached_property
    def guarantee(self) -> Guarantee:
        """Bounds of P that the rule guarantees, for regressors and rates as in this record."""
        if self.trace.weights is not None:
            return Guarantee(None, None, bounded=True)
        used = self.trace.skipped == USED
        factors = self.trace.forgetting_factor[used]
        largest = 0.0
        for part in pieces(len(used)):
            squares = np.square(self.samples.phi[part][used[part]] / self.units).sum(axis=1)
            largest = max(largest, float(squares.max(initial=0.0)))
        return guaranteed_bounds(
            self.rule,
            self.initial_covariance,
            parameters=self.samples.phi.shape[1],
            forgetting_factors=(factors.min(initial=1.0), factors.max(initial=0.0) or 1.0),
            regressor_bound=largest,
        )

    @property
    def covariance_ratio(self) -> float:
        """Largest over smallest eigenvalue of P at the end; inf when rounding made it singular."""
        smallest, largest = self.trace.eigenvalues[-1][[0, -1]]
        return float(largest / smallest) if smallest > 0 else float("inf")

    def estimates(self) -> pd.DataFrame:
        """Every sample's estimate, error and prediction, as a table of T rows."""
        return self._table(None)

    def save_estimates(self, path: str | Path) -> None:
        """Write `estimates` as Parquet or CSV, by suffix."""
        check_outputs({"estimates": Path(path)}, self.samples.found.path)
        tables = (self._table(part) for part in pieces(len(self.samples.y)))
        estimates.save(tables, Path(path))

    def _table(self, part: slice | None) -> pd.DataFrame:
        return estimates.table(
            self.samples, self.trace, self.standard_error_of, part, self.intervals
        )

    def summary(self) -> dict[str, Any]:
        """What `forgetting identify` prints, for JSON: None where a number is not finite."""
        ends = self.trace.eigenvalues[-1]
        found = {
            "record": self.samples.source,
            "model": self.samples.model,
            "rule": self.rule_in_words,
            "parameters": self.parameters.to_dict("records"),
            "known": self.known.to_dict() if self.known else None,
            "uncertainty": self.uncertainty,
            "drift": None if self.drift is None else self.drift.to_dict(),
            "rmse": self.scores.by_output(self.samples.outputs),
            "read_as": self.samples.found.to_dict(),
            "clock": self.samples.clock_as_data(),
            "intervals": self.intervals and self.intervals.to_dict(self.samples.outputs),
            "ahead": self.ahead and self.ahead.to_dict(),
            "noise": dict(zip(self.samples.outputs, self.noise.tolist(), strict=True)),
            "memory": self.memory,
            "memories": None if self.memories is None else self.memories.to_dict(),
            "samples": self.counts() | {"scored": self.scores.samples},
            "covariance": {
                "smallest_eigenvalue": float(ends[0]),
                "largest_eigenvalue": float(ends[-1]),
                "ratio": self.covariance_ratio,
            },
            "changes": [asdict(change) for change in self.changes],
            "windup_samples": int(self.trace.windup.sum()),
            "judgement": self.judgement.to_dict(),
            "verdicts": self.verdicts,
        }
        return dict(finite(found))
