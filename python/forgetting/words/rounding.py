"""Numbers as a person would write them."""

from __future__ import annotations

import math


def brief(value: float, digits: int = 4) -> str:
    """Write with a few significant digits, no exponent while it can be avoided.

    Examples
    --------
    >>> brief(616.2345), brief(0.0123456), brief(1.5e9), brief(float("nan"))
    ('616.2', '0.01235', '1.5e+09', 'not known')
    """
    if math.isnan(value):
        return "not known"
    return f"{value:.{digits}g}".replace("-", "−")


def with_error(value: float, error: float) -> tuple[str, str]:
    """Round a value to the second digit of its standard error.

    Examples
    --------
    >>> with_error(3.14159, 0.0123)
    ('3.142', '0.012')
    >>> with_error(51234.5, 890.0)
    ('51230', '890')
    >>> with_error(0.474, 700.0)
    ('0.474', '700')
    """
    if not (math.isfinite(value) and math.isfinite(error)) or error <= 0:
        return brief(value, 6), brief(error, 2)
    digits = decimals(error, 2)
    # An error larger than the value must not round the value away.
    shown = max(digits, decimals(value, 3)) if value else digits
    if not -7 < digits < 7 or not -7 < shown < 9:
        return brief(value, 8), brief(error, 2)
    return fixed(value, shown), fixed(error, digits)


def decimals(value: float, significant: int) -> int:
    """Decimals that show so many significant digits; negative left of the point."""
    return significant - 1 - math.floor(math.log10(abs(value)))


def fixed(value: float, digits: int) -> str:
    """Round and write without exponent."""
    return f"{round(value, digits):.{max(digits, 0)}f}".replace("-", "−")


def with_unit(name: str, unit: str | None) -> str:
    """A name with its unit in brackets, if it has one.

    Examples
    --------
    >>> with_unit("current", "A"), with_unit("count", None)
    ('current [A]', 'count')
    """
    return f"{name} [{unit}]" if unit else name
