"""However many cores take part, the result is the same, bit for bit."""

import multiprocessing

import numpy as np
import pytest
from company import samples

import forgetting as fg

OUTPUTS = ["error", "leverage", "skipped"]
RULES = [fg.Exponential(0.95), fg.Subspace(0.9, threshold=0.5), fg.RandomWalk()]


@pytest.mark.parametrize("threads", [2, 3, 64, None])
@pytest.mark.parametrize("n", [3, 11])
@pytest.mark.parametrize("rule", RULES, ids=repr)
def test_threads_change_nothing(rule, n, threads):
    count = 101
    one = fg.Fleet(count, n, rule=rule, threads=1)
    fleet = fg.Fleet(count, n, rule=rule, threads=threads)
    given = samples(30, count, n)
    for phi, y, mask in zip(given.phi, given.y, given.mask, strict=True):
        alone, together = (f.update(phi, y, mask, outputs=OUTPUTS) for f in (one, fleet))
        assert alone.used == together.used
        for name in OUTPUTS:
            np.testing.assert_array_equal(getattr(alone, name), getattr(together, name))
    assert one._states() == fleet._states()


def test_a_large_fleet_uses_what_the_machine_has():
    count = 60_000  # large enough for threads of its own accord
    fleet, one = fg.Fleet(count, 4), fg.Fleet(count, 4, threads=1)
    random = np.random.default_rng(0)
    for _ in range(3):
        phi, y = random.normal(size=(count, 4)), random.normal(size=count)
        assert fleet.update(phi, y).used == one.update(phi, y).used == count
    np.testing.assert_array_equal(fleet.theta, one.theta)
    np.testing.assert_array_equal(fleet.variance, one.variance)


def test_the_number_of_threads_can_be_changed():
    fleet = fg.Fleet(4, 2)
    assert fleet.threads is None
    fleet.threads = 2
    assert fleet.threads == 2
    with pytest.raises(fg.InvalidInput, match="threads = -1, allowed"):
        fleet.threads = -1
    assert fleet.threads == 2
    fleet.threads = None


def forked(fleet, queue):
    queue.put(fleet.update(np.ones((64, 2)), np.ones(64)).used)


@pytest.mark.skipif("fork" not in multiprocessing.get_all_start_methods(), reason="no fork here")
@pytest.mark.filterwarnings("ignore:.*fork:DeprecationWarning")
def test_a_forked_process_does_without_threads():
    fleet = fg.Fleet(64, 2, threads=2)
    fleet.update(np.ones((64, 2)), np.ones(64))  # the threads are there
    context = multiprocessing.get_context("fork")
    queue = context.Queue()
    child = context.Process(target=forked, args=(fleet, queue))
    child.start()
    assert queue.get(timeout=60) == 64
    child.join()
