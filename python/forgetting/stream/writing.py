"""Rows of estimates as lines: JSON, or CSV under the names that `identify --estimates` gives."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Iterable, Sequence
from itertools import repeat
from typing import Any

import numpy as np

import forgetting as fg
from forgetting.extras import extra
from forgetting.stream.estimates import Estimates
from forgetting.stream.fields import SKIPPED, Field
from forgetting.stream.rows import Array, Rows

KINDS = ("json", "csv")


class Writer:
    """Makes lines of rows.

    Parameters
    ----------
    kind : str
        "json" or "csv".
    fields : sequence of Field
    """

    def __init__(self, kind: str, fields: Sequence[Field]) -> None:
        self.kind, self.fields = kind, fields
        self.orjson = extra("orjson", "a stream")
        self.template = object_template(fields) if kind == "json" else row_template(fields)

    def header(self) -> bytes:
        """The line of names, of CSV alone."""
        if self.kind == "json":
            return b""
        text = io.StringIO()
        csv.writer(text, lineterminator="\n").writerow(
            [name for field in self.fields for name in field.columns]
        )
        return text.getvalue().encode()

    def lines(
        self, first: int, rows: Rows, y: Array, found: Estimates, reasons: dict[int, str]
    ) -> list[bytes]:
        """A line for each row.

        Parameters
        ----------
        first : int
            Number of the first row.
        rows, y, found
            Time stamps, measured outputs (T, m) and estimates.
        reasons : dict of int to str
            Why rows were left out before the estimator saw them.
        """
        if not len(rows):
            return []
        tokens = self._numbers(rows, y, found)
        parts: list[Iterable[Any]] = []
        for field in self.fields:
            if field.floats is not None:
                # One iterator several times: each takes the next number of the row.
                parts += [tokens] * field.width
            elif field.name == "time" and rows.texts is None:
                parts.append(self._ticks(rows, tokens))
            else:
                parts.append(self._words(field.name, first, rows, found, reasons))
        lines = list(map(self.template.__mod__, zip(*parts, strict=True)))
        if self.kind == "json":
            return lines
        return [line.replace(b"null", b"") for line in lines]

    def _numbers(self, rows: Rows, y: Array, found: Estimates) -> Any:
        """Every float as text, row by row; what is not finite is null."""
        blocks = []
        for field in self.fields:
            if field.floats is not None:
                blocks.append(field.floats(found, y).reshape(len(rows), -1))
            elif field.name == "time" and is_float_time(rows):
                blocks.append(np.where(rows.timed, rows.ticks, np.nan)[:, None])
        if not blocks:
            return iter(())
        table = np.ascontiguousarray(np.hstack(blocks), dtype=np.float64).reshape(-1)
        text = self.orjson.dumps(table, option=self.orjson.OPT_SERIALIZE_NUMPY)
        return iter(text[1:-1].split(b","))

    def _ticks(self, rows: Rows, tokens: Any) -> Iterable[bytes]:
        if is_float_time(rows):
            return tokens  # type: ignore[no-any-return]
        pairs = zip(rows.ticks.tolist(), rows.timed.tolist(), strict=True)
        return [b"%d" % tick if timed else b"null" for tick, timed in pairs]

    def _words(
        self, name: str, first: int, rows: Rows, found: Estimates, reasons: dict[int, str]
    ) -> Iterable[bytes]:
        if name == "row":
            return map(b"%d".__mod__, range(first, first + len(rows)))
        quote = b'"%b"' if self.kind == "json" else b"%b"
        if name == "time":
            texts = rows.texts or repeat(None, len(rows))
            return [b"null" if text is None else quote % text.encode() for text in texts]
        words = SKIPPED if name == "skipped" else fg.GATE
        known = {code: quote % str(word).encode() for code, word in words.items()}
        codes = found.skipped if name == "skipped" else found.others["gate"]
        told = [known[code] for code in codes.tolist()]
        for place, reason in reasons.items() if name == "skipped" else ():
            told[place] = quote % reason.encode()
        return told


def is_float_time(rows: Rows) -> bool:
    """Whether time stamps are numbers with a fraction."""
    return rows.texts is None and rows.ticks.dtype.kind == "f"


def object_template(fields: Sequence[Field]) -> bytes:
    """An object of JSON with a place for every number."""
    return (
        "{" + ",".join(f"{quoted(each.name)}:{places(each)}" for each in fields) + "}\n"
    ).encode()


def quoted(name: str) -> str:
    """A name as JSON has it, safe in a template."""
    return json.dumps(name, ensure_ascii=False).replace("%", "%%")


def places(field: Field) -> str:
    """The places of a field: one, a list, or objects by name."""
    if not field.labels:
        return "%b"
    if field.name == "weights":
        return "[" + ",".join(["%b"] * field.width) + "]"
    if isinstance(field.labels[0], str):
        return "{" + ",".join(f"{quoted(str(each))}:%b" for each in field.labels) + "}"
    inner: dict[str, list[str]] = {}
    for output, regressor in (each for each in field.labels if not isinstance(each, str)):
        inner.setdefault(output, []).append(f"{quoted(regressor)}:%b")
    objects = (f"{quoted(output)}:{{{','.join(own)}}}" for output, own in inner.items())
    return "{" + ",".join(objects) + "}"


def row_template(fields: Sequence[Field]) -> bytes:
    """A row of CSV."""
    return b",".join([b"%b"] * sum(each.width for each in fields)) + b"\n"
