"""Where in its input a stream is, and whether an input is the one that it was in."""

from __future__ import annotations

import base64
import zlib
from typing import Any

from forgetting.words.errors import RecordError

HEAD = 4096
"""Bytes at the beginning that an input is known by."""
TAIL = 256
"""Bytes before the position that a file is known by."""


class Position:
    """Bytes of whole lines that were taken from the input, counted from its beginning.

    Attributes
    ----------
    taken : int
        How many.
    checksum : int
        CRC-32 of them.
    head, tail : bytes
        The first and the last of them.
    """

    def __init__(self) -> None:
        self.taken, self.checksum = 0, 0
        self.head = self.tail = b""

    def advance(self, block: bytes) -> None:
        """Take whole lines."""
        if len(self.head) < HEAD:
            self.head += block[: HEAD - len(self.head)]
        self.tail = (self.tail + block)[-TAIL:]
        self.checksum = zlib.crc32(block, self.checksum)
        self.taken += len(block)

    def restart(self) -> None:
        """Begin with another input."""
        self.__init__()  # type: ignore[misc]

    def state(self) -> dict[str, Any]:
        """As `restored` takes it."""
        text = {name: base64.b64encode(getattr(self, name)).decode() for name in ("head", "tail")}
        return {"taken": self.taken, "checksum": self.checksum, **text}

    @classmethod
    def restored(cls, state: dict[str, Any]) -> Position:
        """The position of a saved state."""
        made = cls()
        made.taken, made.checksum = state["taken"], state["checksum"]
        made.head, made.tail = (base64.b64decode(state[name]) for name in ("head", "tail"))
        return made


class Replay:
    """Passes over what was taken before, if the same input is offered again from its beginning.

    An input that begins otherwise goes on where the one before ended, as a live source does. Only
    bytes that equal the beginning are held back until that is decided: they bring nothing new, or
    little.
    """

    def __init__(self, before: Position) -> None:
        self.before = before
        self.held = b""
        self.found: bool | None = None if before.taken else False
        """Whether the input is the one of before; None while it cannot be told."""
        self.passed = Position()

    @property
    def is_over(self) -> bool:
        """Whether all bytes are new from here on."""
        return self.found is False or self.passed.taken == self.before.taken

    def new(self, data: bytes) -> bytes:
        """What of the next bytes is new.

        Raises
        ------
        RecordError
            When the input begins like the one of before and then differs from it.
        """
        if self.found is None:
            data = self._decide(self.held + data)
        if self.is_over:
            return data
        rest = self.before.taken - self.passed.taken
        self.passed.advance(data[:rest])
        if self.is_over and self.passed.checksum != self.before.checksum:
            raise RecordError(
                f"the input begins as that of the state, but differs from it within the first "
                f"{self.before.taken} bytes, which were taken before; offer the same lines again, "
                "or others from their first one on, or name another --state"
            )
        return data[rest:]

    def _decide(self, data: bytes) -> bytes:
        head = self.before.head
        if not (data.startswith(head) or head.startswith(data)):
            self.found, self.held = False, b""
            return data
        if len(data) < len(head):
            self.held = data
            return b""
        self.found, self.held = True, b""
        return data
