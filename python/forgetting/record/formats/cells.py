"""What the text of one cell can be: a number, a time, a missing value, a unit."""

from __future__ import annotations

import re

NUMBER = re.compile(
    r"[+\-−]?(\d+([.,]\d*)?|[.,]\d+|\d{1,3}([.,'  \u202f]\d{3})+([.,]\d+)?)([eE][+-]?\d+)?$"
)
COMMA = re.compile(
    r"[+\-−]?(\d*,(?!\d{3}$)\d*|0,\d*|\d{1,3}([.'  \u202f]\d{3})+,\d*)([eE][+-]?\d+)?$"
)
"""Only a decimal comma makes sense of it; 1,234 could also be a thousand and more."""
POINT = re.compile(
    r"[+\-−]?(\d*\.(?!\d{3}$)\d*|0\.\d*|\d{1,3}([,'  \u202f]\d{3})+\.\d*)([eE][+-]?\d+)?$"
)
THOUSANDS = re.compile(r"[+\-−]?[1-9]\d{0,2}([.,'  \u202f])\d{3}(\1\d{3})*(?!\1)([.,]\d*)?$")

TIME = re.compile(
    r"""( \d{1,4}[-/.]\d{1,2}[-/.]\d{1,4}\.?([ T].*)?      # 16/12/2006 17:24
        | \d{1,2}[- ./]?[^\W\d_]{3,9}[-\ .,/]*\d{2,4}\b.*  # 5-Jan-2024
        | [^\W\d_]{3,9}\.?\ \d{1,2},?\ \d{4}\b.*           # Jan 5, 2024
        | \d{8}T\d{4,6}.*                                  # 20240105T1030
        | (\d+\s*d(ays?)?,?\s*)?[+-]?\d+:\d{1,2}(:\d{1,2}([.,]\d*)?|[.,]\d+)?(\s*[AaPp]\.?[Mm]\.?)?
        )$""",
    re.VERBOSE,
)

NO_VALUE = """
? - -- --- ---- * ** *** . .. … na n/a #n/a #na nan -nan +nan null nil none <na>
nodata no_data missing error err err. #value! #div/0! #ref! #num! #name? #null! -.- --.- ---.-
1.#qnan -1.#ind 1.#ind 1.#snan ice eqp bkw ssn mnt unavailable offline
"""
MISSING = frozenset(NO_VALUE.split()) | {"", "no data", "not available", "no value", "- -"}
"""Words that stand for a missing value in a column of numbers, in lower case."""

SYMBOL = (
    r"(d[aB]|[yzafpnuµμmcdhkMGTPE])?"
    r"(m|s|g|A|K|mol|cd|Hz|N|Pa|J|W|C|V|F|Ω|Ohm|ohm|S|T|H|lm|lx|Bq|Gy|L|l|bar|eV|Ah|Wh|VA|VAr|var|B|"
    r"bit|rad|sr|t)"
)
WORD = (
    r"°|deg|°[CFR]|degC|degF|degree|degrees|%|percent|‰|ppm|ppb|psi|mmHg|mmH2O|inHg|bits?|G|dBm|"
    r"min|minutes?|hr?|hours?|days?|d|sec|seconds?|[Ss]equence|mph|kph|kmh|knots?|kt|in|ft|lb|lbs|gal|"
    r"rpm|RPM|[Vv]olts?|[Aa]mps?|[Ww]atts?|counts?|V vs\.? .*|1|[-–]|a\.?u\.?|m³|m²"
)
FACTOR = rf"({SYMBOL}|{WORD})([\^*]*[-−]?\d+|[²³⁻¹]+)?"
UNIT = re.compile(rf"({FACTOR})([\s·*./]+({FACTOR}))*$")
BRACKETED = re.compile(r"[\[(<{].*[\])>}]$")
REMARK = re.compile(r"(#|TS|RN|Smp|Avg|Max|Min|Tot|Std|WVc|\d+[sdnN]|float|double|int|datetime)$")
"""What loggers write between names and numbers besides units: how a column was made."""


def is_number(cell: str) -> bool:
    """Whether the cell is a number, with a decimal point or comma."""
    return NUMBER.match(cell) is not None


def is_time(cell: str) -> bool:
    """Whether the cell looks like a date, a time of day or both."""
    return TIME.match(cell) is not None


def is_missing(cell: str) -> bool:
    """Whether the cell says that there is no value."""
    return cell.strip().lower() in MISSING


def kind(cell: str) -> str:
    """Kind of a cell: "number", "time", "missing" or "text"."""
    if is_missing(cell):
        return "missing"
    if is_number(cell):
        return "number"
    return "time" if is_time(cell) else "text"


def is_unit(cell: str) -> bool:
    """Whether the cell can stand in a row of units.

    Examples
    --------
    >>> [is_unit(cell) for cell in ("m/s", "[V]", "kPa", "°C", "Smp", "current", "I")]
    [True, True, True, True, True, False, False]
    """
    matches = BRACKETED.match(cell) or UNIT.match(cell) or REMARK.match(cell)
    return matches is not None


def bare(cell: str) -> str:
    """A unit without its brackets; nothing where the cell is a remark."""
    inner = cell[1:-1].strip() if BRACKETED.match(cell) else cell
    return "" if REMARK.match(inner) or inner in ("-", "–", "1") else inner


def bare_number(value: float) -> str:
    """A float as text, whole numbers without a point.

    Examples
    --------
    >>> bare_number(20240105.0), bare_number(0.5)
    ('20240105', '0.5')
    """
    return str(int(value)) if value.is_integer() else repr(value)
