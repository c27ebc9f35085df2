"""The verdict on a record, for a person and for a machine."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..judgement import Finding
from ..judgement.residuals import own_past, whiteness
from .conditions import Conditions, conditions
from .confidence import Confidence, confidence
from .direction import describe_direction
from .excitation import Excitation, excitation
from .stability import Stability, stability
from .trajectory import Trajectory, trajectory_of
from .ultimate_bound import UltimateBound, ultimate_bound
from .windup import Windup, windup


@dataclass(frozen=True, eq=False)
class Certificate:
    """Everything the analysis says of a record. See `certify`.

    Attributes
    ----------
    excitation : Excitation
    conditions : Conditions
    stability : Stability
    windup : Windup
    ultimate_bound : UltimateBound or None
        Where bounds on the disturbances are known.
    confidence : Confidence or None
        Where the run has errors.
    names : tuple of str or None
        Names of the parameters.
    """

    excitation: Excitation
    conditions: Conditions
    stability: Stability
    windup: Windup
    ultimate_bound: UltimateBound | None
    confidence: Confidence | None
    names: tuple[str, ...] | None = field(default=None, repr=False)

    @property
    def windup_occurred(self) -> bool:
        """True when windup occurred anywhere in the record."""
        return self.windup.occurred

    @property
    def verdict(self) -> str:
        """One sentence: can the estimate be trusted?

        Errors that follow from their own past come first: a wrong model is wrong whatever the
        excitation. `forgetting.record.identify` judges more than arrays tell.
        """
        residuals = self._residuals()
        if residuals is not None and residuals.severity == "wrong":
            return str(residuals)
        silent = self.excitation.silent_subspace.T
        if self.windup_occurred and self.windup.direction is not None:
            where = describe_direction(self.windup.direction, self.names)
            when = "at the end" if self.windup.persists else f"from sample {self.windup.sample} on"
            return f"Windup occurred: do not trust the estimate along {where} {when}."
        if len(silent):
            where = "; ".join(describe_direction(axis, self.names) for axis in silent)
            return (
                f"No windup. The record informs about {self.excitation.rich} of "
                f"{len(self.excitation.directions)} directions; along {where} "
                "the initial estimate stands."
            )
        last = self.stability.conclusions[-1]
        if last.outcome == "follows":
            return "No windup: every direction is excited and the estimate is stable."
        return f"No windup; that the error vanishes {_short(last.outcome)} ({last.reason})."

    def _residuals(self) -> Finding | None:
        """The judge on the whitened errors of the first output."""
        if self.confidence is None:
            return None
        error, width = (
            part[:, 0, 0] for part in (self.confidence.error, self.confidence.half_width)
        )
        whole = self.confidence.counted[:, 0, 0] & (width > 0) & np.isfinite(width)
        spread = np.divide(error, width, out=np.full_like(error, np.nan), where=whole)
        return whiteness(own_past(spread), "the output")

    def __str__(self) -> str:
        """The verdict and what stands behind it."""
        parts = ["Verdict", _indent(self.verdict), _indent(self.windup.describe(self.names))]
        return "\n".join([*parts, self.theory()])

    def theory(self, first: int = 0) -> str:
        """What theory says of the estimator, whatever the model; `first`: rows not examined."""
        what = "For a right model whose parameters stand still"
        rest = f", on the rows from {first + 1} on" if first else ""
        parts = [f"{what}{rest}:", "Excitation", _indent(self._excitation())]
        parts += ["Conditions", _indent(self._conditions())]
        parts += ["Stability", _indent(str(self.stability))]
        if self.ultimate_bound is not None:
            parts += ["Ultimate bound", _indent(str(self.ultimate_bound))]
        if self.confidence is not None:
            parts += ["Intervals", _indent(str(self.confidence))]
        return "\n".join(parts)

    def _conditions(self) -> str:
        lines = [str(item) for item in self.conditions if item.constants or item.name < "A5"]
        unknown = [item.name for item in self.conditions if item.name > "A4" and not item.constants]
        if unknown:
            lines.append(f"{', '.join(unknown)} need the truth, or bounds given by the user")
        return "\n".join(lines)

    def _excitation(self) -> str:
        found = self.excitation
        ratio = f"alpha = {found.alpha:.4g}, beta = {found.beta:.4g}"
        if found.persistent:
            return f"Every window of {found.window} samples excites every direction ({ratio})."
        return (
            f"The window of {found.window} samples from sample {found.first_failure} on leaves a "
            f"direction unexcited ({ratio})."
        )

    def to_dict(self) -> dict[str, Any]:
        """Return the certificate, ready for JSON."""
        bound, intervals = self.ultimate_bound, self.confidence
        return {
            "verdict": self.verdict,
            "windup_occurred": self.windup_occurred,
            "windup": self.windup.to_dict(),
            "excitation": self.excitation.to_dict(),
            "conditions": self.conditions.to_dict(),
            "stability": self.stability.to_dict(),
            "ultimate_bound": None if bound is None else bound.to_dict(),
            "confidence": None if intervals is None else intervals.to_dict(),
        }


def certify(
    run: Any,
    regressors: ArrayLike | None = None,
    *,
    gamma: ArrayLike | None = None,
    initial_covariance: ArrayLike | None = None,
    window: int | None = None,
    threshold: float | None = None,
    ceiling: ArrayLike | None = None,
    rule: Any = None,
    factor: float = 10.0,
    true_theta: ArrayLike | None = None,
    measurement_noise: ArrayLike | None = None,
    regressor_noise: ArrayLike | None = None,
    names: Sequence[str] | None = None,
) -> Certificate:
    """Judge a record: excitation, conditions, stability, windup, intervals.

    Parameters
    ----------
    run : Run or Trajectory
        A Run needs ``outputs=(..., "covariance")``; with "error" the intervals are judged,
        with "prior_covariance" nothing is reconstructed.
    regressors, gamma, initial_covariance : optional
        As given to the run.
    window, threshold : optional
        See `conditions` and `excitation`.
    ceiling, rule, factor : optional
        See `windup`; `rule` is the rule of the estimator, which may set P a bound.
    true_theta, measurement_noise, regressor_noise : optional
        See `conditions`; with any of them the ultimate bound is computed.
    names : sequence of n str, optional
        Names of the parameters, for the words.

    Returns
    -------
    Certificate

    Examples
    --------
    >>> import numpy as np
    >>> from forgetting.analysis import Trajectory
    >>> trajectory = Trajectory.from_arrays(np.ones((40, 1)), np.full((41, 1, 1), 0.5))
    >>> certify(trajectory).verdict
    'No windup: every direction is excited and the estimate is stable.'
    """
    trajectory = trajectory_of(run, regressors, gamma, initial_covariance)
    found = conditions(
        trajectory,
        window=window,
        threshold=threshold,
        true_theta=true_theta,
        measurement_noise=measurement_noise,
        regressor_noise=regressor_noise,
    )
    wound = windup(trajectory, ceiling=ceiling, rule=rule, factor=factor)
    # What the estimator remembers is what must excite it; A4 may hold for longer windows only.
    length = min(window or wound.window, trajectory.samples)
    truth = (true_theta, measurement_noise, regressor_noise)
    return Certificate(
        excitation=excitation(trajectory.phibar, length, threshold=threshold),
        conditions=found,
        stability=stability(found),
        windup=wound,
        ultimate_bound=_bound(found, truth),
        confidence=_intervals(run, trajectory),
        names=None if names is None else tuple(names),
    )


def _bound(found: Conditions, truth: tuple[ArrayLike | None, ...]) -> UltimateBound | None:
    return None if all(item is None for item in truth) else ultimate_bound(found)


def _intervals(run: Any, trajectory: Trajectory) -> Confidence | None:
    """Intervals where the run has errors, with the samples it skipped left out."""
    errors = getattr(run, "error", None)
    if errors is None:
        return None
    values = np.array(errors, dtype=np.float64)
    skipped = getattr(run, "skipped", None)
    if skipped is not None:
        values[np.asarray(skipped) != 0] = np.nan
    return confidence(trajectory, errors=values)


def _indent(text: str) -> str:
    return "\n".join(f"  {line}" for line in text.splitlines())


def _short(outcome: str) -> str:
    return "does not follow" if outcome == "does not follow" else "cannot be decided"
