"""Ctrl-C ends a call that works for long, and the fleet is then as it was before, bit for bit."""

from __future__ import annotations

import os
import signal
import threading
from collections.abc import Callable

import numpy as np
import pytest

import forgetting as fg

N = 10
COUNT = 200_000  # seconds, where each stream has its prior from its first sample


def interrupted(work: Callable[[], object]) -> None:
    """Does `work` and presses Ctrl-C a little later; that must end it."""
    # a shell starts what runs in its background with the signal ignored
    handler = signal.signal(signal.SIGINT, signal.default_int_handler)
    threading.Timer(0.1, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    try:
        with pytest.raises(KeyboardInterrupt):
            work()
    finally:
        signal.signal(signal.SIGINT, handler)


def samples(count: int, n: int, seed: int) -> tuple[np.ndarray, np.ndarray]:
    phi = np.random.default_rng(seed).standard_normal((count, n))
    return phi, phi.sum(axis=1)


@pytest.mark.parametrize("threads", [1, None])
def test_an_update(threads):
    fleet, other = fg.Fleet(COUNT, N, threads=threads), fg.Fleet(COUNT, N)
    phi, y = samples(COUNT, N, 1)
    interrupted(lambda: fleet.update(phi, y))
    assert fleet.samples.sum() == 0
    np.testing.assert_array_equal(fleet.variance, other.variance)
    # and it goes on as one that was never interrupted
    for _ in range(2):
        told, wanted = fleet.update(phi, y), other.update(phi, y)
        assert told.used == wanted.used == COUNT
        np.testing.assert_array_equal(told.error, wanted.error)
    np.testing.assert_array_equal(fleet.theta, other.theta)


def test_an_update_after_a_time_of_its_own():
    fleet = fg.Fleet(COUNT, 4, rule="exponential")
    phi, y = samples(COUNT, 4, 2)
    fleet.update(phi, y)
    before = [fleet.theta, fleet.variance, fleet.samples]
    interrupted(lambda: fleet.update(phi, y, elapsed=2.5))
    for was, now in zip(before, [fleet.theta, fleet.variance, fleet.samples], strict=True):
        np.testing.assert_array_equal(was, now)


def test_health_and_the_states_of_a_table():
    fleet = fg.Fleet(COUNT, N)
    fleet.update(*samples(COUNT, N, 3))
    interrupted(fleet.health)
    fresh, *states = fg.Fleet(1, N)._states()
    interrupted(lambda: fg.Fleet._of_states(fresh, states * COUNT))
