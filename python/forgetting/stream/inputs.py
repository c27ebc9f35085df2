"""Where lines come from: a pipe, or a file, which may grow and be replaced as by log rotation."""

from __future__ import annotations

import os
import select
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

from forgetting.stream.position import Position

MOST = 1 << 18
"""Bytes taken in one go."""
LOOK = 0.2
"""Seconds between two looks at a file that does not grow."""


@dataclass(frozen=True)
class Chunk:
    """Bytes that came; none when nothing did in time.

    Attributes
    ----------
    data : bytes
    begins : bool
        Whether they are the first of another file than those before.
    """

    data: bytes
    begins: bool = False


class Input(Protocol):
    """What lines are read from."""

    def read(self, timeout: float) -> Chunk | None:
        """What is there, or comes within `timeout` seconds; None at the end."""
        ...

    def resume(self, position: Position, identity: dict[str, Any]) -> bool:
        """Go to a saved position; False where the input cannot, but may be offered again."""
        ...

    def identity(self) -> dict[str, Any]:
        """What tells this input from others, for a saved state."""
        ...

    def close(self) -> None:
        """Give back what was opened."""
        ...


class Pipe:
    """A descriptor such as standard input."""

    def __init__(self, descriptor: int) -> None:
        self.descriptor = descriptor

    def read(self, timeout: float) -> Chunk | None:
        """See `Input`; all that waits is taken at once."""
        if not self._has_more(timeout):
            return Chunk(b"")
        data = os.read(self.descriptor, MOST)
        if not data:
            return None
        while len(data) < MOST and self._has_more(0):
            more = os.read(self.descriptor, MOST - len(data))
            if not more:
                break
            data += more
        return Chunk(data)

    def _has_more(self, timeout: float) -> bool:
        return bool(select.select([self.descriptor], [], [], timeout)[0])

    def resume(self, position: Position, identity: dict[str, Any]) -> bool:
        """See `Input`."""
        return False

    def identity(self) -> dict[str, Any]:
        """See `Input`."""
        return {}

    def close(self) -> None:
        """The descriptor is somebody else's."""


class File:
    """A file by its name.

    Parameters
    ----------
    path : Path
    follow : bool
        Whether to wait for more at its end, as ``tail -F`` does: a file that takes its place is
        read from its beginning, once the one before is at its end; so is one that was cut.

    Raises
    ------
    OSError
        When it cannot be read, or is not there and is not followed.
    """

    def __init__(self, path: Path, follow: bool) -> None:
        self.path, self.follow = path, follow
        self.descriptor: int | None = None
        self.taken = 0
        self.begins = False
        if not follow or path.exists():
            self.descriptor = os.open(path, os.O_RDONLY)

    def read(self, timeout: float) -> Chunk | None:
        """See `Input`."""
        deadline = time.monotonic() + timeout
        while True:
            data = b"" if self.descriptor is None else os.read(self.descriptor, MOST)
            if data:
                self.taken += len(data)
                chunk = Chunk(data, self.begins)
                self.begins = False
                return chunk
            if not self._renew() and not self.follow:
                return None
            rest = deadline - time.monotonic()
            if rest <= 0:
                return Chunk(b"")
            time.sleep(min(LOOK, rest))

    def _renew(self) -> bool:
        """At the end: open what has the name now, or begin again where the file was cut."""
        try:
            there = os.stat(self.path)
        except FileNotFoundError:
            return False
        if self.descriptor is None:
            self.descriptor = os.open(self.path, os.O_RDONLY)
            return True
        own = os.fstat(self.descriptor)
        if (there.st_ino, there.st_dev) != (own.st_ino, own.st_dev):
            return self._switch()
        if own.st_size < self.taken:
            os.lseek(self.descriptor, 0, os.SEEK_SET)
            self.taken, self.begins = 0, True
            return True
        return False

    def _switch(self) -> bool:
        """Open what took the place of the file, unless lines came to the old one meanwhile."""
        assert self.descriptor is not None
        if os.fstat(self.descriptor).st_size > self.taken:
            return True
        os.close(self.descriptor)
        self.descriptor = os.open(self.path, os.O_RDONLY)
        self.taken, self.begins = 0, True
        return True

    def resume(self, position: Position, identity: dict[str, Any]) -> bool:
        """Go to the position in the file, or in the one that had its name.

        Where neither is there any more, the file is read from its beginning, as another one.
        """
        for path in (self.path, *self._moved(identity)):
            if path.exists() and is_same(path, position):
                self.close()
                self.descriptor = os.open(path, os.O_RDONLY)
                self.taken = os.lseek(self.descriptor, position.taken, os.SEEK_SET)
                return True
        self.begins = True
        return False

    def _moved(self, identity: dict[str, Any]) -> list[Path]:
        """Files of the folder that are, by another name, the one that was read."""
        known = (identity.get("inode"), identity.get("device"))
        found = []
        with os.scandir(self.path.resolve().parent) as entries:
            for entry in entries:
                if entry.is_file(follow_symlinks=False):
                    stat = entry.stat(follow_symlinks=False)
                    if (stat.st_ino, stat.st_dev) == known:
                        found.append(Path(entry.path))
        return found

    def identity(self) -> dict[str, Any]:
        """See `Input`."""
        if self.descriptor is None:
            return {}
        stat = os.fstat(self.descriptor)
        return {"inode": stat.st_ino, "device": stat.st_dev}

    def close(self) -> None:
        """See `Input`."""
        if self.descriptor is not None:
            os.close(self.descriptor)
            self.descriptor = None


def is_same(path: Path, position: Position) -> bool:
    """Whether a file begins as the one of a position, and holds what stands before it."""
    with path.open("rb") as file:
        if file.read(len(position.head)) != position.head:
            return False
        file.seek(max(position.taken - len(position.tail), 0))
        return file.read(len(position.tail)) == position.tail
