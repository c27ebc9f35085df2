"""When not to use a rule, from what its registry entry guarantees."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

SILENT = (
    "Not where the input may fall silent, in all directions or in one: "
    "nothing bounds P from above there."
)
ASLEEP = (
    "Not where parameters keep changing and samples keep coming: nothing bounds P from below, and "
    "what has become too sure no longer follows."
)
CLAIMS = (
    "Not where an estimate must never move away from fixed parameters: information is added that "
    "no sample brought."
)
CUBIC = "Not for many parameters at a high rate: a sample costs O(n³)."
ONE_ROW = "Not with several rows: it takes one."


def when_not(axis: str, about: Mapping[str, Any]) -> Iterator[str]:
    """Sentences for a rule; other choices give no guarantees of this kind."""
    if axis != "rule":
        return
    if about["bounded_above"] == "no":
        yield SILENT
    if about["bounded_below"] == "no":
        yield ASLEEP
    if about["proper"] == "no":
        yield CLAIMS
    if about["largest_rows"] == 1:
        yield ONE_ROW
    if about["cost"].startswith(("O(n^3)", "O(p n^3)")):
        yield CUBIC
