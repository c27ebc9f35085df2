"""The model of what an estimator found says the same as the estimator itself."""

import numpy as np
import pytest
from scipy.signal import lfilter

import forgetting as fg
from forgetting.polynomials import Structure

TRUTH = fg.PolynomialModel(
    [1, -1.2, 0.5], [[1.0, 0.5], [0.8, -0.3]], C=[1, 0.4], delay=[1, 0], offset=0.5
)
PARAMETRIC = {
    "armax": (fg.ARMAX, {"na": 2, "nb": 2, "nc": 1, "nk": [1, 0]}),
    "oe": (fg.OE, {"nb": 2, "nf": 2, "nk": [1, 0]}),
    "bj": (fg.BJ, {"nb": 2, "nc": 1, "nd": 1, "nf": [2, 1], "nk": [1, 0]}),
}
SETTLED = 300
"""Samples after which nothing is left of how a run began."""


def record(truth=TRUTH, samples=3000):
    random = np.random.default_rng(0)
    u, e = random.normal(size=(samples, 2)), 0.2 * random.normal(size=samples)
    return u, truth.simulate(u) + lfilter(truth.C, truth.A, e)


@pytest.mark.parametrize("name", PARAMETRIC)
def test_predictions_and_free_runs_are_those_of_the_estimator(name):
    make, orders = PARAMETRIC[name]
    u, y = record()
    fitted = make(**orders, offset=True, rule="none").fit(u, y)
    found = fitted.model(sample_time=0.5)
    assert found.structure == Structure(**{**orders, "nb": [2, 2]}, offset=True)
    assert np.array_equal(found.theta, fitted.theta_)
    assert found.sample_time == 0.5
    ours, theirs = found.predict(u, y), np.asarray(fitted.predict(u, y))
    np.testing.assert_allclose(ours[SETTLED:], theirs[SETTLED:], atol=1e-8)
    ours, theirs = found.simulate(u), fitted.simulate(u)
    np.testing.assert_allclose(ours[SETTLED:], theirs[SETTLED:], atol=1e-8)


def test_armax_is_found_with_its_noise_and_passes_the_tests_that_arx_fails():
    u, y = record(samples=8000)
    orders = {"na": 2, "nb": [2, 2], "nk": [1, 0], "offset": True}
    fitted = fg.ARMAX(**orders, nc=1, rule="none").fit(u, y)
    found = fitted.model()
    off = np.abs(found.theta - TRUTH.theta) / found.standard_errors
    assert (off < 4).all(), off
    tests = found.residual_tests(u, y)
    assert tests.p_value[-1] > 1e-3 and tests.input_p_value.min() > 1e-3
    arx = fg.ARX(**orders, rule="none").fit(u, y)
    without = arx.model()
    assert without.residual_tests(u, y).p_value[-1] < 1e-6


def test_arx_with_several_inputs_predicts_as_its_model():
    u, y = record()
    fitted = fg.ARX(na=2, nb=[2, 1], nk=[1, 0], offset=True, rule="none").fit(u, y)
    found = fitted.model()
    ours, theirs = found.predict(u, y), np.asarray(fitted.predict(u, y))
    np.testing.assert_allclose(ours[SETTLED:], theirs[SETTLED:], atol=1e-9)
