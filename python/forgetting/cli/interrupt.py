"""Ctrl-C ends the command at once, also within a library's long computation.

Python hears a signal between two of its own steps. One step may be the eigenvalues of a million
matrices, so a thread waits beside the work: what has not ended by itself `GRACE` seconds after
Ctrl-C is left where it is, its unfinished files are removed and the process ends.
"""

from __future__ import annotations

import os
import signal
import socket
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

from forgetting.files import remove_unfinished

STOPPED = 130
"""Exit code after Ctrl-C, as a shell gives it: 128 and the number of the signal."""
GRACE = 0.2
"""Seconds in which the work may end by itself."""


class Interrupt:
    """Whether Ctrl-C was pressed, and whether the work is over."""

    def __init__(self) -> None:
        self.pressed = False
        self.over = threading.Event()

    def note(self, number: int, frame: FrameType | None) -> None:
        """Take the signal as Python does, and keep it: a library may make another error of it."""
        self.pressed = True
        signal.default_int_handler(number, frame)

    def watch(self, wire: socket.socket) -> None:
        """Wait for the signal, then for the work to end."""
        while number := wire.recv(1):
            if number[0] == signal.SIGINT and not self.over.wait(GRACE):
                leave()


@contextmanager
def interruptible() -> Iterator[Interrupt]:
    """Watch over a block of the main thread, where Ctrl-C is heard as usual."""
    found = Interrupt()
    usual = signal.getsignal(signal.SIGINT) is signal.default_int_handler
    if threading.current_thread() is not threading.main_thread() or not usual:
        yield found
        return
    ours, of_python = socket.socketpair()
    of_python.setblocking(False)
    watcher = threading.Thread(target=found.watch, args=(ours,), daemon=True)
    before = signal.set_wakeup_fd(of_python.fileno(), warn_on_full_buffer=False)
    signal.signal(signal.SIGINT, found.note)
    watcher.start()
    try:
        yield found
    finally:
        found.over.set()
        signal.signal(signal.SIGINT, signal.default_int_handler)
        signal.set_wakeup_fd(before)
        of_python.close()
        watcher.join()
        ours.close()


def leave() -> None:
    """End the process without waiting for anything."""
    remove_unfinished()
    print("forgetting: stopped.", file=sys.stderr, flush=True)
    os._exit(STOPPED)
