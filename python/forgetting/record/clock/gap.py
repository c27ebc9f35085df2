"""How long a step in time may be before it is a gap."""

from __future__ import annotations

import math

import pandas as pd

from forgetting.words.errors import RecordError


def gap_of(text: str | float | None) -> float | None:
    """Seconds of a text such as "5min"; infinity for "none", None when nothing is said.

    Raises
    ------
    RecordError
        When it is no duration above zero.

    Examples
    --------
    >>> gap_of("5min"), gap_of("1.5"), gap_of("none"), gap_of(None)
    (300.0, 1.5, inf, None)
    """
    if text is None:
        return None
    if isinstance(text, str) and text.strip().lower() == "none":
        return math.inf
    try:
        seconds = float(text)
    except ValueError:
        try:
            seconds = pd.Timedelta(str(text)).total_seconds()
        except (ValueError, OverflowError):
            seconds = math.nan
    if not seconds > 0:
        raise RecordError(
            f"gap is {text!r}; it must be a duration above zero such as 5min, 2h or 0.5 (seconds), "
            "or none for no gap however long"
        )
    return seconds
