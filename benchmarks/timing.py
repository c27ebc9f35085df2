"""Times that can be compared: the sides take turns, and the shortest turn of each counts.

Time is the processor's, of the thread that calls: what others get of the processor meanwhile does
not count. What they do to caches and clock rate does, and hits all sides alike.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from itertools import count
from typing import Any

import numpy as np

# turns: how many times slower than the best of its group a rival may still be, or it is out
OUT = {3: 3.0, 12: 1.3}
# a side this many times slower than the fastest turns more seldom, to leave time to the others
SLOW = 5


@dataclass
class Side:
    """Something timed: `prepare` is called before every turn and not timed."""

    name: str
    work: Callable[[], Any]
    prepare: Callable[[], Any] = lambda: None
    group: str = ""  # rivals of which only the best counts
    each: int = 1  # samples or calls in one turn
    clock: Callable[[], float] = time.thread_time
    least: float = float("inf")  # seconds of a turn
    turns: int = field(default=0)

    def turn(self) -> None:
        """Time one turn."""
        self.prepare()
        start = self.clock()
        self.work()
        self.least = min(self.least, self.clock() - start)
        self.turns += 1

    @property
    def nanoseconds(self) -> float:
        """A sample or call."""
        return self.least / self.each * 1e9


def race(sides: Iterable[Side], seconds: float, least_rounds: int = 8) -> None:
    """Let the sides take turns (A B C A B C ...) for `seconds`, so that drift hits all alike."""
    running, fastest = list(sides), float("inf")
    end = time.perf_counter() + seconds
    for turn in count():
        for side in running:
            if side.turns == 0 or turn % max(1, round(side.least / (SLOW * fastest))) == 0:
                side.turn()
        if turn in OUT:
            running = [side for side in running if has_hope(side, running, OUT[turn])]
            fastest = min(side.least for side in running)
        if turn >= least_rounds and time.perf_counter() > end:
            return


def has_hope(side: Side, sides: list[Side], times: float) -> bool:
    """Whether no rival of the same group is so far ahead."""
    best = min(rival.least for rival in sides if rival.group == side.group)
    return side.group == "" or side.least <= times * best


def best_of(sides: Iterable[Side], group: str) -> Side | None:
    """The fastest of a group; None if nobody is in it."""
    members = [side for side in sides if side.group == group]
    return min(members, key=lambda side: side.least, default=None)


def growth(times: dict[int, float]) -> float:
    """The exponent of time over the sizes from 64 on."""
    large = {n: time for n, time in times.items() if n >= 64}
    if len(large) < 2:
        return float("nan")
    return float(np.polyfit(np.log(list(large)), np.log(list(large.values())), 1)[0])
