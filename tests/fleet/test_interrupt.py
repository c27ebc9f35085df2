"""Ctrl-C ends a call that works for long, and the fleet is then as it was before, bit for bit."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
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


def state(fleet: fg.Fleet) -> list[np.ndarray]:
    return [fleet.theta, fleet.variance, fleet.samples]


MADE = {
    "in vectors": {"rule": "exponential"},
    "with priors": {"rule": "exponential", "initial_covariance": np.full((COUNT, N), 2.0)},
    "one by one": {"rule": "oblique_projection"},
    "banks": {"rule": "auto"},
}


@pytest.mark.parametrize("name", ["with priors", "one by one"])
def test_a_fleet_that_is_made(name):
    interrupted(lambda: fg.Fleet(COUNT, N, **MADE[name]))


@pytest.mark.parametrize("name", ["in vectors", "one by one", "banks"])
def test_streams_that_come(name):
    fleet, more = (fg.Fleet(count, N, **MADE[name]) for count in (1000, 20_000))
    fleet.update(*samples(1000, N, 4))
    before = state(fleet)
    interrupted(lambda: [fleet.append(more) for _ in range(1000)])
    kept = len(fleet) - (len(fleet) - 1000) % len(more)
    assert kept == len(fleet), "a part of what was to be added is there"
    for was, now in zip(before, state(fleet), strict=True):
        np.testing.assert_array_equal(was, now[:1000])


def test_a_signal_before_numpy_was_needed_is_no_panic():
    code = (
        "import signal, numpy, forgetting as fg\n"
        "fleet = fg.Fleet(2, 2)\n"
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"
        "import numpy.lib as lib\n"
        "class Pressed:\n"
        "    def __init__(self, *_): raise KeyboardInterrupt\n"
        "lib.NumpyVersion = Pressed\n"
        "fleet.theta\n"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stderr


def test_health_and_the_states_of_a_table():
    fleet = fg.Fleet(COUNT, N)
    fleet.update(*samples(COUNT, N, 3))
    interrupted(fleet.health)
    fresh, *states = fg.Fleet(1, N)._states()
    interrupted(lambda: fg.Fleet._of_states(fresh, states * COUNT))
