"""How long a step in time may be before it is a gap."""

from __future__ import annotations

import math
import warnings

import pandas as pd

from forgetting.words.duration import seconds_of
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
        seconds = seconds_of(text)
    except (ValueError, OverflowError):
        seconds = by_pandas(str(text))
    if not seconds > 0:
        raise RecordError(
            f"gap is {text!r}; it must be a duration above zero such as 5min, 2h or 0.5 (seconds), "
            "or none for no gap however long"
        )
    return seconds


def by_pandas(text: str) -> float:
    """Seconds of what only pandas reads, such as 00:05:00 or PT5M; NaN of anything else."""
    try:
        with warnings.catch_warnings():
            # of spellings that pandas will give up
            warnings.simplefilter("ignore")
            return float(pd.Timedelta(text).total_seconds())
    except (ValueError, OverflowError):
        return math.nan
