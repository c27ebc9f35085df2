"""Forgetting by the clock: gaps add up, equal steps are samples, and time has any unit."""

from __future__ import annotations

from datetime import timedelta
from typing import Any

import numpy as np
import pytest

import forgetting as fg

WIDE = np.array([[4.0, 1.0, 0.5], [1.0, 3.0, -0.2], [0.5, -0.2, 2.0]])
EVERYWHERE = {
    "exponential": fg.Exponential(0.9),
    "exponential_resetting": fg.ExponentialResetting(0.9, information=0.1),
    "stabilised": fg.Stabilised(0.9),
    "component": fg.Component([0.9, 0.8, 0.99]),
    "component, one factor": fg.Component(0.9),
    "random_walk": fg.RandomWalk([0.1, 0.0, 0.3]),
    "random_walk, full": fg.RandomWalk([[0.2, 0.1, 0.0], [0.1, 0.3, 0.0], [0.0, 0.0, 0.1]]),
    "random_walk, bounded": fg.RandomWalk(0.3, bound=50.0),
    "random_walk, one number": fg.RandomWalk(0.3),
    "efra": fg.Efra(0.9),
}
"""Rules that forget everywhere, whatever the input."""
ADDING_UP = [name for name in EVERYWHERE if name != "efra"]


def record(samples: int = 60, seed: int = 4) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    random = np.random.default_rng(seed)
    phi = random.normal(size=(samples, 3))
    y = phi @ [1.0, -2.0, 0.5] + 0.1 * random.normal(size=samples)
    return phi, y, np.cumsum(random.exponential(size=samples))


def wide(rule: Any, **more: Any) -> fg.RLS:
    return fg.RLS(3, rule=rule, initial_covariance=WIDE, **more)


@pytest.mark.parametrize("name", ADDING_UP)
def test_gaps_without_data_add_up(name):
    one, other = wide(EVERYWHERE[name]), wide(EVERYWHERE[name])
    phi, y, _ = record()
    for k in range(0, 60, 3):
        for elapsed in (0.25, 1.5, 2.0):
            one.update(np.zeros(3), 0.0, elapsed=elapsed)
        other.update(np.zeros(3), 0.0, elapsed=3.75)
        np.testing.assert_allclose(one.covariance, other.covariance, rtol=1e-11)
        one.update(phi[k], y[k], elapsed=0.5)
        other.update(phi[k], y[k], elapsed=0.5)


@pytest.mark.parametrize("name", list(EVERYWHERE))
def test_whole_units_in_silence_are_as_many_samples(name):
    one, other = wide(EVERYWHERE[name]), wide(EVERYWHERE[name])
    one.update(np.zeros(3), 0.0, elapsed=5.0)
    for _ in range(5):
        other.update(np.zeros(3), 0.0)
    if name != "efra":  # its limit is approached in steps of one sample
        np.testing.assert_allclose(one.covariance, other.covariance, rtol=1e-11)
    assert np.linalg.eigvalsh(one.covariance)[0] > 0


@pytest.mark.parametrize("rule", [each["name"] for each in fg.rules() if each["name"] != "custom"])
@pytest.mark.parametrize("dtype", ["float64", "float32"])
def test_equal_steps_are_samples(rule, dtype):
    phi, y, _ = record()
    run = fg.RLS(3, rule=rule, dtype=dtype).run(phi, y)
    timed = fg.RLS(3, rule=rule, dtype=dtype).run(phi, y, time=7.0 + np.arange(60))
    assert np.array_equal(run.theta, timed.theta)
    assert np.array_equal(run.error, timed.error)


@pytest.mark.parametrize("make", [fg.Bank, lambda n: fg.RLS(n, rule=fg.Exponential(0.9))])
def test_a_record_is_one_update_a_sample(make):
    phi, y, time = record()
    whole, single, pieces = make(3), make(3), make(3)
    run = whole.run(phi, y, time=time)
    errors = []
    for k in range(60):
        elapsed = time[k] - time[k - 1] if k else 1.0
        errors.append(single.update(phi[k], y[k], elapsed=elapsed).error)
    assert errors == run.error.tolist()
    pieces.run(phi[:20], y[:20], time=time[:20])
    pieces.run(phi[20:], y[20:], time=time[19:])
    assert pieces.to_bytes() == single.to_bytes() == whole.to_bytes()


def test_missing_samples_take_no_time_of_their_own():
    phi, y, time = record()
    some = np.arange(60) % 4 != 1
    one, other = wide(fg.Exponential(0.9)), wide(fg.Exponential(0.9))
    one.run(phi, np.where(some, y, np.nan), missing="skip", time=time)
    other.run(phi[some], y[some], time=time[some])
    assert one.to_bytes() == other.to_bytes()
    update = one.update(phi[0], np.nan, missing="skip")
    assert (update.skipped, np.isnan(update.error)) == ("missing", True)
    assert one.to_bytes() == other.to_bytes()


