"""Lines of a file of text, before it is known what they are."""

from __future__ import annotations

import io
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import islice
from typing import BinaryIO

SMALL = 1 << 18
"""A file up to this size is looked at as a whole, a larger one in its middle."""
LINES = 300
"""Lines that are looked at in one go."""
QUOTED = 6
"""A quoted name goes over at most this many lines; a lone quotation mark is only that."""


@dataclass(frozen=True)
class Text:
    """A file of text: its bytes, their encoding, its name."""

    stream: BinaryIO
    encoding: str
    source: str

    def lines(self, start: int = 0) -> Iterator[str]:
        """Lines without their ends, from a byte on; whatever is no text there becomes �."""
        self.stream.seek(start)
        decoded = io.TextIOWrapper(self.stream, self.code(start), errors="replace")
        try:
            for line in decoded:
                yield line.rstrip("\n")
        finally:
            decoded.detach()

    def code(self, start: int) -> str:
        """The encoding of the middle of a file, where no mark tells the order of bytes."""
        if start == 0 or self.encoding not in ("utf-16", "utf-32"):
            return self.encoding
        self.stream.seek(0)
        order = "le" if self.stream.read(1) == b"\xff" else "be"
        self.stream.seek(start)
        return f"{self.encoding}-{order}"

    def size(self) -> int:
        """Number of bytes."""
        return self.stream.seek(0, io.SEEK_END)


def reference(text: Text) -> list[str]:
    """Lines in which the body of the table is sure to be seen."""
    size = text.size()
    if size <= SMALL:
        return list(text.lines())
    middle = size // 2 // 4 * 4
    return list(islice(text.lines(middle), 1, LINES))


def joined(lines: Sequence[str]) -> tuple[list[int], list[str]]:
    """Put lines together where a quoted name goes over several; also where each one began."""
    starts, whole, at = [], [], 0
    while at < len(lines):
        end = at + 1
        while odd(lines[at:end]) and end < min(at + QUOTED, len(lines)):
            end += 1
        end = at + 1 if odd(lines[at:end]) else end
        starts.append(at)
        whole.append(" ".join(lines[at:end]))
        at = end
    return starts, whole


def odd(lines: Sequence[str]) -> bool:
    """Whether a quotation mark is left open."""
    return sum(line.count('"') for line in lines) % 2 == 1
