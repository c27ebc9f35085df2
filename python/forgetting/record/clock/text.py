"""Text as time: dates in any common order, times of day, elapsed hours, minutes and seconds."""

from __future__ import annotations

import re
import warnings
from collections.abc import Callable
from typing import Any

import numpy as np
import pandas as pd

from forgetting.record.clock.times import Times

HMS = re.compile(r"[+-]?(\d+\s*d(ays?)?,?\s*)?\d+:\d{1,2}(:\d{1,2}([.,]\d*)?|[.,]\d+)?$")
SPAN = re.compile(r".*\d\s+[-–]\s+\d.*\d$")
TWELVE = re.compile(r"\d{1,2}:\d{2}(:\d{2}([.,]\d*)?)?\s*[AaPp]\.?[Mm]\.?$")
ZONE = r"\s+\(?(?:UTC|GMT|[A-Z]{2,4}T|[A-Z]{3,4})\)?$"
LOST = 0.1
"""Share of the stamps that may be unreadable; those rows have no time."""
ORDER = r"^(\d{1,2})[-/. ](\d{1,2})[-/. ]\d{2,4}"
YEAR_FIRST = r"^\d{4}[-/. ]\d{1,2}[-/. ]\d"
LONGEST = 100
"""Characters of a stamp or of a stretch of time; the time to parse one grows with their square."""


def from_text(column: pd.Series) -> Times | None:
    """Read text as time, or None where a cell is none.

    One format holds for the whole column: whether day or month comes first is decided over all of
    its cells.
    """
    text = column.astype("string").str.strip()
    text = text.mask(text == "")
    known = text.dropna()
    if known.empty or known.str.len().max() > LONGEST:
        return None
    first = str(known.iloc[0])
    if SPAN.match(first):
        # A stretch of time such as "01.01.2024 00:00 - 01.01.2024 00:15" is known by its begin.
        return from_text(text.str.replace(r"\s+[-–]\s+.*", "", regex=True))
    if HMS.match(first):
        return of_day(text)
    if TWELVE.match(first):
        parsed = attempt(lambda: pd.to_datetime("2000-01-01 " + text, format="mixed"))
        return None if parsed is None else Times(since_midnight(parsed), "times of day", 1.0, True)
    if re.search(ZONE, first) and known.str.contains(ZONE).all():
        text = text.str.replace(ZONE, "", regex=True)
    return iso(text) or by_order(text)


def iso(text: pd.Series) -> Times | None:
    """Date-times of ISO 8601; those with changing offsets become UTC."""
    parsed = attempt(lambda: pd.to_datetime(text, format="ISO8601"))
    if parsed is not None:
        return Times(parsed, "date-times")
    parsed = attempt(lambda: pd.to_datetime(text, format="ISO8601", utc=True))
    if parsed is not None:
        return Times(parsed, "date-times, shown in UTC")
    parsed = attempt(lambda: pd.to_datetime(text, format="ISO8601", errors="coerce"))
    lost = 0 if parsed is None else int(parsed.isna().sum() - text.isna().sum())
    if parsed is None or lost > LOST * text.notna().sum():
        return None
    return Times(parsed, f"date-times, {lost} of them unreadable")


def by_order(text: pd.Series) -> Times | None:
    """Dates that are not ISO: the order of day and month that every cell allows."""
    orders, certain = possible(text)
    found = [(order, parsed) for order in orders if (parsed := dates(text, order)) is not None]
    if not found:
        return None
    irregular = [irregularity(parsed) for _, parsed in found]
    best = int(np.argmin(irregular))
    order, parsed = found[best]
    if not text.dropna().str.match(ORDER).all():
        return Times(parsed, "date-times")
    side = "day first" if order else "month first"
    if not certain and len(found) > 1:
        equal = irregular[0] == irregular[-1]
        side += ", though the dates allow both" if equal else ", as the steps are then regular"
    return Times(parsed, f"date-times, {side}")


def possible(text: pd.Series) -> tuple[tuple[bool, ...], bool]:
    """Whether the day may come first, in order of preference, and whether that is certain."""
    if text.dropna().str.match(YEAR_FIRST).any():
        # Nobody writes year, day, month; pandas reads it so where the day may come first.
        return (False,), True
    parts = text.dropna().str.extract(ORDER).astype("float64").max()
    if parts[0] > 12:
        return (True,), True
    if parts[1] > 12:
        return (False,), True
    # Slashes are at home where the month comes first, points and dashes where the day does.
    slashes = bool(text.dropna().str.contains("/").any())
    return (False, True) if slashes else (True, False), False


def dates(text: pd.Series, day_first: bool) -> pd.Series | None:
    """Parse with the day or the month first; a time of day may be absent or be 24:00."""
    parsed = attempt(lambda: pd.to_datetime(text, dayfirst=day_first))
    if parsed is not None:
        return parsed
    pieces = text.str.extract(r"^(\S+?)[ T]+(\d{1,2}:\S+)$")
    date = pieces[0].fillna(text)
    parsed = attempt(lambda: pd.to_datetime(date, dayfirst=day_first))
    if parsed is None:
        return attempt(lambda: pd.to_datetime(text, dayfirst=day_first, format="mixed"))
    time = durations(pieces[1].fillna("0:00").mask(text.isna()))
    return None if time is None else attempt(lambda: parsed + time)


def irregularity(times: pd.Series) -> int:
    """Steps that are longer than usual or do not go on."""
    steps = times.dropna().diff().iloc[1:].dt.total_seconds()
    forward = steps[steps > 0]
    limit = 1.5 * forward.median() if len(forward) else np.inf
    return int((steps <= 0).sum() + (steps > limit).sum())


def of_day(text: pd.Series) -> Times | None:
    """Hours, minutes and seconds: of a day where none is beyond 24 h, else elapsed."""
    parsed = durations(text)
    if parsed is None:
        return None
    seconds = parsed.dt.total_seconds()
    within = bool((seconds.dropna().between(0, 86400, inclusive="left")).all())
    kind = "hours, minutes and seconds"
    return Times(seconds, kind, 1.0, within)


def durations(text: pd.Series) -> pd.Series | None:
    """Time spans of ``h:mm:ss``, ``d days h:mm:ss``, ``h:mm`` or ``mm:ss.f``."""
    plain = text.str.replace(",", ".", regex=False).str.replace(
        r"\.?\s*d(?:ays?)?\.?\s*", " days ", regex=True
    )
    two = plain.str.fullmatch(r"[+-]?\d+:\d{1,2}").fillna(False)
    plain = plain.mask(two, plain + ":00")
    plain = plain.str.replace(r"^([+-]?)(\d+:\d{1,2}\.\d+)$", r"\g<1>0:\2", regex=True)
    return attempt(lambda: pd.to_timedelta(plain))


def since_midnight(times: pd.Series) -> pd.Series:
    """Seconds of the day."""
    seconds: pd.Series = (times - times.dt.normalize()).dt.total_seconds()
    return seconds


def attempt(parse: Callable[[], Any]) -> pd.Series | None:
    """What a parser gives, or None where a cell does not fit."""
    try:
        with warnings.catch_warnings():
            # pandas only warns when it gives up one format and guesses cell by cell.
            warnings.simplefilter("error")
            # Of this one it only tells, in a place from which no error comes back.
            warnings.filterwarnings("ignore", "Parsing dates in")
            parsed = parse()
    except (ValueError, TypeError, OverflowError, AttributeError, Warning):
        return None
    kinds = (pd.api.types.is_datetime64_any_dtype, pd.api.types.is_timedelta64_dtype)
    return parsed if any(each(parsed) for each in kinds) else None
