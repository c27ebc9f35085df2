"""ARMA, ARMAX, OE and BJ."""

from __future__ import annotations

import pickle

import numpy as np
import pytest
from scipy.signal import lfilter

import forgetting as fg
from forgetting._core import structures
from reference.polynomial import SYSTEMS, batch, record

CLASSES = {
    "arma": fg.ARMA(na=1, nc=1),
    "armax": fg.ARMAX(na=2, nb=2, nc=2),
    "oe": fg.OE(nb=2, nf=2),
    "bj": fg.BJ(nb=2, nc=1, nd=1, nf=2),
}
SEEDS = range(12)
NEAR_BATCH = 1.5
"""Errors of the recursion over those of the batch estimate, root mean squares: 1.0 to 1.3 seen."""


def new(name, **settings):
    return type(CLASSES[name])(**CLASSES[name].get_params() | settings)


@pytest.mark.parametrize("rule", ["auto", "none"])
@pytest.mark.parametrize("name", SYSTEMS)
def test_estimates_are_as_good_as_those_of_the_batch(name, rule):
    system, own, reference = SYSTEMS[name], [], []
    for seed in SEEDS:
        u, y = record(system, seed)
        own.append(new(name, rule=rule).fit(u, y).theta_ - system.theta)
        reference.append(batch(system, u, y) - system.theta)
    spread = np.sqrt(np.mean(np.square(own), axis=0))
    assert (spread <= NEAR_BATCH * np.sqrt(np.mean(np.square(reference), axis=0)) + 0.003).all()


def test_arx_is_biased_where_armax_is_not():
    system = SYSTEMS["armax"]
    u, y = record(system, 0, 10_000)
    arx = fg.ARX(na=2, nb=2, nk=1, rule="none").fit(u, y).theta_
    armax = fg.ARMAX(na=2, nb=2, nc=2, rule="none").fit(u, y).theta_
    assert abs(arx[0] - 1.5) > 10 * abs(armax[0] - 1.5)


@pytest.mark.parametrize("name", SYSTEMS)
def test_any_split_of_a_record_is_the_same(name):
    u, y = record(SYSTEMS[name], 1, 500)
    whole, parts = new(name).fit(u, y), new(name)
    for start, end in [(0, 1), (1, 7), (7, 250), (250, 251), (251, 500)]:
        parts.partial_fit(None if u is None else u[start:end], y[start:end])
    assert np.array_equal(whole.theta_, parts.theta_)
    assert (whole.used_, whole.samples_) == (parts.used_, parts.samples_)
    assert whole.noise_variance_ == pytest.approx(parts.noise_variance_)
    again = pickle.loads(pickle.dumps(parts))
    more = y[:50], None if u is None else u[:50]
    again.partial_fit(more[1], more[0])
    whole.partial_fit(more[1], more[0])
    assert np.array_equal(whole.theta_, again.theta_)


@pytest.mark.parametrize("rule", ["auto", fg.Subspace(0.98), fg.Exponential(fg.Fortescue())])
@pytest.mark.parametrize("name", SYSTEMS)
def test_the_estimator_took_the_linear_regression(name, rule):
    u, y = record(SYSTEMS[name], 2, 400)
    model = new(name, rule=rule).fit(u, y)
    course = model.course(u, y, ("phi", "y", "theta"))
    phi, target = course["phi"], course["y"]
    assert np.array_equal(course["theta"][-1], model.theta_)
    plain = fg.Bank(phi.shape[1]) if rule == "auto" else fg.RLS(phi.shape[1], rule=rule)
    plain.run(phi, target, missing="skip", outputs=())
    assert np.array_equal(plain.theta, model.estimator_.theta)


@pytest.mark.parametrize("name", SYSTEMS)
def test_units_do_not_matter(name):
    system = SYSTEMS[name]
    u, y = record(system, 3, 1000)
    plain = new(name).fit(u, y).theta_
    other = new(name).fit(None if u is None else u * 1e6, y * 1e-3).theta_
    inputs = slice(len(system.a), len(system.a) + len(system.b))
    other[inputs] *= 1e9
    assert other == pytest.approx(plain, rel=1e-6, abs=1e-9)


@pytest.mark.parametrize("name", SYSTEMS)
def test_predictions_and_free_runs_are_those_of_the_filters(name):
    system = SYSTEMS[name]
    u, y = record(system, 4, 800)
    model = new(name, rule="none").fit(u, y)
    found = system.with_theta(model.theta_)
    given = np.zeros_like(y) if u is None else u
    predicted = model.predict(u, y)
    known = ~np.isnan(predicted)
    assert known.sum() == len(y) - model.reach
    assert predicted[known] == pytest.approx((y - found.errors(given, y))[known])
    free = lfilter([1.0], np.r_[1.0, -np.array(found.a)], found.response(given))
    run = model.simulate(len(y) if u is None else u)
    assert run == pytest.approx(free, abs=1e-9)


def test_a_forecast_goes_on_from_the_last_sample():
    system = SYSTEMS["armax"]
    u, y = record(system, 5, 2000)
    model = new("armax", rule="none").fit(u[:1990], y[:1990])
    ahead = model.forecast(u[1990:])
    one = model.partial_fit(u[:0], y[:0]).forecast(u[1990:1991])
    assert ahead[0] == one[0]
    assert np.abs(ahead - y[1990:]).max() < 8
    by_hand = (
        np.r_[y[1989], y[1988]] @ model.theta_[:2] + np.r_[u[1989], u[1988]] @ model.theta_[2:4]
    )
    errors = system.with_theta(model.theta_).errors(u[:1990], y[:1990])
    assert ahead[0] == pytest.approx(by_hand + errors[[-1, -2]] @ model.theta_[4:], abs=0.05)


