"""What reading a record found out about it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any


@dataclass(frozen=True)
class Found:
    """How a record was read.

    Attributes
    ----------
    path : Path or None
        The file or folder; None for standard input and data in memory.
    format : str
        Such as "delimited text", "Parquet" or "data frame".
    details : mapping of str to str
        What was recognised, such as separator, decimal sign and encoding.
    units : mapping of str to str
        Units of columns, as the file has them.
    skipped : tuple of str
        What is not in the table, and what was taken for a missing value, in words.
    """

    path: Path | None = None
    format: str = "data frame"
    details: Mapping[str, str] = field(default_factory=dict)
    units: Mapping[str, str] = field(default_factory=dict)
    skipped: tuple[str, ...] = ()

    def to_dict(self) -> dict[str, Any]:
        """As JSON shows it."""
        return {
            "format": self.format,
            **self.details,
            "units": dict(self.units),
            "skipped": list(self.skipped),
        }

    def words(self) -> str:
        """Format and what was recognised, in one line."""
        return ", ".join([self.format, *(f"{key} {value}" for key, value in self.details.items())])

    def names_with_units(self, limit: int = 12) -> str:
        """Columns that have a unit, with it."""
        shown = [f"{name} [{unit}]" for name, unit in list(self.units.items())[:limit]]
        more = len(self.units) - len(shown)
        return ", ".join(shown) + (f" and {more} more" if more else "")
