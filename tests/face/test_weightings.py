"""Weightings as Python objects, and the influence they leave to an outlier."""

import pickle

import numpy as np
import pytest

import forgetting as fg

NAMES = [about["name"] for about in fg.weightings()]


def record(samples=100, rows=2, targets=2):
    random = np.random.default_rng(11)
    phi = random.normal(size=(samples, rows, 3))
    y = phi @ random.normal(size=(3, targets)) + random.normal(size=(samples, rows, targets))
    return phi, y


def test_every_weighting_is_a_class_of_the_package():
    for about in fg.weightings():
        kind = getattr(fg, about["type_name"])
        assert issubclass(kind, fg.Weighting)
        assert about["type_name"] in fg.__all__
        assert kind.__doc__.startswith(about["summary"])


@pytest.mark.parametrize("dtype", ["float64", "float32"])
@pytest.mark.parametrize("name", NAMES)
def test_an_estimator_gives_back_its_weighting(name, dtype):
    weighting = fg.weighting(name)
    est = fg.RLS(3, weighting=weighting, rows=2, targets=2, dtype=dtype)
    assert est.weighting == weighting == pickle.loads(pickle.dumps(weighting))
    assert fg.RLS(3, weighting=name).weighting == weighting
    phi, y = record()
    est.run(phi, y)
    again = pickle.loads(pickle.dumps(est))
    assert again.weighting == weighting
    assert np.array_equal(est.run(phi, y).theta, again.run(phi, y).theta)


def weight(weighting, error):
    """The weight of a sample with this innovation: the factor of its leverage 1, for P = 1."""
    rows = len(error)
    est = fg.RLS(1, rule="none", weighting=weighting, rows=rows, initial_covariance=1.0)
    phi = np.zeros((rows, 1))
    phi[0] = 1.0
    return est.update(phi, error).leverage


def test_weights_are_those_of_the_definitions():
    assert weight(fg.Huber(2.0), [1.9]) == 1.0
    assert weight(fg.Huber(2.0), [8.0]) == pytest.approx(0.25)
    assert weight(fg.Huber(2.0), [3.0, 4.0]) == pytest.approx(0.4)
    assert weight(fg.StudentT(3.0), [3.0]) == pytest.approx(4.0 / 12.0)
    assert weight(fg.StudentT(3.0), [3.0, 4.0]) == pytest.approx(5.0 / 28.0)
    assert weight(fg.StudentT(3.0), [0.5]) == 1.0
    assert weight(fg.Equal(), [1e6]) == 1.0


@pytest.mark.parametrize(
    ("weighting", "limit"),
    [(fg.Huber(), 1.345), (fg.StudentT(), 6.0 / 4.0), (fg.StudentT(1.0), np.sqrt(2.0))],
    ids=repr,
)
@pytest.mark.parametrize("rule", [fg.NoForgetting(), fg.Exponential(0.9), fg.Subspace(0.9)])
def test_one_outlier_moves_no_parameter_beyond_the_bound(rule, weighting, limit):
    phi, y = record()
    est = fg.RLS(3, rule=rule, weighting=weighting, rows=2, targets=2)
    est.run(phi, y)
    largest = est.covariance / (1.0 if rule.name == "none" else 0.9)
    for k, size in enumerate([1.0, 1e3, -1e6, 1e6, 1e12]):
        shot = fg.RLS.from_bytes(est.to_bytes())
        shot.update(phi[k], y[k] + size * np.array([[1.0, 0.0], [-1.0, 2.0]]))
        # P after forgetting is at most P / lambda
        spread = np.trace(phi[k] @ largest @ phi[k].T)
        bound = limit * np.sqrt(np.diag(largest) * spread)
        moved = np.abs(shot.theta - est.theta)
        assert (moved <= bound[:, None]).all()
        assert moved.max() > 0.0 or abs(size) > 1e3


def test_without_a_weighting_an_outlier_moves_the_estimate_without_bound():
    phi, y = record()
    moved = []
    for size in (1e6, 1e9):
        est = fg.RLS(3, rule="none", rows=2, targets=2)
        est.run(phi, y)
        before = est.theta
        est.update(phi[0], y[0] + size)
        moved.append(np.abs(est.theta - before).max())
    assert moved[1] / moved[0] == pytest.approx(1000.0, rel=1e-3)


@pytest.mark.parametrize("about", fg.rates(), ids=lambda about: about["name"])
def test_rates_see_the_clipped_error(about):
    """A larger outlier is no reason to forget more."""
    if about["name"] == "function":
        rate = fg.Function(lambda evidence: 1.0 / (1.0 + evidence.squared_error))
    else:
        rate = fg.rate(about["name"])
    phi, y = record(rows=1, targets=1)
    found = []
    for size in (1e6, 1e9):
        est = fg.RLS(3, rule=fg.Exponential(rate), weighting=fg.Huber())
        est.run(phi, y)
        this = est.update(phi[0], y[0] + size).forgetting_factor
        found.append([this, est.update(phi[1], y[1]).forgetting_factor])
    assert found[0] == pytest.approx(found[1], abs=1e-4)


def test_what_is_refused_names_the_parameter():
    with pytest.raises(fg.InvalidInput, match="weighting = 'hubert', allowed: equal, huber"):
        fg.weighting("hubert")
    with pytest.raises(fg.InvalidInput, match='weighting = "hubert"'):
        fg.RLS(1, weighting="hubert")
    with pytest.raises(fg.InvalidInput, match=r"weighting huber: .*'c'; its parameters: threshold"):
        fg.weighting("huber", c=1.0)
    for bad in (0.0, -1.0, float("nan"), float("inf")):
        with pytest.raises(fg.InvalidInput, match="threshold = "):
            fg.RLS(1, weighting=fg.Huber(bad))
        with pytest.raises(fg.InvalidInput, match="degrees = "):
            fg.RLS(1, weighting=fg.StudentT(bad))
