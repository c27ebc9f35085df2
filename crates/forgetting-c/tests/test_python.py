"""An estimator trained in Python goes on in C and back, bit for bit, for every rule, rate,
weighting and gate that needs no function of the user's. Python is held to plain arithmetic
(`FORGETTING_CPU=baseline`): with fused multiply-add its numbers are rounded otherwise.
"""

from __future__ import annotations

import os

import numpy as np
import pytest
from library import Choice, Estimator, Settings, load
from numpy.typing import NDArray

import forgetting as fg

LIBRARY = load()
N = 3
COMPACT = ["none", "exponential", "subspace", "directional", "random_walk"]
DTYPES = ["float32", "float64"]
# P of a compact estimator is summed in another order than Python's; of float32, and relative to P₀
ROUNDING = 1e-4
# an elimination of up to 20 equations, of which P has a condition of about 1e6
SOLVED = 1e-9
# what a choice needs that has no default
NEEDED = {"component": {"blocks": [1, 2], "factors": [0.9, 0.99]}}

assert os.environ.get("FORGETTING_CPU") == "baseline", "run `make test` in the folder above"


def names(axis: str) -> list[str]:
    """Every entry that needs no function."""
    entries = getattr(fg, axis)()
    functions = [
        e["name"] for e in entries if any(p["kind"] == "function" for p in e["parameters"])
    ]
    return [e["name"] for e in entries if e["name"] not in functions]


