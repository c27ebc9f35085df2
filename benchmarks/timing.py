"""Times that can be compared: the sides take turns, and the shortest turn of each counts."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from typing import Any

# a turn shorter than this is mostly the call itself
SHORTEST_TURN = 150e-6
# a rival this many times slower than the best of its group is out, after so many turns
HOPELESS, TRIAL_TURNS = 1.3, 3


@dataclass
class Side:
    """Something timed: `prepare` is called before every turn and not timed."""

    name: str
    work: Callable[[], Any]
    prepare: Callable[[], Any] = lambda: None
    group: str = ""  # rivals of which only the best counts
    least: float = float("inf")  # seconds
    turns: int = field(default=0)

    def turn(self) -> None:
        """Time one turn."""
        self.prepare()
        start = time.perf_counter()
        self.work()
        self.least = min(self.least, time.perf_counter() - start)
        self.turns += 1


def race(sides: Iterable[Side], seconds: float, least_turns: int = 5) -> None:
    """Let the sides take turns (A B C A B C ...) for `seconds`, so that drift hits all alike."""
    running = list(sides)
    end = time.perf_counter() + seconds
    turns = 0
    while turns < least_turns or time.perf_counter() < end:
        for side in running:
            side.turn()
        turns += 1
        if turns == TRIAL_TURNS:
            running = [side for side in running if not hopeless(side, running)]


def hopeless(side: Side, sides: list[Side]) -> bool:
    """Whether a rival of the same group is far ahead."""
    best = min(rival.least for rival in sides if rival.group == side.group)
    return side.group != "" and side.least > HOPELESS * best


def best_of(sides: Iterable[Side], group: str) -> Side | None:
    """The fastest of a group; None if nobody ran."""
    ran = [side for side in sides if side.group == group and side.turns]
    return min(ran, key=lambda side: side.least, default=None)
