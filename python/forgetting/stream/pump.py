"""The loop of a stream: read what is there, write what it brought, save now and then."""

from __future__ import annotations

import os
import signal
import stat
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from types import FrameType
from typing import Any

from forgetting.stream.inputs import Chunk, Input
from forgetting.stream.output import Output
from forgetting.stream.position import Replay
from forgetting.stream.state import check_settings, load, save
from forgetting.stream.stream import Stream
from forgetting.stream.tally import Teller

LONGEST = 1 << 24
"""Bytes of a line, from which on it is one though it does not end."""
WAIT = 0.25
"""Seconds between two looks at signals and clocks while nothing comes."""
LEAST, MOST = 0.25, 2.0
"""Seconds between two saves: at least so many, for the sake of the disk, and at most so many while
rows come."""
STOPS = (signal.SIGTERM, signal.SIGINT)


@dataclass
class Stopper:
    """Whether a signal asked to stop."""

    asked: bool = False


@contextmanager
def on_signals() -> Iterator[Stopper]:
    """SIGTERM and SIGINT ask to stop; a second one ends the process as it would have."""
    stopper = Stopper()
    before: dict[signal.Signals, Any] = {}

    def ask(number: int, frame: FrameType | None) -> None:
        stopper.asked = True
        signal.signal(number, before[signal.Signals(number)])

    for each in STOPS:
        before[each] = signal.signal(each, ask)
    try:
        yield stopper
    finally:
        for each, handler in before.items():
            signal.signal(each, handler)


class Pump:
    """Moves lines through a stream.

    Parameters
    ----------
    stream : Stream
    source : Input
    descriptor : int
        Where lines are written, at once and as a whole block.
    tell : callable
        Takes a sentence for the user.
    state : Path, optional
        Where to save.
    every : int
        Rows after which the state is saved, though not before `LEAST` seconds have gone by; after
        `MOST` seconds fewer rows are enough.
    watchers : sequence of callable
        Called with what every block brought.
    """

    def __init__(
        self,
        stream: Stream,
        source: Input,
        descriptor: int,
        tell: Callable[[str], None],
        state: Path | None = None,
        every: int = 1000,
        watchers: Sequence[Callable[[Output], None]] = (),
    ) -> None:
        self.stream, self.source, self.descriptor = stream, source, descriptor
        self.tell, self.path, self.every, self.watchers = tell, state, every, watchers
        self.teller = Teller(tell)
        self.carry = b""
        self.saved_rows, self.saved_at = 0, time.monotonic()
        self.replay: Replay | None = None

    def resume(self) -> None:
        """Go on from the saved state, if there is one; end a line that a kill has torn.

        Raises
        ------
        RecordError
            When the state is none, was altered, or belongs to other settings.
        """
        if self.path is None:
            return
        state = load(self.path)
        if state is None:
            end_torn_line(self.descriptor)
            return
        check_settings(self.path, state["settings"], self.stream.settings.as_data())
        self.stream.restore(state)
        self.saved_rows = self.stream.tally.rows
        self.teller.told = type(self.stream.tally)(**self.stream.tally.state())
        found = self.source.resume(self.stream.position, state["input"])
        self.tell(f"goes on after row {self.saved_rows} of {self.path}")
        end_torn_line(self.descriptor)
        if not found:
            self.replay = Replay(self.stream.position)
        self.stream.header_due = False

    def run(self) -> None:
        """Read to the end, or until a signal comes."""
        with on_signals() as stopper:
            while not stopper.asked:
                chunk = self.source.read(WAIT)
                if chunk is None:
                    self._end()
                    break
                self._take(chunk)
                self._save_if_due()
        self._save()
        self.tell(str(self.stream.tally))

    def _take(self, chunk: Chunk) -> None:
        if chunk.begins:
            if self.replay is not None:
                self.tell("the file is another than that of the state; all of its lines are new")
            # What stood at the end of the file before is a line, though nothing ends it.
            self._feed(self.carry)
            self.carry = b""
            self.stream.further_input()
            self.replay = None
        data = chunk.data
        if self.replay is not None:
            data = self._new(data)
        if not data:
            return
        together = self.carry + data
        end = together.rfind(b"\n") + 1
        if len(together) - end > LONGEST:
            end = len(together)
        self.carry = together[end:]
        self._feed(together[:end])

    def _new(self, data: bytes) -> bytes:
        """What of the bytes was not taken before the state was saved."""
        assert self.replay is not None
        data = self.replay.new(data)
        if self.replay.found is False:
            self.tell("the input is another than that of the state; its lines are new")
            self.stream.further_input()
        if self.replay.is_over:
            self.replay = None
        return data

    def _feed(self, block: bytes) -> None:
        if not block:
            return
        made = self.stream.feed(block)
        write(self.descriptor, b"".join(made.lines))
        if self.stream.to == "csv":
            for alarm in made.alarms:
                self.tell(str(alarm))
        for watcher in self.watchers:
            watcher(made)
        if self.teller.look(self.stream.tally, self.stream.example):
            self.stream.forget_example()

    def _end(self) -> None:
        """The last line need not end."""
        self._feed(self.carry)
        self.carry = b""

    def _save_if_due(self) -> None:
        new = self.stream.tally.rows - self.saved_rows
        elapsed = time.monotonic() - self.saved_at
        if (new >= self.every and elapsed >= LEAST) or (new and elapsed >= MOST):
            self._save()

    def _save(self) -> None:
        """Save what was written: the lines are with the system before the state says so."""
        self.saved_at = time.monotonic()
        state = self.stream.state()
        if self.path is None or state is None:
            return
        sync(self.descriptor)
        save(self.path, state | {"input": self.source.identity()})
        self.saved_rows = self.stream.tally.rows


def write(descriptor: int, data: bytes) -> None:
    """Write all of it."""
    view = memoryview(data)
    while view:
        view = view[os.write(descriptor, view) :]


def is_file(descriptor: int) -> bool:
    """Whether lines go to a file."""
    return stat.S_ISREG(os.fstat(descriptor).st_mode)


def sync(descriptor: int) -> None:
    """Lines in a file shall outlive the machine, as the state does."""
    if is_file(descriptor):
        os.fsync(descriptor)


def end_torn_line(descriptor: int) -> None:
    """End a line that was cut where the process before was killed; the next one is then whole."""
    if not is_file(descriptor) or os.fstat(descriptor).st_size == 0:
        return
    try:
        again: Any = os.open(f"/dev/fd/{descriptor}", os.O_RDONLY)
    except OSError:
        return
    try:
        if os.pread(again, 1, os.fstat(again).st_size - 1) != b"\n":
            write(descriptor, b"\n")
    finally:
        os.close(again)
