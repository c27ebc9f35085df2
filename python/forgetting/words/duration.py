"""Lengths of time as people write them."""

from __future__ import annotations

import re
from datetime import timedelta
from typing import Any

from forgetting.words.rounding import brief

SECONDS = {
    "ns": 1e-9,
    "us": 1e-6,
    "µs": 1e-6,
    "μs": 1e-6,
    "ms": 1e-3,
    "msec": 1e-3,
    "s": 1.0,
    "sec": 1.0,
    "secs": 1.0,
    "second": 1.0,
    "seconds": 1.0,
    "sek": 1.0,
    "min": 60.0,
    "mins": 60.0,
    "minute": 60.0,
    "minutes": 60.0,
    "h": 3600.0,
    "hr": 3600.0,
    "hrs": 3600.0,
    "hour": 3600.0,
    "hours": 3600.0,
    "std": 3600.0,
    "d": 86400.0,
    "day": 86400.0,
    "days": 86400.0,
}
"""Units of time by all their names."""

PART = re.compile(r"\s*(\d+\.?\d*|\.\d+)\s*([^\W\d_]+)\s*")


def seconds_of(duration: Any) -> float:
    """Seconds of a text such as "10min" or "1h 30min", or of a duration of Python or NumPy.

    A number is left as it is: its unit is whatever it is used with.

    Raises
    ------
    ValueError
        For what is none of these.

    Examples
    --------
    >>> seconds_of("10min"), seconds_of("1h 30 min"), seconds_of(timedelta(days=1)), seconds_of(20)
    (600.0, 5400.0, 86400.0, 20.0)
    """
    if isinstance(duration, timedelta):
        return duration.total_seconds()
    if isinstance(duration, str):
        return _of_text(duration)
    if hasattr(duration, "dtype") and duration.dtype.kind == "m":
        return float(duration / type(duration)(1, "s"))
    try:
        return float(duration)
    except TypeError:
        raise ValueError(f"{duration!r} is no length of time") from None


def _of_text(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        parts = [(float(part[1]), SECONDS.get(part[2].lower())) for part in PART.finditer(text)]
    units = [unit for _, unit in parts if unit is not None]
    if not parts or len(units) < len(parts) or PART.sub("", text):
        raise ValueError(f"{text!r} is no length of time such as 10min, 2h or 1.5 d")
    return sum(number * unit for (number, _), unit in zip(parts, units, strict=True))


def spoken(seconds: float) -> str:
    """A length of time in the unit in which a person would say it.

    Examples
    --------
    >>> spoken(0.004), spoken(12.34), spoken(5400), spoken(200000), spoken(6.4e7)
    ('4 ms', '12 s', '1.5 h', '2.3 days', '740 days')
    """
    size, unit = unit_for(seconds)
    two_digits = float(f"{seconds / size:.2g}")
    return f"{brief(two_digits)} {unit}"


def unit_for(seconds: float) -> tuple[float, str]:
    """Seconds of the unit in which to say a length of time, and the unit."""
    for size, unit in ((86400.0, "days"), (3600.0, "h"), (60.0, "min"), (1.0, "s"), (1e-3, "ms")):
        if seconds >= (1.5 if size > 1 else 1.0) * size:
            return size, unit
    return 1e-6, "µs"
