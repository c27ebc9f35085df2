"""Whether errors are as large as predicted, and whether simpler predictions are as good."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from .finding import Finding

Array = NDArray[np.float64]

DEVIATIONS = 2.0
NOMINAL = 0.9545
"""Share of a normal distribution within two standard deviations."""
FAIR = (0.90, 0.985)
"""Shares inside that are right enough."""
FAR = 0.75
"""Share inside below which intervals mislead."""
FEWEST = 50
"""Errors without which intervals are not judged."""
SHORT, LONG_ENOUGH = 2.0, 5.0
"""Samples remembered for each parameter: below the first the fit follows the output itself."""
CARRIED = 3.0
"""Times that the error is larger without forgetting from which on a short memory is no memory."""
GAIN = 0.01
"""Part of the error that an input must take away to be worth its place."""


def intervals(errors: Array, predicted: Array, of: str) -> Finding | None:
    """Judge how many errors are within two predicted standard deviations.

    Parameters
    ----------
    errors, predicted : ndarray, shape (T,)
        One-step errors and the standard deviations predicted for them; NaN where there is none.
    of : str
        Name of the output.
    """
    there = np.isfinite(errors) & np.isfinite(predicted)
    count = int(there.sum())
    if count < FEWEST:
        return None
    within = np.abs(errors) <= DEVIATIONS * predicted
    inside = int((within & there).sum()) / count
    chance = math.sqrt(NOMINAL * (1 - NOMINAL) / count)
    figure = (
        f"{inside:.1%} of the errors of {of} are within two predicted standard deviations "
        f"({NOMINAL:.1%} would be right)"
    )
    if FAIR[0] <= inside <= FAIR[1] or abs(inside - NOMINAL) < 3 * chance:
        return Finding("intervals", "good", f"Intervals hold: {figure}.")
    if inside > FAIR[1]:
        return Finding("intervals", "good", f"Intervals are wide: {figure}.")
    severity = "wrong" if inside < FAR else "warning"
    return Finding(
        "intervals",
        "wrong" if severity == "wrong" else "warning",
        f"Intervals are too narrow: {figure}.",
        "Take the printed ± for a lower bound; the noise changes or the model lacks something.",
    )


def memory(samples: float, parameters: int, gain: float = 1.0) -> Finding | None:
    """Judge on how many samples the estimate stands.

    Parameters
    ----------
    samples : float
        Of the memory; may be infinite.
    parameters : int
    gain : float
        How many times larger the error is without forgetting.
    """
    if not samples >= 0:
        return None
    long = f"{samples:.3g} samples" if math.isfinite(samples) else "all samples"
    figure = f"the estimate of {parameters} parameters stands on about {long}"
    if samples >= LONG_ENOUGH * parameters:
        return Finding("memory", "good", f"Long enough a memory: {figure}.")
    advice = "Add what moves the output to the model, or remember longer."
    if samples >= SHORT * parameters and not gain > CARRIED:
        return Finding("memory", "warning", f"The memory is short: {figure}.", advice)
    return Finding(
        "memory",
        "wrong",
        f"The model is wrong, and carried by forgetting: {figure}, and without forgetting its "
        f"error is {gain:.3g} times as large; it follows the output rather than explaining it.",
        advice,
    )


def too_few(used: int, parameters: int) -> Finding | None:
    """Say that a record is too short to judge."""
    if used >= LONG_ENOUGH * parameters:
        return None
    text = f"Only {used} samples were used for {parameters} parameters: little can be judged."
    return Finding("memory", "warning", text, "Record longer.")


def baselines(
    model: float, last_value: float, mean: float, without_inputs: float | None, of: str
) -> Finding | None:
    """Judge the root mean square error of one-step predictions beside simpler ones.

    Parameters
    ----------
    model, last_value, mean, without_inputs : float
        Of the model, of repeating the last value, of the mean so far, and of the same model without
        its inputs (None where it has none or nothing else).
    of : str
        Name of the output.
    """
    if not all(map(math.isfinite, (model, last_value, mean))):
        return None
    if model >= mean > 0:
        return Finding(
            "baselines",
            "wrong",
            f"The model is of no use: its one-step error of {of} is {model / mean:.3g} times that "
            f"of predicting the mean so far.",
            "Look for other inputs, or for a mistake in the record.",
        )
    if model >= last_value > 0:
        return Finding(
            "baselines",
            "warning",
            f"Repeating the last value of {of} is better: the model's one-step error is "
            f"{model / last_value:.3g} times as large.",
            "To predict, add past outputs; to learn a parameter, this may be right.",
        )
    if without_inputs is not None and model > (1 - GAIN) * without_inputs:
        return Finding(
            "baselines",
            "warning",
            f"The inputs bring nothing: without them the error of {of} is "
            f"{without_inputs / model:.3g} times as large.",
            "Check the input and its delay nk.",
        )
    ratio = f"{model / last_value:.3g}" if last_value > 0 else "not comparable"
    text = f"The one-step error of {of} is {ratio} times that of repeating the last value"
    if without_inputs is not None:
        text += f", {model / without_inputs:.3g} times that without inputs"
    return Finding("baselines", "good", f"{text}.")
