"""A half-life by the clock in the place of a forgetting factor."""

from __future__ import annotations

from typing import Any

from forgetting._core import InvalidInput
from forgetting.choices import AXES


def with_half_life(rule: Any, half_life: Any) -> Any:
    """The rule that forgets half of what it knows in this time.

    Parameters
    ----------
    rule : str or Rule
        A rule that has a forgetting factor; the half-life takes its place.
    half_life : str, duration or float
        Such as "10min"; a number is in seconds, or in the unit of a time column of numbers.

    Raises
    ------
    forgetting.InvalidInput
        When the rule has no forgetting factor, or the half-life is no length of time.

    Examples
    --------
    >>> with_half_life("exponential", 1.0).forgetting_factor
    0.5
    """
    mixed = isinstance(rule, str) and rule == "auto"
    made = AXES["rule"].make(rule) if isinstance(rule, str) and not mixed else rule
    if made is None or mixed or not made.about["forgetting_factor"]:
        given = "no rule" if made is None else rule if mixed else made.name
        raise InvalidInput(
            f"half_life = {half_life!r} with {given}, allowed: a rule with a forgetting factor"
        )
    own = {name: value for name, value in made.parameters.items() if name != "factors"}
    return type(made)(half_life=half_life, **own)