def test_half_lives():
    rule = fg.Exponential(half_life="10min")
    assert rule.forgetting_factor == 2 ** (-1 / 600)
    assert rule == fg.Exponential(half_life=600) == fg.Exponential(half_life=timedelta(minutes=10))
    assert fg.Component(half_life=["1s", "2s"]).parameters["factors"] == [0.5, 0.5**0.5]
    est = wide(fg.Exponential(half_life="1h"))
    est.update(np.zeros(3), 0.0, elapsed=timedelta(hours=2))
    np.testing.assert_allclose(est.covariance, 4 * WIDE, rtol=1e-12)
    # half of what is known, in any unit of time
    hours = fg.RLS(3, rule=fg.Exponential(half_life=2.0))
    minutes = fg.RLS(3, rule=fg.Exponential(half_life=120.0))
    phi, y, time = record()
    start = (time[0] - 1.0) * 60.0
    both = [
        hours.run(phi, y, time=time),
        minutes.run(phi, y, time=np.concatenate([[start], time * 60.0])),
    ]
    np.testing.assert_allclose(both[0].theta, both[1].theta, rtol=1e-6, atol=1e-9)


def test_dates_and_durations_count_in_seconds():
    phi, y, _ = record()
    seconds = np.cumsum(np.random.default_rng(1).integers(1, 900, size=60))
    dates = np.datetime64("2026-03-29T00:00") + seconds.astype("m8[s]")
    runs = [
        fg.RLS(3, rule=fg.Exponential(half_life="1h")).run(phi, y, time=time).theta
        for time in (seconds, dates, seconds.astype("m8[s]"), dates.astype("M8[ns]"))
    ]
    assert all(np.array_equal(runs[0], theta) for theta in runs[1:])


def test_no_gap_forgets_more_than_ten_half_lives():
    est = wide(fg.Exponential(half_life=1.0))
    assert est.update(np.zeros(3), 0.0, elapsed=1e6).forgetting_factor == 1 / 1024
    np.testing.assert_allclose(est.covariance, 1024 * WIDE, rtol=1e-12)
    walk = wide(fg.RandomWalk(0.3, bound=50.0))
    walk.update(np.zeros(3), 0.0, elapsed=1e9)
    np.testing.assert_allclose(walk.covariance, 50 * np.eye(3), rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize("dtype", ["float64", "float32"])
@pytest.mark.parametrize("schedule", ["every_sample", "cyclic"])
@pytest.mark.parametrize("size", [3, 12])
def test_a_bounded_walk_lives_through_any_gap(size, schedule, dtype):
    random = np.random.default_rng(0)
    for noise, bound in ((1e-7, 33.3), (0.003, 50.0), (0.003, 1e5), (0.3, 9.7), (7.7, 1e3)):
        rule = fg.RandomWalk(noise, bound=bound, schedule=schedule)
        est = fg.RLS(size, rule=rule, dtype=dtype, initial_covariance=bound / 2)
        for _ in range(30):
            elapsed = 10 ** random.uniform(-3, 9)
            est.update(random.normal(size=size), random.normal(), elapsed=elapsed)
            eigenvalues = np.linalg.eigvalsh(est.covariance.astype(float))
            assert eigenvalues[0] > 0 and eigenvalues[-1] < 1.01 * bound


def test_streams_of_a_fleet_have_times_of_their_own():
    phi, y, time = record()
    for rule in (fg.Exponential(0.9), fg.RandomWalk(0.01, bound=1e5), fg.Efra(0.9)):
        fleet = fg.Fleet(2, 3, rule=rule)
        alone = [fg.RLS(3, rule=rule) for _ in range(2)]
        for k in range(1, 60):
            elapsed = np.array([time[k] - time[k - 1], 2.0])
            update = fleet.update(np.array([phi[k], phi[-k]]), y[[k, -k]], elapsed=elapsed)
            for i, j in enumerate((k, -k)):
                single = alone[i].update(phi[j], y[j], elapsed=elapsed[i])
                assert update.error[i] == single.error
        assert all(fleet[i].to_bytes() == alone[i].to_bytes() for i in range(2))


@pytest.mark.parametrize("elapsed", [-1.0, np.nan, np.inf, "soon"])
def test_time_that_does_not_pass_forwards_is_refused(elapsed):
    est, bank = wide(fg.Exponential(0.9)), fg.Bank(3)
    before = est.to_bytes(), bank.to_bytes()
    for each in (est, bank):
        with pytest.raises(fg.InvalidInput, match="elapsed"):
            each.update(np.ones(3), 1.0, elapsed=elapsed)
    assert (est.to_bytes(), bank.to_bytes()) == before


def test_times_that_do_not_fit_are_refused():
    phi, y, time = record()
    est = wide(fg.Exponential(0.9))
    before = est.to_bytes()
    for bad in (time[::-1], np.where(np.arange(60) == 7, np.nan, time)):
        with pytest.raises(fg.InvalidInput, match=r"sample .*time"):
            est.run(phi, y, time=bad)
    with pytest.raises(fg.InvalidInput, match="time"):
        est.run(phi, y, time=time[:50])
    with pytest.raises(fg.InvalidInput, match="time"):
        est.run(phi, y, time=["a"] * 60)
    assert est.to_bytes() == before
    for bad in (0, -1.0, "soon", "10 parsecs"):
        with pytest.raises(fg.InvalidInput, match="half_life"):
            fg.Exponential(half_life=bad)
    with pytest.raises(fg.InvalidInput, match="half_life"):
        fg.Exponential(0.9, half_life=1.0)
