"""Forgetting by the clock of a record: a half-life in the place of a forgetting factor."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

import forgetting as fg
from forgetting.record.samples import Samples
from forgetting.words.duration import seconds_of
from forgetting.words.errors import RecordError

Array = NDArray[np.float64]


def with_time(
    rule: Any, half_life: Any, by_clock: bool, samples: Samples
) -> tuple[Any, Array | None]:
    """The rule with a half-life, if any, and the times of the samples where these count.

    Parameters
    ----------
    rule : str or Rule
        With a half-life one that has a forgetting factor, which the half-life replaces.
    half_life : float, str or duration, or None
        A number counts samples; "10min" or a duration counts by the clock of the record.
    by_clock : bool
        Whether what counts samples counts usual steps of the clock.
    samples : Samples
        The samples that the rule is to be run over.

    Returns
    -------
    rule : Rule
    time : ndarray, shape (T,), or None
        Seconds where the half-life is in time, else usual steps; None where samples count.

    Raises
    ------
    RecordError
        When the rule has no forgetting factor, or the record no clock.
    """
    if half_life is not None:
        rule = rule_for(rule, half_life)
        if not counts(half_life):
            return rule, seconds_in(samples, "a half-life in time")
    if not by_clock:
        return rule, None
    time = seconds_in(samples, "by_clock")
    return rule, whole_steps(time / (samples.usual_step or 1.0))


def whole_steps(steps: Array) -> Array:
    """Times in usual steps, whole where only the rounding of the time stamps keeps them from it.

    The usual step is the difference of two stamps, and off by as much as a late one is rounded.
    """
    near = np.rint(steps)
    late = steps[-1] if len(steps) else 0.0
    rounding = 4.0 * np.finfo(float).eps * late * np.maximum(steps, 1.0)
    return np.where(np.abs(steps - near) <= np.minimum(rounding, 1e-3), near, steps)


def rule_for(rule: Any, half_life: Any) -> Any:
    """The rule with this half-life in the place of its forgetting factor.

    Raises
    ------
    RecordError
        When it has none, or the half-life is no length of time.
    """
    try:
        seconds = seconds_of(half_life)
    except ValueError as error:
        raise RecordError(f"half_life is {half_life!r}: {error}") from None
    rule = fg.rule(rule) if isinstance(rule, str) and rule != "auto" else rule
    if isinstance(rule, str) or not rule.about["forgetting_factor"]:
        name = rule if isinstance(rule, str) else rule.name
        raise RecordError(f"a half-life goes with a rule that has a forgetting factor, not {name}")
    own = {name: value for name, value in rule.parameters.items() if name != "factors"}
    return type(rule)(half_life=seconds, **own)


def counts(half_life: Any) -> bool:
    """Whether it is a bare number, of samples."""
    try:
        float(half_life)
    except (TypeError, ValueError):
        return False
    return True


def seconds_in(samples: Samples, what: str) -> Array:
    """When each sample was taken; a step back, or from or to a missing time, takes no time."""
    if samples.clock is None:
        advice = "; a number counts samples" if what != "by_clock" else ""
        raise RecordError(f"{what} needs a clock, and {samples.source} has none{advice}")
    steps = np.nan_to_num(samples.clock.steps, nan=0.0)
    return np.concatenate([[0.0], np.cumsum(np.maximum(steps, 0.0))])


class LastTime:
    """When the last complete sample was, between runs over parts of a record.

    What went by since then is forgotten at the next complete sample, wherever a part ends.
    """

    def __init__(self, when: float | None = None) -> None:
        self.when = when

    def ahead_of(self, time: Array) -> Array:
        """The times of a part as a run takes them, with that of the last complete sample first."""
        return time if self.when is None else np.concatenate([[self.when], time])

    def note(self, time: Array, complete: NDArray[np.bool_]) -> None:
        """Go behind a part."""
        if complete.any():
            self.when = float(time[complete][-1])