def samples(dtype: str, seed: int, count: int, n: int = N) -> tuple[NDArray, NDArray]:
    """Samples of parameters that drift, with outliers, silence and samples that repeat."""
    random = np.random.default_rng(seed)
    phi = random.normal(size=(count, n))
    phi[count // 3 : count // 2, 0] = 0
    phi[-20:-10] = phi[-30:-20]
    theta = np.cumsum(random.normal(scale=0.02, size=(count, n)), axis=0) + [1.0] * n
    y = (phi * theta).sum(axis=1) + 0.1 * random.normal(size=count)
    y[:: count // 7] += 5
    return phi.astype(dtype), y.astype(dtype)


def check_both_ways(estimator: fg.RLS | fg.Bank, rule: str | None, dtype: str, n: int = N) -> None:
    """Python, then C, then Python: at every stop the same bytes as Python alone."""
    phi, y = samples(dtype, 1, 300, n)
    for k in range(100):
        estimator.update(phi[k], y[k])
    moved = Estimator(LIBRARY, rule, dtype, n).load(estimator.to_bytes())
    assert moved.to_bytes() == estimator.to_bytes()
    for k in range(100, 200):
        estimator.update(phi[k], y[k])
    moved.update(phi[100:200], y[100:200])
    assert moved.to_bytes() == estimator.to_bytes()
    back = type(estimator).from_bytes(moved.to_bytes())
    for k in range(200, 300):
        estimator.update(phi[k], y[k])
        back.update(phi[k], y[k])
    assert back.to_bytes() == estimator.to_bytes()


@pytest.mark.parametrize("dtype", DTYPES)
@pytest.mark.parametrize("n", range(1, 9))
@pytest.mark.parametrize("rule", COMPACT)
def test_compact(rule: str, n: int, dtype: str) -> None:
    """Every rule and every size that is compiled as a compact estimator."""
    rls = fg.RLS(n, rule=rule, initial_covariance=50.0, dtype=dtype)
    check_both_ways(rls, rule, dtype, n)


def check_circumstances(
    estimator: fg.RLS | fg.Bank, rule: str | None, dtype: str, n: int = N
) -> None:
    """Samples after times of their own and of variances of their own: the same bytes after each."""
    phi, y = samples(dtype, 3, 150, n)
    random = np.random.default_rng(4)
    gamma = np.exp(random.normal(size=150)).astype(dtype)
    elapsed = random.choice(np.array([0, 0.25, 1, 3, 2000], dtype), size=150)
    moved = Estimator(LIBRARY, rule, dtype, n).load(estimator.to_bytes())
    for k in range(150):
        known = None if k % 3 == 0 else float(gamma[k])
        time = 1.0 if k % 4 == 0 else float(elapsed[k])
        estimator.update(phi[k], y[k], known, elapsed=time)
        moved.update_after(time, phi[k], y[k], known)
        assert moved.to_bytes() == estimator.to_bytes(), (k, time, known)


@pytest.mark.parametrize("dtype", DTYPES)
@pytest.mark.parametrize("n", [1, 3, 8])
@pytest.mark.parametrize("rule", COMPACT)
def test_circumstances(rule: str, n: int, dtype: str) -> None:
    """Time and the variance of the noise, compact and general."""
    settings = {"initial_covariance": 50.0, "dtype": dtype}
    check_circumstances(fg.RLS(n, rule=rule, **settings), rule, dtype, n)
    check_circumstances(fg.RLS(n, rule=rule, monitor=True, **settings), None, dtype, n)


@pytest.mark.parametrize("dtype", DTYPES)
def test_circumstances_of_the_default(dtype: str) -> None:
    """A walk with a bound, compact; and the same in units of the data, general."""
    rule = fg.rule("random_walk", process_noise=3e-3, bound=1e3)
    rls = fg.RLS(4, rule=rule, initial_covariance=50.0, dtype=dtype)
    check_circumstances(rls, "random_walk", dtype, 4)
    check_circumstances(fg.RLS(4, dtype=dtype), None, dtype, 4)


@pytest.mark.parametrize("dtype", DTYPES)
@pytest.mark.parametrize(
    ("rule", "n"), [("subspace", 3), ("exponential", 8), (None, 4), (None, 20)]
)
def test_bounds(rule: str | None, n: int, dtype: str) -> None:
    """The estimate within bounds is Python's, and both go on from it alike."""
    if n > 8 and dtype == "float32":
        pytest.skip("no kind of float has so many parameters")
    initial = {} if rule is None else {"initial_covariance": 50.0}
    rls = fg.RLS(n, rule=rule, dtype=dtype, **initial)
    moved = Estimator(LIBRARY, rule, dtype, n).load(rls.to_bytes())
    phi, y = samples(dtype, 5, 100, n)
    lower = np.full(n, -np.inf)
    upper = np.full(n, np.inf)
    lower[0], upper[-1] = 1.25, 0.5
    active = 0
    for k in range(100):
        rls.update(phi[k], y[k])
        moved.update(phi[k : k + 1], y[k : k + 1])
        covariance = moved.covariance()
        assert np.allclose(covariance, rls.covariance, rtol=ROUNDING, atol=ROUNDING)
        wide = (np.asarray(x, dtype=np.float64) for x in (rls.theta, covariance))
        expected = fg.bounded(*wide, lower, upper).astype(dtype)
        active += int(not np.array_equal(expected, rls.theta))
        held = moved.bounded(lower, upper)
        assert np.allclose(held, expected, rtol=SOLVED, atol=0), k
        assert np.all((lower <= held) & (held <= upper))
        if k % 10 == 0:
            rls.theta = expected
            moved.set_theta(expected)
            assert moved.to_bytes() == rls.to_bytes()
    assert active > 50


@pytest.mark.parametrize("dtype", DTYPES)
def test_walk_with_a_bound(dtype: str) -> None:
    """The rule that Python takes when nothing is said, compact."""
    rule = fg.rule("random_walk", process_noise=3e-3, bound=1e3)
    rls = fg.RLS(4, rule=rule, initial_covariance=50.0, dtype=dtype)
    check_both_ways(rls, "random_walk", dtype, 4)


@pytest.mark.parametrize(
    ("n", "dtype"),
    [(n, dtype) for n in (1, 4, 8) for dtype in DTYPES] + [(n, "float64") for n in (9, 17, 32)],
)
def test_sizes(n: int, dtype: str) -> None:
    """General estimators of every class of sizes, with the defaults and the units of the data."""
    check_both_ways(fg.RLS(n, dtype=dtype), None, dtype, n)
    check_both_ways(fg.RLS(n, rule="subspace", monitor=True, dtype=dtype), None, dtype, n)


@pytest.mark.parametrize("dtype", DTYPES)
@pytest.mark.parametrize("rule", names("rules"))
def test_rules(rule: str, dtype: str) -> None:
    """Every rule as a general estimator, P₀ a number or a matrix."""
    made = fg.rule(rule, **NEEDED.get(rule, {}))
    check_both_ways(fg.RLS(N, rule=made, initial_covariance=50.0, dtype=dtype), None, dtype)
    matrix = np.eye(N) + 0.1
    check_both_ways(fg.RLS(N, rule=made, initial_covariance=matrix, dtype=dtype), None, dtype)


@pytest.mark.parametrize("dtype", DTYPES)
@pytest.mark.parametrize(
    ("axis", "name"),
    [(axis, name) for axis in ("rates", "weightings", "gates") for name in names(axis)],
)
def test_other_choices(axis: str, name: str, dtype: str) -> None:
    """Every rate, weighting and gate, with a monitor."""
    make = {"rates": fg.rate, "weightings": fg.weighting, "gates": fg.gate}[axis]
    word = {"rates": "forgetting_factor", "weightings": "weighting", "gates": "gate"}[axis]
    rls = fg.RLS(N, rule="subspace", dtype=dtype, monitor=True, **{word: make(name)})
    check_both_ways(rls, None, dtype)


@pytest.mark.parametrize("dtype", DTYPES)
def test_made_in_c(dtype: str) -> None:
    """The same settings in C and in Python are the same estimator."""
    phi, y = samples(dtype, 2, 100)
    settings = Settings(parameters=N, initial_covariance=50.0, forgetting_factor=0.97, monitor=1)
    settings.rule = Choice.of("subspace", {"threshold": 0.125})
    settings.gate = Choice.of("dead_zone", {"width": 0.25, "otherwise": "freeze"})
    settings.weighting = Choice.of("huber", {})
    made = Estimator(LIBRARY, None, dtype, N).init(settings)
    made.update(phi, y)
    rls = fg.RLS(
        N,
        rule=fg.rule("subspace", threshold=0.125),
        forgetting_factor=0.97,
        gate=fg.gate("dead_zone", width=0.25, otherwise="freeze"),
        weighting="huber",
        initial_covariance=50.0,
        monitor=True,
        dtype=dtype,
    )
    for k in range(100):
        rls.update(phi[k], y[k])
    assert made.to_bytes() == rls.to_bytes()


@pytest.mark.parametrize("dtype", DTYPES)
def test_defaults(dtype: str) -> None:
    """Settings of zeros are what Python makes when nothing is said."""
    made = Estimator(LIBRARY, None, dtype, N).init(Settings(parameters=N))
    assert made.to_bytes() == fg.RLS(N, dtype=dtype).to_bytes()
    given = Settings(parameters=N, initial_covariance=10.0)
    made = Estimator(LIBRARY, None, dtype, N).init(given)
    assert made.to_bytes() == fg.RLS(N, dtype=dtype, initial_covariance=10.0).to_bytes()


def test_refused() -> None:
    """A state of another size, rule or number type is refused."""
    state = fg.RLS(N, rule="subspace", initial_covariance=1.0, dtype="float32").to_bytes()
    Estimator(LIBRARY, "subspace", "float32", N).load(state)
    for rule, dtype, n in (
        ("subspace", "float64", N),
        ("subspace", "float32", N + 1),
        ("directional", "float32", N),
        (None, "float64", N),
    ):
        with pytest.raises(AssertionError):
            Estimator(LIBRARY, rule, dtype, n).load(state)
    followed = fg.RLS(N, rule="subspace", dtype="float32").to_bytes()
    with pytest.raises(AssertionError):
        Estimator(LIBRARY, "subspace", "float32", N).load(followed)


@pytest.mark.parametrize("dtype", DTYPES)
@pytest.mark.parametrize("n", range(1, 9))
def test_bank(n: int, dtype: str) -> None:
    """The default bank, in the units of the data and with a prior, goes on in C and back."""
    check_both_ways(fg.Bank(n, dtype=dtype), "bank", dtype, n)
    check_both_ways(fg.Bank(n, dtype=dtype, initial_covariance=50.0), "bank", dtype, n)
    check_circumstances(fg.Bank(n, dtype=dtype), "bank", dtype, n)


@pytest.mark.parametrize("dtype", DTYPES)
def test_bank_made_in_c(dtype: str) -> None:
    """Settings of zeros are what Python makes when nothing is said; what is read is the same."""
    phi, y = samples(dtype, 6, 300)
    phi = (phi * np.array([1e-3, 1.0, 1e4])).astype(dtype)
    for given in ({}, {"initial_covariance": 10.0}):
        made = Estimator(LIBRARY, "bank", dtype, N).init(Settings(parameters=N, **given))
        bank = fg.Bank(N, dtype=dtype, **given)
        assert made.to_bytes() == bank.to_bytes()
        made.update(phi, y)
        bank.run(phi, y)
        assert made.to_bytes() == bank.to_bytes()
        assert np.array_equal(made.theta(), bank.theta)
        assert np.array_equal(made.weights(), bank.weights)
        size = np.sqrt(np.diag(bank.covariance))
        apart = (made.covariance() - bank.covariance) / np.outer(size, size)
        assert np.abs(apart).max() < ROUNDING


def test_other_banks_are_refused() -> None:
    """Of another mixer, of other members, of several rows or targets, weighted."""
    for bank in (
        fg.Bank(N, mixer="best"),
        fg.Bank(N, members=["subspace", "exponential"]),
        fg.Bank(N, members=["exponential"] * 8),
        fg.Bank(N, rows=2),
        fg.Bank(N, targets=2),
        fg.Bank(N, weighting="huber"),
        fg.Bank(N, dtype="float32"),
        fg.RLS(N, rule="random_walk", initial_covariance=1.0),
    ):
        with pytest.raises(AssertionError, match="not a saved estimator"):
            Estimator(LIBRARY, "bank", "float64", N).load(bank.to_bytes())
    with pytest.raises(AssertionError, match="not a saved estimator"):
        Estimator(LIBRARY, "random_walk", "float64", N).load(fg.Bank(N).to_bytes())
