"""Conditions A1-A8 of Lai and Bernstein over a record, with the constants found.

With θ* the true parameters:

    A1  F_k >= 0                       proper: forgetting never adds information
    A2  P̄_k <= b I                     covariance bounded after forgetting
    A3  P_k >= a I                     covariance bounded from below
    A4  Σ_N φᵀΓ⁻¹φ >= α I, φᵀΓ⁻¹φ <= β I      persistent excitation
    A5  ‖θ*_{k+1} - θ*_k‖ <= δ_θ       A6  ‖Γ^{-1/2} δ_y‖ <= δ_y
    A7  δ_φᵀ Γ⁻¹ δ_φ <= δ_φ I          A8  ‖θ*_k‖ <= θ_max
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any, Literal

from numpy.typing import ArrayLike

from .covariance_bounds import lower_bound, proper, upper_bound
from .disturbance import disturbances
from .excitation import (
    RELATIVE_THRESHOLD,
    first_failure,
    persistency_window,
    sample_bound,
    window_eigenvalues,
)
from .trajectory import Trajectory, trajectory_of
from .trend import Trend
from .validation import real, whole

Verdict = Literal["holds", "fails", "not decidable"]


@dataclass(frozen=True)
class Condition:
    """Verdict on one condition.

    Attributes
    ----------
    name : str
        "A1" ... "A8".
    statement : str
    verdict : {"holds", "fails", "not decidable"}
        "holds" is about the samples in the record. For A2 and A3, which any finite
        record meets with some constant, it also means that the constant does not drift.
    constants : dict
        The constants found, by name.
    sample : int or None
        First sample at which the condition fails.
    reason : str
    trend : Trend or None
        Drift of the bound (A2, A3).
    """

    name: str
    statement: str
    verdict: Verdict
    constants: dict[str, float]
    sample: int | None
    reason: str
    trend: Trend | None = None

    def __str__(self) -> str:
        """The condition in one line."""
        at = "" if self.sample is None else f" at sample {self.sample}"
        return f"{self.name} ({self.statement}) {self.verdict}{at}: {self.reason}"

    def to_dict(self) -> dict[str, Any]:
        """Return the fields, ready for JSON."""
        return {
            "statement": self.statement,
            "verdict": self.verdict,
            "sample": self.sample,
            "constants": dict(self.constants),
            "reason": self.reason,
            "trend": None if self.trend is None else self.trend.to_dict(),
        }


@dataclass(frozen=True, eq=False)
class Conditions:
    """Verdicts on A1-A8 and the constants they share. See `conditions`."""

    verdicts: tuple[Condition, ...]
    window: int | None
    trajectory: Trajectory = field(repr=False)

    def __getitem__(self, name: str) -> Condition:
        """Return the condition called `name`, "A1" ... "A8"."""
        return next(item for item in self.verdicts if item.name == name)

    def __iter__(self) -> Iterator[Condition]:
        """Iterate over A1 ... A8."""
        return iter(self.verdicts)

    def __str__(self) -> str:
        """One line a condition."""
        return "\n".join(str(item) for item in self.verdicts)

    @property
    def constants(self) -> dict[str, float]:
        """All constants found: a, b, alpha, beta, window, and the disturbances known."""
        found: dict[str, float] = {}
        for item in self.verdicts:
            found.update(item.constants)
        return found

    def to_dict(self) -> dict[str, Any]:
        """Return verdicts and constants, ready for JSON."""
        return {item.name: item.to_dict() for item in self.verdicts}


def conditions(
    run: Any,
    regressors: ArrayLike | None = None,
    *,
    gamma: ArrayLike | None = None,
    initial_covariance: ArrayLike | None = None,
    window: int | None = None,
    threshold: float | None = None,
    limits: tuple[float, float] | None = None,
    true_theta: ArrayLike | None = None,
    measurement_noise: ArrayLike | None = None,
    regressor_noise: ArrayLike | None = None,
) -> Conditions:
    """Check A1-A8 over a record.

    Parameters
    ----------
    run : Run or Trajectory
        A Run needs ``outputs=(..., "covariance")``, better with "prior_covariance".
    regressors : (T, n) or (T, rows, n)
        The regressors given to the run (None with a Trajectory).
    gamma, initial_covariance : optional
        As given to the run. Without the initial covariance the check starts at sample 1.
    window : int in [1, T], optional
        N of A4. Default: the shortest window that excites every direction everywhere.
    threshold : float >= 0, optional
        Information a window must hold; see `excitation`.
    limits : (a, b), optional
        Bounds to hold P to: A2 and A3 then fail at the first sample outside.
    true_theta : (n,) or (T, n), optional
        The true parameters, for A5 and A8.
    measurement_noise : float or (T,) or (T, rows), optional
        The bound δ_y (weighted), or the noise itself, for A6.
    regressor_noise : float or (T, n) or (T, rows, n), optional
        The bound δ_φ (weighted, an eigenvalue: the square of an amplitude), or the
        noise itself, for A7.

    Returns
    -------
    Conditions

    Raises
    ------
    InvalidInput
        An output missing from the run, a wrong shape, a value out of range.

    Notes
    -----
    Source: Lai and Bernstein, sections III and IV. Skipped samples count as φ = 0.
    Where the subspace rule filters a part of a sample (rows > 1), give the regressors of
    `filtered_regressors`.

    Examples
    --------
    >>> import numpy as np
    >>> phi = np.ones((40, 1))
    >>> path = 0.5 * np.ones((41, 1, 1))
    >>> trajectory = Trajectory.from_arrays(phi, path)  # forgets as much as it learns
    >>> print(conditions(trajectory)["A2"])
    A2 (P̄ <= b I) holds: b = 1 over the record, no drift
    """
    trajectory = trajectory_of(run, regressors, gamma, initial_covariance)
    a, b = (0.0, float("inf")) if limits is None else limits
    a = real("limits[0]", a, 0.0, float("inf"))
    b = real("limits[1]", b, 0.0, float("inf"), open_low=True)
    condition, found = _excitation(trajectory, window, threshold)
    first = (
        Condition("A1", "F >= 0", *proper(trajectory)),
        Condition("A2", "P̄ <= b I", *upper_bound(trajectory, b)),
        Condition("A3", "P >= a I", *lower_bound(trajectory, a)),
        condition,
    )
    rest = disturbances(trajectory, true_theta, measurement_noise, regressor_noise)
    return Conditions(first + tuple(Condition(*item) for item in rest), found, trajectory)


def _excitation(
    trajectory: Trajectory, window: int | None, threshold: float | None
) -> tuple[Condition, int | None]:
    """A4, with the window asked for or the shortest that serves."""
    statement = "persistent excitation"
    beta = sample_bound(trajectory.phibar)
    if window is None:
        window = persistency_window(trajectory.phibar, threshold=threshold)
    else:
        window = whole("window", window, 1, trajectory.samples)
    if window is None:
        return _no_window(trajectory, statement, beta, threshold), None
    values = window_eigenvalues(trajectory.phibar, window)
    if threshold is None:
        threshold = RELATIVE_THRESHOLD * float(values.max())
    alpha = float(values[:, 0].min())
    found = {"alpha": alpha, "beta": beta, "window": float(window)}
    failing = first_failure(values[:, 0], threshold)
    if failing is None:
        reason = f"alpha = {alpha:.4g}, beta = {beta:.4g} over every {window} samples"
        return Condition("A4", statement, "holds", found, None, reason), window
    start = trajectory.first + failing
    reason = f"the {window} samples from {start} on leave a direction without information"
    return Condition("A4", statement, "fails", found, start, reason), window


def _no_window(
    trajectory: Trajectory, statement: str, beta: float, threshold: float | None
) -> Condition:
    """No window up to half the record excites every direction all along it."""
    values = window_eigenvalues(trajectory.phibar, trajectory.samples)[0]
    limit = RELATIVE_THRESHOLD * values[-1] if threshold is None else threshold
    excited = int((values > limit).sum())
    found = {"beta": beta}
    if excited < trajectory.parameters:
        reason = f"the whole record informs about {excited} of {trajectory.parameters} directions"
        return Condition("A4", statement, "fails", found, trajectory.first, reason)
    reason = "no window up to half the record excites every direction; a longer record may"
    return Condition("A4", statement, "not decidable", found, None, reason)
