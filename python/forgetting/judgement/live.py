"""The same findings from what a monitor keeps while an estimator runs."""

from __future__ import annotations

import math

import numpy as np

from .finding import Finding, Judgement, judgement
from .residuals import FEWEST, OwnPast, whiteness

WINDUP = "Take a rule with a bounded covariance, or wait for excitation before using it."
WAIT = "Wait for excitation before using it."
OLD = "Use it as the last known value."


def live(status: str, sentence: str, correlation: float | None, weight: float) -> Judgement:
    """Judge an estimator by the status of its `Health`, which `sentence` explains.

    Parameters
    ----------
    status : {"ok", "unexcited", "recovering", "windup", "saturated"}
    sentence : str
    correlation : float or None
        Lag-one correlation of the normalized innovations.
    weight : float
        Number of samples behind it.
    """
    wound, silent = status in ("windup", "saturated"), status in ("windup", "unexcited")
    return judgement(
        [
            Finding("windup", "wrong", sentence, WINDUP)
            if wound
            else Finding("windup", "warning", sentence, WAIT)
            if status == "recovering"
            else Finding("windup", "good", "No windup: P did not grow without information."),
            Finding("excitation", "warning", sentence, OLD)
            if silent
            else Finding("excitation", "good", "All parameters are excited."),
            residuals(correlation, weight),
        ]
    )


def residuals(correlation: float | None, weight: float) -> Finding | None:
    """Judge innovations by their lag-one correlation over about `weight` samples."""
    if correlation is None or not math.isfinite(correlation) or weight < FEWEST:
        return None
    deviations = abs(correlation) * math.sqrt(weight)
    found = OwnPast(
        share=correlation**2,
        correlation=correlation,
        probability=math.erfc(deviations / math.sqrt(2)),
        samples=int(weight),
        prediction=np.array([correlation]),
    )
    return whiteness(found, "the output")
