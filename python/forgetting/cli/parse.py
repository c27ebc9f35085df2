"""Texts of options that hold several numbers."""

from __future__ import annotations

from typing import Any

import numpy as np

from forgetting.words.errors import RecordError


def parse_orders(text: str) -> list[int]:
    """Read na,nb,nk."""
    try:
        return [int(part) for part in text.split(",")]
    except ValueError:
        raise RecordError(
            f"--arx takes three whole numbers na,nb,nk such as 1,2,0, but got {text!r}"
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
