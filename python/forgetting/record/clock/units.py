"""Units of time: in a row of units, or behind a column's name."""

from __future__ import annotations

import re

from forgetting.words.duration import SECONDS

BEHIND = re.compile(
    r"([\[(/,]\s*(?P<marked>[^\W\d_]+)|[_ ](?P<short>ns|us|µs|μs|ms|s|sec|min|hr?))\s*[\])]?\s*$"
)
WORD = re.compile(r"[^\W\d_]+")
CAMEL = re.compile(r"(?<=[a-z])(?=[A-Z])")
TIME_WORDS = """
time times timestamp timestamps date dates datetime epoch elapsed unixtime yyyymmdd yyyymm caldt
zeit datum uhrzeit zeitstempel horodatage fecha hora tijd tijdstip
"""
OTHER_WORDS = "t utc gmt unix seconds secs millis year jahr month"
TIMES = frozenset(TIME_WORDS.split())
HINTS = TIMES | frozenset(OTHER_WORDS.split())


def unit_of(name: str, unit: str | None) -> str | None:
    """The unit of time that the file gives a column, or its name does; None without one.

    Examples
    --------
    >>> unit_of("Test Time / s", None), unit_of("t [ms]", None), unit_of("time_us", None)
    ('s', 'ms', 'us')
    >>> unit_of("voltage (V)", None), unit_of("time_of_day", None), unit_of("elapsed", "min")
    (None, None, 'min')
    """
    if unit is not None:
        return unit if unit.lower() in SECONDS else None
    found = BEHIND.search(name)
    own = (found["marked"] or found["short"]) if found else ""
    return own if own.lower() in SECONDS else None


def words(name: str) -> list[str]:
    """Words of a name in lower case.

    Examples
    --------
    >>> words("TestTime_s"), words("Date-Time (UTC)")
    (['test', 'time', 's'], ['date', 'time', 'utc'])
    """
    return [word.lower() for word in WORD.findall(CAMEL.sub(" ", name))]


def sounds_like_time(name: str) -> bool:
    """Whether a name has a word for time in it; "timer" and "lifetime" are other words."""
    if re.search(r"\bT\b", name):
        # A temperature.
        return False
    own = words(name)
    return bool(HINTS & set(own)) or any(word.endswith("zeit") for word in own)


def is_named_time(name: str) -> bool:
    """Whether the name begins with a word that means time and little else."""
    own = words(name)
    return bool(own) and own[0] in TIMES
