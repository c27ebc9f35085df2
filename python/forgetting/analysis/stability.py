"""Theorem 2 of Lai and Bernstein: what follows for the error from the conditions that hold.

The statements are about the error θ̃ without noise and with fixed parameters. The
conditions are sufficient: where one fails the conclusion does not follow, which is not to
say that its opposite does.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any, Literal

import numpy as np

from .conditions import Conditions
from .lyapunov import lyapunov_decrease, observed_decrease
from .validation import Array

Outcome = Literal["follows", "does not follow", "not decidable"]

#: Conclusion, conditions it needs, and what it means.
CONCLUSIONS = (
    (
        "Lyapunov stable",
        ("A1", "A2"),
        "an error that starts small stays small",
    ),
    (
        "uniformly Lyapunov stable",
        ("A1", "A2", "A3"),
        "and how small does not depend on when it starts",
    ),
    (
        "globally asymptotically stable",
        ("A1", "A2", "A4"),
        "the error goes to zero from any start",
    ),
    (
        "globally uniformly exponentially stable",
        ("A1", "A2", "A3", "A4"),
        "the error goes to zero geometrically, at a rate that does not depend on when it starts",
    ),
)


@dataclass(frozen=True)
class Conclusion:
    """One statement of Theorem 2."""

    name: str
    needs: tuple[str, ...]
    outcome: Outcome
    reason: str
    meaning: str

    def __str__(self) -> str:
        """One sentence."""
        if self.outcome == "follows":
            return f"The error is {self.name}: {self.meaning} ({self.reason})."
        return f"That the error is {self.name} {_negated(self.outcome)} ({self.reason})."

    def to_dict(self) -> dict[str, Any]:
        """Return the fields, ready for JSON."""
        return {"needs": list(self.needs), "outcome": self.outcome, "reason": self.reason}


@dataclass(frozen=True, eq=False)
class Stability:
    """Conclusions of Theorem 2 for a record. See `stability`.

    Attributes
    ----------
    conclusions : tuple of Conclusion
        Statements 1) to 4).
    decrease : float or None
        c_N of eq. (125), 1/θ²; None where A1, A2 or A4 does not hold.
    contraction : float or None
        Factor by which √V shrinks at least over N samples, √(1 - a c_N); needs A3 too.
    observed : (T - N + 1,) or None
        Smallest eigenvalue of Δ^N V_k seen, never under `decrease`.
    window : int or None
        N.
    """

    conclusions: tuple[Conclusion, ...]
    decrease: float | None
    contraction: float | None
    observed: Array | None = field(repr=False)
    window: int | None

    def __getitem__(self, name: str) -> Conclusion:
        """Return the conclusion called `name`."""
        return next(item for item in self.conclusions if item.name == name)

    def __str__(self) -> str:
        """The conclusions, a sentence a line, and the decrease."""
        lines = [str(item) for item in self.conclusions]
        if self.decrease is not None and self.observed is not None:
            lines.append(
                f"Over any {self.window} samples V = θ̃ᵀP⁻¹θ̃ falls by at least "
                f"c_N = {self.decrease:.3g} ‖θ̃‖² (seen: at least {self.observed.min():.3g} ‖θ̃‖²)."
            )
        return "\n".join(lines)

    def to_dict(self) -> dict[str, Any]:
        """Return the scalars, ready for JSON."""
        seen = None if self.observed is None else float(self.observed.min())
        return {
            "conclusions": {item.name: item.to_dict() for item in self.conclusions},
            "lyapunov_decrease": self.decrease,
            "observed_decrease": seen,
            "contraction": self.contraction,
            "window": self.window,
        }


def stability(found: Conditions) -> Stability:
    """Say which of the four conclusions of Theorem 2 follow from the conditions.

    Parameters
    ----------
    found : Conditions
        From `conditions`.

    Returns
    -------
    Stability

    Notes
    -----
    Source: Lai and Bernstein, Theorem 2. A conclusion "follows" for the record at hand; it
    carries over to what comes next as far as the constants do.

    Examples
    --------
    >>> import numpy as np
    >>> from forgetting.analysis import Trajectory, conditions
    >>> trajectory = Trajectory.from_arrays(np.ones((40, 1)), np.full((41, 1, 1), 0.5))
    >>> print(stability(conditions(trajectory)).conclusions[0])
    The error is Lyapunov stable: an error that starts small stays small (A1, A2 hold).
    """
    conclusions = tuple(_conclude(found, *item) for item in CONCLUSIONS)
    if conclusions[2].outcome != "follows" or found.window is None:
        return Stability(conclusions, None, None, None, found.window)
    known = found.constants
    decrease = lyapunov_decrease(known["alpha"], known["beta"], known["b"], found.window)
    contraction = None
    if conclusions[3].outcome == "follows":
        contraction = math.sqrt(max(0.0, 1 - known["a"] * decrease))
    try:
        observed: Array | None = observed_decrease(found.trajectory, found.window)
    except np.linalg.LinAlgError:  # a P that rounding left indefinite
        observed = None
    return Stability(conclusions, decrease, contraction, observed, found.window)


def _conclude(found: Conditions, name: str, needs: tuple[str, ...], meaning: str) -> Conclusion:
    verdicts = {need: found[need].verdict for need in needs}
    failing = [need for need, verdict in verdicts.items() if verdict == "fails"]
    open_ = [need for need, verdict in verdicts.items() if verdict == "not decidable"]
    if failing:
        return Conclusion(name, needs, "does not follow", f"{_list(failing)} fail", meaning)
    if open_:
        reason = f"{_list(open_)} cannot be decided from this record"
        return Conclusion(name, needs, "not decidable", reason, meaning)
    return Conclusion(name, needs, "follows", f"{_list(list(needs))} hold", meaning)


def _list(names: list[str]) -> str:
    return ", ".join(names)


def _negated(outcome: Outcome) -> str:
    return "does not follow" if outcome == "does not follow" else "cannot be decided"
