"""Memory does not grow with the stream; with FORGETTING_FULL=1 over ten million lines."""

from __future__ import annotations

import os
import tracemalloc

from forgetting.stream import Settings, Stream

from .conftest import as_csv, plant

FULL = bool(os.environ.get("FORGETTING_FULL"))
BLOCK = 5_000
BLOCKS = 2_000 if FULL else 24
GROWTH = 100_000
"""Bytes: interned words and caches of libraries, measured about 15,000."""


def test_memory_is_constant():
    """After the first blocks nothing is kept of those that follow, faults and alarms included."""
    header, *lines = as_csv(plant(BLOCK)).splitlines(keepends=True)
    lines[100], lines[200] = b"rubbish\n", lines[199]
    block = b"".join(lines)
    stream = Stream(Settings(output=("y",), input=("u",), arx=(1, 1, 1)))
    stream.feed(header)
    tracemalloc.start()
    sizes = []
    for _ in range(BLOCKS):
        stream.feed(block)
        sizes.append(tracemalloc.get_traced_memory()[0])
    tracemalloc.stop()
    third = len(sizes) // 3
    assert max(sizes[-third:]) - max(sizes[:third]) < GROWTH
    assert stream.tally.rows == BLOCK * BLOCKS


def test_the_state_does_not_grow():
    stream = Stream(Settings(output=("y",), input=("u",), arx=(1, 1, 1)))
    header, *lines = as_csv(plant(BLOCK)).splitlines(keepends=True)
    stream.feed(header)
    sizes = []
    for _ in range(4):
        stream.feed(b"".join(lines))
        sizes.append(len(repr(stream.state())))
    assert max(sizes[1:]) - min(sizes[1:]) < 0.05 * sizes[0]
