"""From lines to rows: a whole block by Arrow, and what it refuses line by line.

Arrow reads a block in one go or not at all. A block that it refuses is cut in two until the lines
at fault stand nearly alone; these are read one by one, and only they are malformed.
"""

from __future__ import annotations

import json
import re
from collections.abc import Sequence
from contextlib import suppress
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.csv as arrow_csv
import pyarrow.json as arrow_json

from forgetting.record.formats import cells
from forgetting.record.formats.dialect import is_aside, split
from forgetting.record.missing import number_of
from forgetting.stream.form import Form
from forgetting.stream.rows import Array, Rows, joined, of_table
from forgetting.stream.stamps import Stamps

FEW = 12
"""Lines that are read one by one sooner than as a block."""
BLANK = re.compile(rb"^[ \t\r]*\n", re.MULTILINE)
NO_CELL = "\x1f"
"""A separator that no text has, for one column."""


class Parser:
    """Reads blocks of whole lines.

    Parameters
    ----------
    form : Form
    columns : sequence of str
        Those that the model uses.
    stamps : Stamps or None
        The time column.
    missing : sequence of str
        Words and numbers that stand for a missing value beside the usual ones.
    """

    def __init__(
        self, form: Form, columns: Sequence[str], stamps: Stamps | None, missing: Sequence[str]
    ) -> None:
        self.form, self.columns, self.stamps = form, tuple(columns), stamps
        self.words = cells.MISSING | {word.strip().lower() for word in missing}
        self.numbers = [each for each in map(number_of, missing) if each is not None]
        self.example = ""
        """The first malformed line since it was last taken, and what is wrong with it."""
        used = [*self.columns, *([stamps.name] if stamps else [])]
        self.types = {name: pa.float64() for name in used}
        if stamps is not None:
            self.types[stamps.name] = stamps.arrow
        self._prepare()

    def _prepare(self) -> None:
        sign = self.form.separator
        spellings = {each for word in self.words for each in (word, word.upper(), word.title())}
        self.reading = arrow_csv.ReadOptions(
            column_names=list(self.form.names), use_threads=False, block_size=1 << 24
        )
        self.parsing = arrow_csv.ParseOptions(delimiter=sign or NO_CELL)
        self.converting = arrow_csv.ConvertOptions(
            column_types=self.types,
            include_columns=list(self.types),
            null_values=sorted(spellings),
            strings_can_be_null=True,
            decimal_point=self.form.decimal,
        )
        self.objects = arrow_json.ParseOptions(
            explicit_schema=pa.schema(list(self.types.items())),
            unexpected_field_behavior="ignore",
        )

    def read(self, block: bytes) -> Rows:
        """Rows of whole lines; blank lines, comments and repeated names are none."""
        if b"\n\n" in block or b"\n\r\n" in block:
            block = BLANK.sub(b"", block)
        rows = joined(self._pieces(block))
        for number in self.numbers:
            rows.values[rows.values == number] = np.nan
        return rows

    def _pieces(self, block: bytes) -> list[Rows]:
        lines = block.count(b"\n")
        if lines <= FEW:
            return [self._one_by_one(block)]
        with suppress(pa.ArrowInvalid):
            table = self._table(block)
            # Fewer rows than lines: some are blank, or a quotation mark holds several together.
            if table.num_rows == lines:
                return [of_table(table, self.columns, self.stamps)]
        middle = block.index(b"\n", len(block) // 2) + 1
        if middle == len(block):
            middle = block.rindex(b"\n", 0, len(block) - 1) + 1
        return self._pieces(block[:middle]) + self._pieces(block[middle:])

    def _table(self, block: bytes) -> pa.Table:
        source = pa.BufferReader(block)
        if self.form.kind == "json":
            options = arrow_json.ReadOptions(use_threads=False, block_size=len(block) + 1)
            return arrow_json.read_json(source, options, self.objects)
        if self.form.separator == " ":
            tidy = b"\n".join(b" ".join(line.split()) for line in block.split(b"\n"))
            source = pa.BufferReader(tidy)
        return arrow_csv.read_csv(source, self.reading, self.parsing, self.converting)

    def _one_by_one(self, block: bytes) -> Rows:
        texts = block.decode("utf-8", errors="replace").split("\n")
        kept = [text for text in texts if not is_aside(text) and not self.form.is_header(text)]
        values = np.full((len(kept), len(self.columns)), np.nan)
        stamps: list[Any] = [None] * len(kept)
        malformed = np.zeros(len(kept), dtype=bool)
        for k, text in enumerate(kept):
            try:
                found = self._cells(text)
                stamps[k] = self._stamp(found)
                values[k] = [self._number(name, found.get(name)) for name in self.columns]
            except ValueError as error:
                malformed[k] = True
                values[k] = np.nan
                self.example = self.example or f"{error}: {text.strip()[:100]!r}"
        return self._rows(values, stamps, malformed)

    def _rows(self, values: Array, stamps: list[Any], malformed: np.ndarray[Any, Any]) -> Rows:
        if self.stamps is None:
            none = np.zeros(len(values), dtype=bool)
            return Rows(values, np.zeros(len(values)), none, malformed)
        column = pa.array(stamps, self.stamps.arrow)
        texts = stamps if self.stamps.is_text else None
        return Rows(values, *self.stamps.ticks(column), malformed, texts)

    def _cells(self, text: str) -> dict[str, Any]:
        """The values of a line by name.

        Raises
        ------
        ValueError
            When it is no object, or has another number of cells than there are names.
        """
        if self.form.kind == "json":
            try:
                found = json.loads(text)
            except ValueError:
                raise ValueError("no JSON") from None
            if not isinstance(found, dict):
                raise ValueError("no JSON object")
            return found
        row = split(text, self.form.separator)
        if len(row) != len(self.form.names):
            raise ValueError(f"{len(row)} cells under {len(self.form.names)} names")
        return dict(zip(self.form.names, row, strict=True))

    def _number(self, name: str, value: Any) -> float:
        """The number in a cell, NaN where it is missing."""
        if value is None:
            return np.nan
        if not isinstance(value, str):
            number = float(value) if isinstance(value, int | float) else np.inf
        elif value.strip().lower() in self.words:
            return np.nan
        else:
            number = self._of_text(value.strip())
        if np.isinf(number):
            raise ValueError(f"{name!r} is no number")
        return number

    def _of_text(self, text: str) -> float:
        if self.form.decimal == ",":
            text = "no number" if "." in text else text.replace(",", ".")
        try:
            return np.inf if "_" in text else float(text)
        except ValueError:
            return np.inf

    def _stamp(self, found: dict[str, Any]) -> Any:
        """The time of a line as Arrow takes it, None where it is missing."""
        if self.stamps is None:
            return None
        value = found.get(self.stamps.name)
        if value is None or str(value).strip().lower() in self.words:
            return None
        if not self.stamps.is_text:
            number = self._number(self.stamps.name, value)
            return int(value) if self.stamps.kind == "whole" else number
        try:
            self.stamps.ticks(pa.array([str(value).strip()]))
        except pa.ArrowInvalid:
            raise ValueError(f"{self.stamps.name!r} is no time") from None
        return str(value).strip()
