"""One intake: what a shape means does not depend on who is asked, and nothing is taken in part."""

from __future__ import annotations

import datetime
import itertools
from collections.abc import Callable

import numpy as np
import pytest

import forgetting as fg
from forgetting import analysis

SIZES = [(3, 1, 1), (3, 2, 1), (3, 2, 3), (1, 2, 1), (3, 1, 2), (1, 1, 1), (2, 2, 2)]


def forms(*full: int) -> set[tuple[int, ...]]:
    """The shapes that mean ``full``: dimensions of 1 may be left out."""
    choices = [((), (size,)) if size == 1 else ((size,),) for size in full]
    return {sum(chosen, ()) for chosen in itertools.product(*choices)}


def shapes(size: int) -> list[tuple[int, ...]]:
    """Every shape of up to three dimensions with so many numbers."""
    sides = range(1, size + 1)
    every = [s for d in range(4) for s in itertools.product(sides, repeat=d)]
    return [s for s in every if np.prod(s, initial=1) == size]


def taken(work: Callable[[], object]) -> bool:
    try:
        work()
    except fg.InvalidInput as error:
        assert "has shape" in str(error) and "expected (" in str(error)
        return False
    return True


@pytest.mark.parametrize(("n", "p", "m"), SIZES)
def test_update_and_run_take_the_same_shapes(n: int, p: int, m: int) -> None:
    phi, y = np.ones((p, n)), np.ones((p, m))
    for shape in shapes(p * n):
        right, reshaped = shape in forms(p, n), phi.reshape(shape)
        assert taken(lambda: fg.RLS(n, rows=p, targets=m).update(reshaped, y)) == right, shape  # noqa: B023
        run = lambda: fg.RLS(n, rows=p, targets=m).run(reshaped[None], y[None])  # noqa: B023, E731
        assert taken(run) == right, shape
    for shape in shapes(p * m):
        right, reshaped = shape in forms(p, m), y.reshape(shape)
        assert taken(lambda: fg.RLS(n, rows=p, targets=m).update(phi, reshaped)) == right, shape  # noqa: B023
        run = lambda: fg.RLS(n, rows=p, targets=m).run(phi[None], reshaped[None])  # noqa: B023, E731
        assert taken(run) == right, shape
    for shape in shapes(p * p):
        right, gamma = shape in forms(p, p), np.eye(p).reshape(shape)
        assert taken(lambda: fg.RLS(n, rows=p, targets=m).update(phi, y, gamma)) == right, shape  # noqa: B023


@pytest.mark.parametrize(("n", "p", "m"), SIZES)
def test_priors_and_meters_take_no_other_shape(n: int, p: int, m: int) -> None:
    for shape in shapes(n * n):
        right = shape in {(n, n), *([(n,), ()] if n == 1 else [])}
        given = np.eye(n).reshape(shape)
        assert taken(lambda: fg.RLS(n, initial_covariance=given)) == right, shape  # noqa: B023
        assert taken(lambda: fg.Fleet(7, n, initial_covariance=given)) == right, shape  # noqa: B023
    for shape in shapes(n * m):
        right = shape in {(n, m), *([(n,)] if m == 1 else [])}
        theta = np.ones(shape)
        assert taken(lambda: fg.RLS(n, targets=m, initial_theta=theta)) == right, shape  # noqa: B023
    for shape in shapes(p * n):
        phi = np.ones(shape)
        meter = fg.ExcitationMeter(n, 5, rows=p)
        assert taken(lambda: meter.add(phi)) == (shape in forms(p, n)), shape  # noqa: B023
    for shape in shapes(p * p):
        gamma = np.eye(p).reshape(shape)
        meter = fg.ExcitationMeter(n, 5, rows=p)
        right = shape in forms(p, p)
        assert taken(lambda: meter.add(np.ones((p, n)), gamma)) == right, shape  # noqa: B023


def test_a_meter_weighs_by_gamma() -> None:
    phi, gamma = np.array([[1.0, 2.0], [0.5, -1.0]]), np.array([[2.0, 0.5], [0.5, 1.0]])
    meter = fg.ExcitationMeter(2, 3, rows=2)
    meter.add(phi, gamma)
    assert meter.information == pytest.approx(phi.T @ np.linalg.inv(gamma) @ phi, rel=1e-14)
    meter.add(phi, 4.0)
    both = phi.T @ (np.linalg.inv(gamma) + np.eye(2) / 4.0) @ phi
    assert meter.information == pytest.approx(both, rel=1e-14)
    for bad in (0.0, -1.0, np.nan, [[1.0, 2.0], [2.0, 1.0]], [[1.0, 0.1], [0.0, 1.0]]):
        before = meter.information
        with pytest.raises(fg.InvalidInput, match="gamma"):
            meter.add(phi, bad)
        assert (meter.information == before).all()


