"""Threads, signals and functions of the user's: a call waits or says why it cannot, and no misuse
is a crash."""

from __future__ import annotations

import copy
import pickle
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable

import numpy as np
import pytest

import forgetting as fg


def together(*works: Callable[[], object]) -> None:
    """Runs all at once; the first exception of any is raised."""
    failures: list[BaseException] = []

    def guarded(work: Callable[[], object]) -> None:
        try:
            work()
        except BaseException as error:
            failures.append(error)

    threads = [threading.Thread(target=guarded, args=(work,)) for work in works]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    if failures:
        raise failures[0]


def often(work: Callable[[], object], times: int = 60) -> Callable[[], None]:
    def repeated() -> None:
        for _ in range(times):
            work()

    return repeated


def test_threads_that_share_an_estimator_wait_for_each_other() -> None:
    est = fg.RLS(3, monitor=True)
    phi = np.random.default_rng(1).standard_normal((4000, 3))
    y = phi.sum(axis=1)
    together(
        often(lambda: est.run(phi, y)),
        often(lambda: est.update([1.0, 2.0, 3.0], 6.0), 2000),
        often(lambda: pickle.loads(pickle.dumps(est))),
        often(lambda: copy.deepcopy(est)),
        often(lambda: (est.theta, est.covariance, est.samples, est.factor(), est.health())),
        often(lambda: (repr(est), est.rule, est.predict(phi), est.describe())),
    )
    assert est.samples == 60 * 4000 + 2000
    assert est.theta == pytest.approx(np.ones(3), rel=0.1)


def test_threads_that_share_a_fleet_or_a_meter_wait_for_each_other() -> None:
    fleet, other = fg.Fleet(500, 4), fg.Fleet(3, 4)
    phi, meter = np.ones((500, 4)), fg.ExcitationMeter(4, 50)

    def update() -> None:
        count = len(fleet)
        try:
            fleet.update(np.ones((count, 4)), np.ones(count))
        except fg.InvalidInput as error:  # it has grown in the meantime
            assert "has shape" in str(error)

    together(
        often(update),
        often(lambda: fleet.append(2)),
        often(lambda: fleet.append(other)),
        often(lambda: fleet.append(fleet), 2),
        often(lambda: pickle.dumps(fleet), 5),
        often(lambda: (fleet.theta, fleet.variance, fleet.samples, fleet.health(), repr(fleet))),
        often(lambda: fleet.__setitem__(0, fleet[1])),
        often(lambda: meter.add(phi[0]), 2000),
        often(lambda: (meter.information, meter.alpha)),
    )
    assert meter.seen == 2000


def test_who_waits_does_not_hold_the_interpreter() -> None:
    est = fg.RLS(60, rule="variable_direction")
    phi = np.random.default_rng(2).standard_normal((1500, 60))
    ticks = 0

    def tick() -> None:
        nonlocal ticks
        while working.is_alive() or waiting.is_alive():
            time.sleep(0.005)
            ticks += 1

    working = threading.Thread(target=lambda: est.run(phi, phi[:, 0]))
    waiting = threading.Thread(target=lambda: est.theta)
    working.start()
    waiting.start()
    start = time.monotonic()
    tick()
    assert ticks > 0.2 * (time.monotonic() - start) / 0.005


@pytest.mark.parametrize(
    "use",
    [
        lambda est: est.update([1.0], 1.0),
        lambda est: est.run([[1.0]], [1.0]),
        lambda est: est.theta,
        lambda est: pickle.dumps(est),
        lambda est: copy.copy(est),
        lambda est: est.reset(),
        lambda est: repr(est),
        lambda est: est.health(),
    ],
)
@pytest.mark.parametrize("place", ["gate", "rate", "rule"])
def test_an_estimator_in_its_own_function_says_so(
    place: str, use: Callable[[fg.RLS], object]
) -> None:
    def answer(evidence: fg.Evidence) -> float | str:
        use(est)
        return "update" if place == "gate" else 0.9

    def matrix(information: np.ndarray, phi: np.ndarray, error: np.ndarray) -> np.ndarray:
        use(est)
        return 0.1 * information

    rule = {"gate": "exponential", "rate": fg.Exponential(answer), "rule": fg.Custom(matrix)}
    est = fg.RLS(1, rule=rule[place], gate=answer if place == "gate" else None)
    before = est.samples, est.theta
    for call in (lambda: est.update([1.0], 1.0), lambda: est.run([[1.0]], [1.0])):
        with pytest.raises(RuntimeError, match="in the middle of a sample"):
            call()
    assert (est.samples, est.theta) == before
    other = fg.RLS(1)  # what is not in use can be used
    use(other)


LONG = """
import time, sys
import numpy as np, forgetting as fg
{make}
print("ready", flush=True)
start = time.monotonic()
try:
    {call}
except KeyboardInterrupt:
    print("heard", time.monotonic() - start, flush=True)
"""

CALLS = [
    (
        "est = fg.RLS(300, rule='subspace'); phi = np.random.randn(80_000, 300)",
        "est.run(phi, phi[:, 0], outputs=())",
    ),
    (
        "est = fg.RLS(120, rule='variable_direction'); phi = np.random.randn(20_000, 120)",
        "est.run(phi, phi[:, 0], outputs=())",
    ),
    (
        "est = fg.RLS(900); phi = np.random.randn(6_000, 900)",
        "est.run(phi, np.ones(6_000), outputs=())",
    ),
    (
        "est = fg.Bank(8); phi = np.tile(np.random.randn(100_000, 8), (30, 1))",
        "est.run(phi, phi[:, 0], outputs=())",
    ),
    ("est = fg.Fleet(100_000, 8)", "[est._states() for _ in range(100)]"),
    (
        "fleets = [fg.Fleet(300_000, 10) for _ in range(3)]; phi = np.random.randn(300_000, 10)",
        "[fleet.update(phi, phi[:, 0]) for fleet in fleets]",
    ),
    (
        "est = fg.Fleet(300_000, 8)",
        "[est.health() for _ in range(20)]",
    ),
]


@pytest.mark.skipif(sys.platform == "win32", reason="no SIGINT for one process")
@pytest.mark.parametrize(("make", "call"), CALLS, ids=lambda text: text[:30])
def test_ctrl_c_is_heard_in_half_a_second(make: str, call: str) -> None:
    program = LONG.format(make=make, call=call)
    with subprocess.Popen(
        [sys.executable, "-c", program], stdout=subprocess.PIPE, text=True
    ) as child:
        assert child.stdout is not None
        assert child.stdout.readline() == "ready\n"
        time.sleep(0.3)
        assert child.poll() is None, "the call was too short to be interrupted"
        sent = time.monotonic()
        child.send_signal(signal.SIGINT)
        word = child.stdout.readline().split()[:1]
        waited = time.monotonic() - sent
        child.kill()
    assert word == ["heard"]
    assert waited < 2.0  # half a second where the machine has nothing else to do


def test_an_interrupted_record_leaves_the_estimator_as_it_was() -> None:
    est = fg.RLS(40, rule="variable_direction")
    phi = np.random.default_rng(3).standard_normal((200_000, 40))  # seconds
    before = est.to_bytes()
    # a shell starts what runs in its background with the signal ignored
    handler = signal.signal(signal.SIGINT, signal.default_int_handler)
    threading.Timer(0.3, lambda: signal.raise_signal(signal.SIGINT)).start()
    try:
        with pytest.raises(KeyboardInterrupt):
            est.run(phi, phi[:, 0])
    finally:
        signal.signal(signal.SIGINT, handler)
    assert est.to_bytes() == before