@pytest.mark.parametrize("name", SYSTEMS)
@pytest.mark.parametrize("rule", ["auto", fg.Subspace(0.95), fg.RandomWalk(0.1)])
def test_filters_stay_stable_whatever_comes(name, rule):
    rng = np.random.default_rng(6)
    y = rng.standard_t(1.5, size=600) * np.repeat([1.0, 0.0, 1e6], 200)
    u = None if name == "arma" else np.repeat(rng.choice([-1e5, 0.0, 1.0], 60), 10)
    model = new(name, rule=rule)
    for k in range(0, 600, 20):
        model.partial_fit(None if u is None else u[k : k + 20], y[k : k + 20])
        found = SYSTEMS[name].with_theta(model.theta_)
        for polynomial in (np.r_[1.0, found.c], np.r_[1.0, -np.array(found.f)]):
            assert np.abs(np.roots(polynomial)).max(initial=0.0) < 1.0
    assert np.isfinite(model.theta_).all()


def test_what_is_missing_is_left_out():
    system = SYSTEMS["armax"]
    u, y = record(system, 7)
    y[100:110], u[500], y[1500:1900] = np.nan, np.nan, np.nan
    model = new("armax", rule="none").fit(u, y)
    # 10 and 2 after them, 3 that u(500) is in or near, 400 and 2, and the first 2
    assert model.used_ == len(y) - 12 - 3 - 402 - 2
    assert model.theta_ == pytest.approx(system.theta, abs=0.1)
    assert np.isfinite(model.predict(u, y)[2:]).all()


@pytest.mark.parametrize("method", ["prediction_error", "extended_least_squares"])
def test_an_operating_point_is_the_offset(method):
    system = SYSTEMS["armax"]
    u, y = record(system, 8)
    model = new("armax", rule="none", offset=True, method=method).fit(u + 20.0, y + 300.0)
    assert model.theta_[:-1] == pytest.approx(system.theta, abs=0.15)
    steady = 300.0 * (1 - 1.5 + 0.7) - 20.0 * 1.5
    assert model.theta_[-1] == pytest.approx(steady, abs=3.0)
    assert model.names_[-1] == "offset"


def test_inputs_have_orders_of_their_own():
    rng = np.random.default_rng(9)
    u = rng.normal(size=(3000, 2))
    first = lfilter([0.0, 1.0, 0.5], [1.0, -0.8], u[:, 0])
    second = lfilter([0.0, 0.0, 0.0, 2.0], [1.0], u[:, 1])
    y = first + second + 0.1 * rng.normal(size=3000)
    model = fg.OE(nb=[2, 1], nf=[1, 0], nk=[1, 3], rule="none").fit(u, y)
    assert model.theta_ == pytest.approx([1.0, 0.5, 2.0, 0.8], abs=0.02)
    assert model.names_ == ["u1(k-1)", "u1(k-2)", "u2(k-3)", "w[u1](k-1)"]
    arx = fg.ARX(na=0, nb=[1, 1], nk=[1, 3], rule="none").fit(u, second)
    assert arx.theta_ == pytest.approx([0.0, 2.0], abs=1e-6)


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: fg.ARMAX(na=-1).fit(np.ones(9), np.ones(9)), "na is -1"),
        (lambda: fg.OE(nb=[1, 1]).fit(np.ones(9), np.ones(9)), "nb has 2 orders for 1 input"),
        (lambda: fg.OE(nb=5000).fit(np.ones(9), np.ones(9)), r"nb\[0\] = 5000"),
        (lambda: fg.ARMAX(method="magic").fit(np.ones(9), np.ones(9)), "method = .*magic"),
        (lambda: fg.ARMA().fit(np.ones(9), np.ones(9)), "u has 1 input"),
        (lambda: fg.BJ().fit(None, np.ones(9)), "u has 0 input"),
        (lambda: fg.BJ().fit(np.ones(8), np.ones(9)), "u has 8 rows and y has 9"),
        (lambda: fg.OE().fit(np.ones(9), np.ones((9, 2))), "y has 2 outputs"),
        (lambda: fg.OE().fit(np.ones(9), np.r_[1.0, np.inf, np.ones(7)]), "infinite in row 1"),
        (lambda: fg.OE().predict(np.ones(9), np.ones(9)), "has seen no data"),
        (lambda: fg.OE(rule="exponentail").fit(np.ones(9), np.ones(9)), "exponential"),
    ],
)
def test_what_is_refused_is_named(call, words):
    with pytest.raises(fg.InvalidInput, match=words):
        call()


def test_a_refused_record_changes_nothing():
    u, y = record(SYSTEMS["bj"], 10, 300)
    model = new("bj").fit(u, y)
    before, theta = pickle.dumps(model.estimator_), model.theta_
    with pytest.raises((fg.InvalidInput, fg.NumericalRange)):
        model.partial_fit(u[:50], np.r_[y[:40], 1e300, y[41:50]])
    assert pickle.dumps(model.estimator_) == before
    assert np.array_equal(model.theta_, theta)


@pytest.mark.parametrize("name", [name for name in structures() if name in CLASSES])
def test_the_registry_names_the_orders_of_the_classes(name):
    _, orders, _ = structures()[name]
    own = [key for key in CLASSES[name].get_params() if key.startswith("n") and len(key) == 2]
    assert sorted(own) == sorted(orders)


def test_every_structure_has_its_class():
    assert set(structures()) == {"fir", "ar", "arx", "arma", "armax", "oe", "bj"}
    for name in structures():
        assert hasattr(fg, name.upper())


def test_float32_finds_the_same():
    system = SYSTEMS["oe"]
    u, y = record(system, 11)
    model = new("oe", dtype="float32").fit(u, y)
    assert model.theta_ == pytest.approx(system.theta, abs=0.1)
