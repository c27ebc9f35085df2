"""A fuzz target: random cases until one fails or the time is over.

A case may be refused with one line, and must do nothing else: no other exception, nothing longer
than `LIMIT`, no more memory than `ROOM`, no warning.
"""

from __future__ import annotations

import faulthandler
import os
import resource
import signal
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import hypothesis
from hypothesis import HealthCheck, given, settings
from hypothesis.strategies import SearchStrategy

import forgetting as fg
from forgetting.record import RecordError

REFUSALS = (RecordError, fg.InvalidInput, fg.NumericalRange)
LIMIT = 10.0
"""Seconds that a case may take on a machine with other work; most take some milliseconds."""
ROOM = 1 << 30
"""Bytes by which a case may raise what the process held at most."""
WORDS = 1000
"""Characters that a refusal may have."""
BATCH = 200
"""Cases between two looks at the time."""


class TooLong(BaseException):
    """A case took longer than `LIMIT`; no `except Exception` of the code under test hides it."""


def fuzz(
    name: str, cases: int, inputs: SearchStrategy[Any], check: Callable[[Any], object]
) -> None:
    """Run cases and print a summary.

    Parameters
    ----------
    name : str
        What is fuzzed, for the summary.
    cases : int
        How many, always the same ones; with ``FUZZ_SECONDS`` in the environment as many as fit
        into that time, with the seeds from ``FUZZ_SEED`` on.
    inputs : strategy
        What makes a case.
    check : callable
        Gives the case to the code under test; may raise one of `REFUSALS`.
    """
    seconds = float(os.environ.get("FUZZ_SECONDS", 0))
    seed = first = int(os.environ.get("FUZZ_SEED", 1))
    done, start = 0, time.monotonic()
    while True:
        count = BATCH if seconds else cases
        try:
            batch(inputs, check, count, seed)
        except BaseException as error:
            error.add_note(f"fuzz {name}: 1 failure after {done} cases, seed {seed}")
            raise
        done += count
        if time.monotonic() - start >= seconds:
            break
        seed += 1
    took = time.monotonic() - start
    print(f"fuzz {name}: 0 failures in {done} cases, {took:.0f} s, seeds {first} to {seed}")


def batch(
    inputs: SearchStrategy[Any], check: Callable[[Any], object], count: int, seed: int
) -> None:
    """Run the cases of one seed; a failure is shrunk to its smallest case and printed."""

    @hypothesis.seed(seed)
    @settings(
        max_examples=count,
        database=None,
        deadline=None,
        derandomize=False,
        suppress_health_check=list(HealthCheck),
    )
    @given(inputs)
    def each(case: Any) -> None:
        contract(check, case)

    each()


def contract(check: Callable[[Any], object], case: Any) -> None:
    """Hold one case to what the head of this file says."""
    with within_limits():
        try:
            check(case)
        except REFUSALS as error:
            words = str(error)
            assert words and len(words.splitlines()) == 1 and len(words) <= WORDS, repr(words)


@contextmanager
def within_limits() -> Iterator[None]:
    """Stop what takes too long, and fail where too much memory was taken."""

    def stop(*_: Any) -> None:
        raise TooLong(f"a case took longer than {LIMIT:g} s")

    lost: list[object] = []
    before, hook = signal.signal(signal.SIGALRM, stop), sys.unraisablehook
    sys.unraisablehook = lambda told: lost.append(told.exc_value)
    held = peak()
    signal.setitimer(signal.ITIMER_REAL, LIMIT)
    # what does not come back from a library ends the process, which says where it was
    faulthandler.dump_traceback_later(6 * LIMIT, exit=True, file=sys.__stderr__)
    try:
        yield
    finally:
        faulthandler.cancel_dump_traceback_later()
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)
        sys.unraisablehook = hook
    assert not lost, f"lost in a library, and printed: {lost}"
    more = peak() - held
    assert more <= ROOM, f"a case took {more >> 20} MiB of memory"


def peak() -> int:
    """Most bytes that this process has held so far."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024
