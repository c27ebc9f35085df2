"""Texts of options that hold several numbers."""

from __future__ import annotations

import re
from typing import Any

import numpy as np

from forgetting.models.orders import Each, from_text
from forgetting.words.errors import RecordError

NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
KNOWN = {
    "bounds": (rf"(?P<first>{NUMBER})?:(?P<second>{NUMBER})?", "R0=0:,a=-1:1"),
    "fixed": (rf"(?P<first>{NUMBER})(?P<second>)", "b=2.5"),
    "prior": (rf"(?P<first>{NUMBER})\+-(?P<second>{NUMBER})", "R0=0.05+-0.02"),
}
"""How a value is written in each option, and an example."""


def parse_orders(text: str) -> list[Each]:
    """Read na,nb,nk.

    Examples
    --------
    >>> parse_orders("1,2/1,0")
    [1, (2, 1), 0]
    """
    found = [from_text(part.strip()) for part in text.split(",")]
    orders: list[Each] = [order for order in found if order is not None]
    if len(orders) < len(found):
        raise RecordError(
            "--arx takes three whole numbers na,nb,nk such as 1,2,0, or 1,2/1,0 for two inputs of "
            f"different orders, but got {text!r}"
        )
    return orders


def parse_steps(text: str | None) -> list[int] | None:
    """Read how many samples ahead, with commas; None where nothing is said."""
    try:
        return None if text is None else [int(part) for part in text.split(",")]
    except ValueError:
        raise RecordError(
            f"--ahead takes whole numbers with commas such as 1,24, but got {text!r}"
        ) from None


def parse_covariance(text: str) -> Any:
    """Read one number, or the diagonal with commas; None for auto."""
    if text == "auto":
        return None
    try:
        values = [float(part) for part in text.split(",")]
    except ValueError:
        raise RecordError(
            f"--initial-covariance takes auto, a number, or numbers with commas, but got {text!r}"
        ) from None
    return values[0] if len(values) == 1 else np.array(values)


def parse_known(option: str, text: str | None) -> dict[str, Any]:
    """Read what is known of parameters, each by its name, which may have commas itself.

    Examples
    --------
    >>> parse_known("bounds", "lag(x, 1)=0:,a=-1:1")
    {'lag(x, 1)': (0.0, None), 'a': (-1.0, 1.0)}
    >>> parse_known("fixed", "b=2.5"), parse_known("prior", "R0=0.05+-0.02")
    ({'b': 2.5}, {'R0': (0.05, 0.02)})
    """
    value, example = KNOWN[option]
    entry = re.compile(rf"\s*(?P<name>.+?)\s*=\s*{value}\s*(?:,|$)")
    found: dict[str, Any] = {}
    at = 0
    while text is not None and (at < len(text) or not found):
        match = entry.match(text, at)
        if match is None:
            raise RecordError(
                f"--{option} takes names and values as in {example}, but got {text!r}"
            )
        if match["name"] in found:
            raise RecordError(f"--{option} names {match['name']!r} twice")
        pair = tuple(None if end in (None, "") else float(end) for end in match.group(2, 3))
        found[match["name"]] = pair[0] if option == "fixed" else pair
        at = match.end()
    return found