DAY = np.datetime64("2024-01-01")
NOT_NUMBERS = [
    (np.array([1 + 0j, 2, 3]), "complex"),
    ([1 + 2j, 2, 3], "complex"),
    (np.array([1, 2, 3], dtype="complex64"), "complex"),
    (np.ma.masked_array([1.0, 2.0, 3.0], [False, True, False]), "masked array"),
    (np.ma.masked_array([1.0, 2.0, 3.0]), "masked array"),
    (np.array([DAY, DAY, DAY]), "dates or times"),
    ([DAY, DAY, DAY], "dates or times"),
    (np.array([DAY, DAY, DAY]) - DAY, "dates or times"),
    ([datetime.datetime(2024, 1, 1)] * 3, "must hold numbers"),
    (["1", "2", "3"], "text"),
    ([b"1", b"2", b"3"], "text"),
    ([1.0, [2.0], 3.0], "must hold numbers"),
]


@pytest.mark.parametrize(("values", "message"), NOT_NUMBERS, ids=lambda a: str(a)[:30])
def test_what_is_no_number_is_refused_everywhere(values: object, message: str) -> None:
    est, fleet, meter = fg.RLS(3), fg.Fleet(1, 3), fg.ExcitationMeter(3, 5)
    before = est.to_bytes()
    one = values[:1]
    row = np.ma.atleast_2d(values) if message == "masked array" else [values]
    calls: list[tuple[str, Callable[[], object]]] = [
        ("phi", lambda: est.update(values, 1.0)),
        ("phi", lambda: est.run(row, [1.0])),
        ("phi", lambda: est.predict(values)),
        ("y", lambda: fg.RLS(3, targets=3).update([1.0, 2.0, 3.0], values)),
        ("y", lambda: est.run(np.ones((3, 3)), values)),
        ("gamma", lambda: est.run(np.ones((3, 3)), np.ones(3), gamma=values)),
        ("initial_covariance", lambda: fg.RLS(3, initial_covariance=values)),
        ("initial_theta", lambda: fg.RLS(3, initial_theta=values)),
        ("information", lambda: fg.RLS(3, rule=fg.ExponentialResetting(0.9, information=values))),
        ("phi", lambda: fleet.update(row, [1.0])),
        ("phi", lambda: meter.add(values)),
        ("regressors", lambda: analysis.excitation(row, window=1)),
    ]
    if message != "masked array":  # of which a model knows what it means
        calls.append(("y", lambda: fg.ARX(na=1, nb=0).fit(None, values)))
    if message != "must hold numbers":
        calls += [
            ("y", lambda: fleet.update(np.ones((1, 3)), one)),
            ("gamma", lambda: meter.add([1.0, 2.0, 3.0], one)),
        ]
    for name, call in calls:
        with pytest.raises(fg.InvalidInput, match=f"{name} .*{message}|{name} must hold numbers"):
            call()
    assert est.to_bytes() == before


class Interrupted:
    """Values that Ctrl-C comes to while they are read."""

    def __array__(self, *_: object, **__: object) -> np.ndarray:
        raise KeyboardInterrupt


def test_ctrl_c_while_numbers_are_read_is_no_bad_input() -> None:
    est = fg.RLS(2)
    before = est.to_bytes()
    calls: list[Callable[[], object]] = [
        lambda: est.update([1.0, 2.0], Interrupted()),
        lambda: est.run(Interrupted(), [1.0]),
        lambda: fg.Fleet(1, 2).update([[1.0, 2.0]], Interrupted()),
    ]
    for call in calls:
        with pytest.raises(KeyboardInterrupt):
            call()
    assert est.to_bytes() == before


@pytest.mark.parametrize("size", [2**31, 2**63, 2**64, 2**200, -(2**63) - 1])
def test_a_size_that_no_machine_has_is_out_of_range_and_no_overflow(size: int) -> None:
    for name in ("parameters", "rows", "targets"):
        with pytest.raises(fg.InvalidInput, match=f"{name} = -?\\d+, allowed: whole numbers"):
            fg.RLS(**{"parameters": 2, name: size})
    with pytest.raises(fg.InvalidInput, match="parameters"):
        fg.Fleet(3, size)
    with pytest.raises((fg.InvalidInput, MemoryError)):
        fg.Fleet(size, 3)
    with pytest.raises((fg.InvalidInput, MemoryError)):
        fg.Fleet(2, 3).append(size)
    with pytest.raises(fg.InvalidInput, match="threads"):
        fg.Fleet(2, 3, threads=size)
    with pytest.raises(IndexError):
        fg.Fleet(2, 3)[size]
    with pytest.raises(fg.InvalidInput, match="window"):
        fg.ExcitationMeter(2, size)
