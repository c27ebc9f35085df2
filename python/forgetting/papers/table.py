"""The table of claims: counted, and as CSV."""

from __future__ import annotations

import csv
from collections import Counter
from collections.abc import Sequence
from dataclasses import astuple, fields
from pathlib import Path
from typing import get_args

from forgetting.files import whole

from .claim import Claim, Verdict


def summary(claims: Sequence[Claim]) -> str:
    """How many of each, and how many do not hold."""
    count = Counter[str](claim.verdict for claim in claims)
    words = ", ".join(f"{count[name]} {name}" for name in get_args(Verdict) if count[name])
    failed = sum(not claim.holds for claim in claims)
    return f"{len(claims)} claims: {words}; {failed or 'none'} fail{'s' if failed == 1 else ''}"


def write_csv(claims: Sequence[Claim], path: Path) -> None:
    """One row a claim, one column a field."""
    with whole(path) as made, made.open("w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream)
        writer.writerow([field.name for field in fields(Claim)])
        writer.writerows(astuple(claim) for claim in claims)
